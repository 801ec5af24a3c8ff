// Files of tiny models with random weights.
#pragma once

#include "tools/learning/model_config.h"
#include "tools/learning/parameters.h"
#include "tools/learning/rain_model.h"

#include <string>
#include <vector>

namespace pluvia {

/// The tensors of a network under a prefix, none of them zero.
template <class Network, class Config>
void add_network(NamedTensors& tensors, const std::string& prefix, const Config& config, uint64_t seed) {
    NamedTensors own;
    Network(recorded_parameters(fresh_parameters(seed, true), own), config);
    for (auto& [name, tensor] : own) tensors.emplace_back(prefix + name, tensor);
}

inline void write_model(const std::string& path, const NamedTensors& tensors, const ModelConfig& config) {
    std::vector<WrittenTensor> written;
    for (const auto& [name, t] : tensors)
        written.push_back({name, t.sizes().vec(), {t.data_ptr<float>(), size_t(t.numel())}});
    write_safetensors(path, model_metadata(config), written);
}

inline void write_regression_model(const std::string& path) {
    ModelConfig config;
    config.kind = ModelConfig::Kind::regression;
    config.unet = {.in_channels = regression_channels,
                   .channels = 16,
                   .multipliers = {1, 2},
                   .res_blocks = 1,
                   .attention_factors = {}};
    NamedTensors tensors;
    add_network<UNet>(tensors, unet_prefix, config.unet, 3);
    // Random weights answer with several times the range of a picture; a tenth of it is what rain may change.
    for (auto& [name, tensor] : tensors)
        if (name.find("out.2.") != std::string::npos) tensor.mul_(0.05);
    write_model(path, tensors, config);
}

/// guided: whether the UNet looks at the guide. guide_seed: of the guiding model's weights; 0: the file has none.
inline void write_diffusion_model(const std::string& path, bool guided, uint64_t guide_seed) {
    ModelConfig config;
    config.unet = {.channels = 32,
                   .multipliers = {1, 2},
                   .res_blocks = 1,
                   .attention_factors = {2},
                   .context_channels = guided ? 3 : 0};
    const FirstStageConfig first_stage{.channels = 32, .multipliers = {1, 1, 1}, .res_blocks = 1, .codes = 512};
    NamedTensors tensors;
    add_network<UNet>(tensors, unet_prefix, config.unet, 3);
    add_network<FirstStage>(tensors, first_stage_prefix, first_stage, 4);
    UNetConfig guide = config.unet;
    guide.context_channels = 0;
    if (guide_seed != 0) add_network<UNet>(tensors, guide_prefix, guide, guide_seed);
    write_model(path, tensors, config);
}

}  // namespace pluvia
