// Where water stands and how unevenly a film lies, as functions of the place in the world: the same from every camera,
// in every frame and for any mesh.
#pragma once

#include "renderer/core/vec.h"

namespace pluvia {

/// Smooth noise about 0, mostly within -1 to 1, with features a few tenths of a unit and more in size.
/// Source: Perlin 2002, "Improving Noise", with hashed gradients; three octaves.
float ground_noise(Vec3d p);

/// How deep a puddle is: 0 = none, 1 = deep enough for a flat surface. share: of level ground that water stands on, 0
/// to 1. The ground is uneven over metres and decimetres; it is the hollows that fill first.
/// margin: 1 in and close to the puddle, falling to 0 within a few decimetres: ground that is damp from it.
struct Puddle {
    float depth = 0, margin = 0;
};
Puddle puddle_at(Vec3d world, float share);

}  // namespace pluvia
