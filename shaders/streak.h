// The paper's streaks: how strongly one weighs in its composition. What one looks like is in streak_textures.h.
// Physical streaks need neither; their exact coverage is renderer/rain/coverage.h.
#pragma once

#include <algorithm>

namespace pluvia {

/// S_a tau1/T of "Learning from Rendering": the share of the exposure T that a drop hides the background of a pixel.
/// fraction: exact share for the ray; diameter and path (how far the drop moves across the ray): metres.
/// S_a, the drop's own shape, is the exact share over its value on the axis, D / (v T); tau1 = T D / (v T + D).
inline float paper_alpha(float fraction, float diameter, float path) {
    return path > diameter ? std::min(1.0f, fraction * path / diameter) * diameter / (path + diameter)
                           : fraction;  // a drop that hardly moves is no streak
}

}  // namespace pluvia
