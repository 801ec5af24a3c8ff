// Training of the two kinds of model, on pairs of clean and rainy pictures. Regression: from clean picture and streak
// coverage to the change that rain makes, judged where there is rain. Diffusion: a guiding model that draws the
// streaks' light and a main model that draws the change and looks at the guide, both from noise. Which pictures and
// files is decided by the caller.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/image.h"
#include "tools/learning/model_config.h"

#include <memory>
#include <string>
#include <vector>

namespace pluvia {

/// Pictures of one size.
struct TrainingPair {
    Image<Rgba8> background;
    Image<Rgba8> layer;       // light of the streaks; of it only diffusion's guide learns
    Image<uint8_t> coverage;  // of the streaks
    Image<Rgba8> rainy;       // the truth
};

struct TrainingSettings {
    ModelConfig::Kind kind = ModelConfig::Kind::regression;
    int64_t channels = 16;             // of the network; diffusion's guide has half of them
    std::vector<int64_t> multipliers;  // empty: 1, 2, 4, 4, and 1, 2, 2 of a diffusion model
    int batch = 8;                     // crops a step
    int crop = 128;                    // pixels of a side, a multiple of what the UNet halves
    double learning_rate = 2e-3;       // falls to nothing as a cosine over all steps
    int steps = 4000;
    uint64_t seed = 0;
    std::string device = "cpu";
};

/// Optimises by Adam (adam.h); the result is a running mean of the weights.
class Trainer {
public:
    /// Throws Error (usage) for settings out of range, (input) for pictures smaller than a crop or of different sizes.
    Trainer(const std::vector<TrainingPair>& pairs, const TrainingSettings& settings);
    ~Trainer();

    /// Begins with the weights of a model instead of random ones. Throws Error (input) when the networks differ.
    void start_from(const std::string& model);

    int step() const;  // how many are done
    /// Does not wait for the device.
    void train_step();
    /// Losses of the steps since the last call. Regression: mean squared difference of display values (0..1) over
    /// pixels with rain, before the step. Diffusion: of both models together, see losses.h. Throws Error
    /// (render_failed) when one is not finite.
    std::vector<double> take_losses();

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
