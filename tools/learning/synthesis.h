// From a clean picture and streak coverage to a rainy picture of the same size, tile by tile.
// Tiles are those of tiles.h, the last step is blend.h. No header of libtorch is needed to call this.
#pragma once

#include "renderer/image/image.h"
#include "tools/learning/blend.h"
#include "tools/learning/model_config.h"
#include "tools/learning/tiles.h"

#include <functional>
#include <memory>
#include <string>

namespace pluvia {

/// Networks in memory, on a device.
struct RainModel;
/// device: "cpu" or "cuda". Throws Error (input) for files that are damaged or hold no model, (usage) for a device that
/// libtorch cannot use.
std::shared_ptr<const RainModel> load_model(const std::string& path, const std::string& device = "cpu");
const ModelConfig& config_of(const RainModel& model);

struct SynthesisSettings {
    int steps = 20;  // of diffusion
    double eta = 0;  // 0: nothing random after the first noise; 1: as HRIGNet was published
    uint64_t seed = 0;
    bool anchor_latents = true;  // cells without rain follow the clean picture through all steps
    TileSettings tiles;
    BlendSettings blend;
};

/// Called with the share that is done; false stops with Error (stopped_early).
using SynthesisProgress = std::function<bool(double)>;

/// Both pictures must have the same size; throws Error (input) otherwise, naming `where`.
Image<Rgba8> synthesize(const RainModel& model, const Image<Rgba8>& background, const Image<uint8_t>& coverage,
                        const SynthesisSettings& settings, const SynthesisProgress& progress = {},
                        const std::string& where = "picture");

/// What is known of libtorch's speed here, and how many threads it uses from now on (0: all).
void set_learning_threads(int threads);
/// A line to show when matrix products run on the slow reference BLAS; empty otherwise. Takes some milliseconds.
std::string slow_blas_notice();

}  // namespace pluvia
