// Materials that builders start from, and the colours of lamps.
#pragma once

#include "renderer/scene/material.h"

namespace pluvia {

// Linear Rec.709 colours of black bodies, largest channel 1.
constexpr Rgb sodium = {1, 0.30f, 0.02f};         // 2000 K
constexpr Rgb incandescent = {1, 0.40f, 0.10f};   // 2700 K
constexpr Rgb halogen = {1, 0.46f, 0.15f};        // 3000 K
constexpr Rgb neutral_white = {1, 0.64f, 0.36f};  // 4000 K
constexpr Rgb fluorescent = {1, 0.78f, 0.62f};    // 5000 K

/// The colour with a luminance of `cd_per_m2`.
Rgb nits(Rgb color, float cd_per_m2);

/// Dielectric that reflects diffusely under a more or less rough skin.
Material matte(const std::string& name, Rgb base_color, float roughness = 1);

/// Emits and reflects with one picture: a lit sign by night is a printed one by day.
Material glowing(const std::string& name, Rgb base_color, Rgb emission, int picture);

}  // namespace pluvia
