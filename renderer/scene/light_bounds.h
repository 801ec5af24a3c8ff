// LightBounds: a conservative summary of one light or of many, of which light_tree.h makes its hierarchy.
// Source: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting"; bounds as in
// Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", 4th edition, 12.6.3.
#pragma once

#include "renderer/core/vec.h"

namespace pluvia {

/// Where a light is, how much it sends out and into which directions.
struct LightBounds {
    Vec3 lower, upper;
    Vec3 axis = {0, 0, 1};   // mean direction of emission
    float cos_spread = -1;   // all normals lie within this cosine of the axis; -1 = everywhere
    float cos_emission = 0;  // light leaves within this cosine of each normal: 0 = a half space, 1 = only along it
    bool two_sided = false;  // emits to both sides of its normals
    float power = 0;         // not negative; relative

    Vec3 centre() const { return (lower + upper) * 0.5f; }
};

/// Bounds of both; one without power adds nothing.
LightBounds unite(LightBounds a, const LightBounds& b);

/// Cost of keeping these lights together: power times the solid angle of emission times the surface of the box.
float split_cost(const LightBounds& bounds);

}  // namespace pluvia
