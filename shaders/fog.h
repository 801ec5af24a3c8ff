// How a droplet of fog scatters light: forwards, without a rainbow, and without absorbing any.
#pragma once

#include "renderer/core/sampling.h"
#include "renderer/core/transform.h"

namespace pluvia {

/// Mean cosine of the angle by which fog turns light. Source: van de Hulst 1957, "Light Scattering by Small Particles",
/// chapter 13: 0.85 for water droplets large against the wavelength, diffraction included.
constexpr float fog_asymmetry = 0.85f;

/// Phase function, 1/sr. cos_theta: cosine of the turn angle, 1 = straight through.
/// Source: Henyey and Greenstein 1941, equation 2.
inline float fog_phase(float cos_theta) {
    constexpr float g = fog_asymmetry;
    const float d = 1 + g * g - 2 * g * cos_theta;
    return (1 - g * g) / (4 * pi * d * std::sqrt(d));
}

/// Direction of travel after the droplet, with pdf fog_phase(dot(direction, result)); direction: before, unit.
inline Vec3 sample_fog_phase(Vec3 direction, Vec2 u) {
    constexpr float g = fog_asymmetry;
    const float s = (1 - g * g) / (1 - g + 2 * g * u.x);
    const float cos_theta = std::clamp((1 + g * g - s * s) / (2 * g), -1.0f, 1.0f);
    const float sin_theta = std::sqrt(std::max(0.0f, (1 - cos_theta) * (1 + cos_theta))), phi = 2 * pi * u.y;
    return ShadingBasis(direction).to_world({sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta});
}

}  // namespace pluvia
