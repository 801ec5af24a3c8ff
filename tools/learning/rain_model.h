// The networks behind RainModel, for those who run them.
#pragma once

#include "tools/learning/first_stage.h"
#include "tools/learning/model_config.h"
#include "tools/learning/unet.h"

namespace pluvia {

/// "cpu" or "cuda". Throws Error (usage) for a device that libtorch cannot use here.
at::Device device_named(const std::string& name);

struct RainModel {
    ModelConfig config;
    at::Device device = at::kCPU;
    std::optional<UNet> unet, guide;
    std::optional<FirstStage> first_stage;

    /// Pixels that a latent cell has; 1 without a first stage.
    int cell() const { return config.first_stage ? int(config.first_stage->factor()) : 1; }
    /// What sides of a tile must be multiples of, in pixels.
    int unit() const {
        const int64_t guide_factor = config.guide ? config.guide->factor() : 1;
        return cell() * int(std::max(config.unet.factor(), guide_factor));
    }
};

}  // namespace pluvia
