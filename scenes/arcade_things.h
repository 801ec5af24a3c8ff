// What stands, hangs and lies in a Japanese shopping street. Each in its own frame: y up, front towards +z.
#pragma once

#include "scenes/palette.h"

namespace pluvia {

/// Machine that sells drinks, 1 m wide, its front lit; origin on the ground at the middle of its back.
Assembly vending_machine(Palette& palette, uint64_t seed);

/// Post with an arm towards +z from which two lanterns hang, 4 m high. A lamp.
Assembly twin_lantern(Palette& palette);

/// Pavers in running bond on a square of `size` metres around the origin, their upper side at 0; as many squares as a
/// street needs share one mesh. paver_x, paver_z: size of one.
Assembly paver_field(Palette& palette, const std::string& finish, float size, float paver_x, float paver_z,
                     uint64_t seed);

/// Round red paper lantern under its cord.
Assembly round_lantern(Palette& palette);

}  // namespace pluvia
