// People who walk: a coat, a head, legs that swing, and an umbrella over some.
#pragma once

#include "scenes/palette.h"

namespace pluvia {

struct PersonLook {
    Rgb coat = {0.1f, 0.12f, 0.2f}, trousers = {0.05f, 0.05f, 0.06f}, hair = {0.03f, 0.02f, 0.02f};
    Rgb umbrella = {0.5f, 0.05f, 0.05f};
    bool has_umbrella = true;
};

constexpr float hip_height = 0.88f, hip_offset = 0.1f;  // metres: where legs turn, and how far from the middle

/// All but the legs. Front towards +z, origin on the ground below the hips.
Assembly person_body(Palette& palette, const PersonLook& look);
/// A leg that hangs from the origin.
Assembly person_leg(Palette& palette, const PersonLook& look);

}  // namespace pluvia
