// What a file of weights holds: which networks, how they were trained, and what of it can be used.
// The networks themselves are loaded by synthesis.h.
#pragma once

#include "tools/learning/network_config.h"
#include "tools/learning/schedule.h"

#include <optional>

namespace pluvia {

/// Where networks are in a file, as in the published checkpoints.
constexpr const char* unet_prefix = "model.diffusion_model.";
constexpr const char* first_stage_prefix = "first_stage_model.";
constexpr const char* guide_prefix = "gdm.model.diffusion_model.";

struct ModelConfig {
    /// diffusion: the published way with a first stage; without one, cells of fold x fold pixels, conditioned on clean
    /// picture and coverage, become the change of the picture. regression: a single pass of the UNet on pixels, clean
    /// picture and coverage in, the change of the picture out.
    enum class Kind { diffusion, regression } kind = Kind::diffusion;
    UNetConfig unet;
    std::optional<FirstStageConfig> first_stage;  // of diffusion
    int fold = 1;                                 // without a first stage: pixels along a side of a cell
    bool tells_velocity = false;                  // diffusion's networks tell velocity (losses.h), else noise
    std::optional<UNetConfig> guide;              // only where the UNet looks at it
    DiffusionConfig diffusion;
    std::vector<std::string> notices;             // what the user should know, a line each
    std::map<std::string, std::string> metadata;  // as stored
};

constexpr int regression_channels = 4;  // red, green and blue in -1..1, coverage in 0..1

/// Throws Error (input) when networks are missing or do not fit together.
ModelConfig model_config(const SafetensorsFile& file);

/// Metadata of a model that is written; model_config() reads it back.
std::map<std::string, std::string> model_metadata(const ModelConfig& config);

const char* model_kind_name(ModelConfig::Kind kind);

}  // namespace pluvia
