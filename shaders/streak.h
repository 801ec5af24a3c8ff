// The paper's streaks: how strongly one weighs in its composition, and the brightness along it.
// Physical streaks need neither; their exact coverage is renderer/rain/coverage.h.
#pragma once

#include "renderer/core/random.h"
#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pluvia {

/// S_a tau1/T of "Learning from Rendering": the share of the exposure T that a drop hides the background of a pixel.
/// fraction: exact share for the ray; diameter and path (how far the drop moves across the ray): metres.
/// S_a, the drop's own shape, is the exact share over its value on the axis, D / (v T); tau1 = T D / (v T + D).
inline float paper_alpha(float fraction, float diameter, float path) {
    return path > diameter ? std::min(1.0f, fraction * path / diameter) * diameter / (path + diameter)
                           : fraction;  // a drop that hardly moves is no streak
}

/// Brightness along a streak about a mean of 1: the oblate-prolate oscillation that makes photographed streaks speckle.
/// diameter: metres; time: seconds since the shutter opened; key: of the drop, decides its phase and amplitude.
/// Frequency: Rayleigh 1879, mode 2: omega^2 = 8 sigma / (rho r^3), sigma = 0.0728 N/m. The amplitudes, 0.2 to 0.5, are
/// chosen by eye after the streak database of Garg and Nayar 2006.
inline float streak_texture(float diameter, float time, uint64_t key) {
    const double radius = 0.5 * diameter;
    const double omega = std::sqrt(8 * 0.0728 / (1000 * radius * radius * radius));
    const float amplitude = 0.2f + 0.3f * unit_float(hash_key(key, 1));
    return 1 + amplitude * float(std::cos(omega * time + 2 * pi * unit_float(hash_key(key, 2))));
}

}  // namespace pluvia
