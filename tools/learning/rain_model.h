// The networks behind RainModel, for those who run them.
#pragma once

#include "tools/learning/first_stage.h"
#include "tools/learning/model_config.h"
#include "tools/learning/unet.h"

namespace pluvia {

/// "cpu" or "cuda". Throws Error (usage) for a device that libtorch cannot use here.
at::Device device_named(const std::string& name);

/// Coverage as networks are given it, 0..1, of 0..1: streaks that pass through a pixel during the exposure cover some
/// hundredths of it, so a sixteenth is full.
at::Tensor seen_coverage(const at::Tensor& coverage);
/// What a UNet attends to of a guide's cells, pooled: [batch, tokens, channels] of [batch, channels, height, width].
at::Tensor guide_tokens(const at::Tensor& cells);

struct RainModel {
    ModelConfig config;
    at::Device device = at::kCPU;
    std::optional<UNet> unet, guide;
    std::optional<FirstStage> first_stage;

    /// Pixels along a side of a latent cell.
    int cell() const { return config.first_stage ? int(config.first_stage->factor()) : config.fold; }
    /// What sides of a tile must be multiples of, in pixels.
    int unit() const {
        const int64_t guide_factor = config.guide ? config.guide->factor() : 1;
        return cell() * int(std::max(config.unet.factor(), guide_factor));
    }
};

}  // namespace pluvia
