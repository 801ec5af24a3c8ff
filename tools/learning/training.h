// Training of the regression network: from clean picture and streak coverage to the change that rain makes, judged
// where there is rain. Every crop is a pure function of seed and step, so training that was interrupted goes on as if
// it had not been. Which pictures and files is decided by the caller.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/image.h"
#include "tools/learning/model_config.h"

#include <memory>
#include <string>
#include <vector>

namespace pluvia {

/// Pictures of one size: clean, streak coverage, and the truth.
struct TrainingPair {
    Image<Rgba8> background;
    Image<uint8_t> coverage;
    Image<Rgba8> rainy;
};

struct TrainingSettings {
    int64_t channels = 16;
    std::vector<int64_t> multipliers = {1, 2, 4, 4};
    int batch = 8;                // crops a step
    int crop = 128;               // pixels of a side, a multiple of what the UNet halves
    double learning_rate = 2e-3;  // falls to nothing as a cosine over all steps
    int steps = 4000;
    uint64_t seed = 0;
    std::string device = "cpu";
};

/// Adam with decoupled weight decay, and a running mean of the weights that is the result.
/// Source: Loshchilov and Hutter 2019.
class Trainer {
public:
    /// Throws Error (usage) for settings out of range, (input) for pictures smaller than a crop or of different sizes.
    Trainer(std::vector<TrainingPair> pairs, const TrainingSettings& settings);
    ~Trainer();

    int step() const;  // how many are done
    /// Returns the loss: mean squared difference of display values (0..1) over pixels with rain, before the step.
    /// Throws Error (render_failed) when it is not finite.
    double train_step();

    /// All that is needed to go on. load() throws Error (input) when the file was saved with other settings.
    void save(const std::string& path) const;
    void load(const std::string& path);
    /// The mean of the weights as a model in half precision. note: kept in its metadata as "training".
    void save_model(const std::string& path, const std::string& note) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pluvia
