// CRIGNet: which rain picture a label and a latent make. What its file of weights holds; the network is crig.h.
// Source: CARLARain (CRIG_FastGAN_256), whose generator is that of Liu et al. 2021 (FastGAN).
#pragma once

#include "tools/learning/safetensors.h"

namespace pluvia {

/// The generator's tensors in a checkpoint, which also holds an encoder that inference does not need.
constexpr const char* crig_prefix = "decoder.";
constexpr int crig_side = 256;        // pixels
constexpr int crig_labels = 2;        // intensity and wind
constexpr double crig_mm_per_h = 50;  // label 0; -1 is no rain, 1 twice as much

/// Defaults: as published.
struct CrigConfig {
    int64_t latent = 128;   // values from a normal distribution
    int64_t channels = 64;  // of 128 pixels; 16 times as many of 4 pixels
};

/// Whether a file holds this network and no other of this module.
bool is_crig(const SafetensorsFile& file);
/// What shapes tell. Throws Error (input) for networks of another size than 256 pixels.
CrigConfig crig_config(const SafetensorsFile& file);

/// The label is (intensity / crig_mm_per_h - 1, wind), both -1 to 1. Throws Error (usage) beyond 0 to 100 mm/h or -1
/// to 1.
struct CrigLabel {
    float intensity = 0, wind = 0;
};
CrigLabel crig_label(double intensity_mm_per_h, double wind);

}  // namespace pluvia
