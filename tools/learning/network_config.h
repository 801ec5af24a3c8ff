// Hyper-parameters of the networks, as the file of weights tells them or as its shapes betray them.
// What is built of them is in first_stage.h and unet.h.
#pragma once

#include "tools/learning/safetensors.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pluvia {

/// Sides of all tensors of a network by their names.
using TensorShapes = std::map<std::string, TensorShape>;
/// Those whose names start with a prefix, without it.
TensorShapes shapes_below(const std::map<std::string, TensorEntry>& entries, const std::string& prefix);

/// VQ-f4 of latent diffusion. Defaults: as published. Source: Rombach et al. 2022, vq-f4.
struct FirstStageConfig {
    int64_t image_channels = 3, latent_channels = 3, code_channels = 3;
    int64_t channels = 128;
    std::vector<int64_t> multipliers = {1, 2, 4};
    int64_t res_blocks = 2;  // per level of the encoder; the decoder has one more
    int64_t codes = 8192;

    /// Side of a latent cell in pixels.
    int64_t factor() const { return int64_t(1) << (multipliers.size() - 1); }
};

/// The noise predictor. Defaults: HRIGNet as published.
struct UNetConfig {
    int64_t in_channels = 6, out_channels = 3;
    int64_t channels = 224;
    std::vector<int64_t> multipliers = {1, 2, 3, 4};
    int64_t res_blocks = 2;                              // per level on the way down; one more on the way up
    std::vector<int64_t> attention_factors = {2, 4, 8};  // downsampling factors with attention
    int64_t head_width = 32;
    int64_t context_channels = 0;  // of the guide's tokens; 0: self-attention only, the guide is not looked at

    int64_t factor() const { return int64_t(1) << (multipliers.size() - 1); }
};

/// What shapes tell. Throws Error (input) naming what is missing. where: the file, for messages.
FirstStageConfig first_stage_config(const TensorShapes& shapes, const std::string& where);
/// head_width: the one number that no shape tells.
UNetConfig unet_config(const TensorShapes& shapes, int64_t head_width, const std::string& where);

}  // namespace pluvia
