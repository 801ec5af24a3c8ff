// Trees without leaves: a trunk that forks until twigs are left. Also what they lost.
#pragma once

#include "scenes/palette.h"

namespace pluvia {

struct BareTree {
    uint64_t seed = 1;
    float height = 7;  // metres, about
    float trunk_radius = 0.13f;
    int forks = 6;        // levels of branching after the trunk
    int dry_leaves = 40;  // that still hang
};
/// Origin at the foot of the trunk.
Assembly bare_tree(Palette& palette, const BareTree& tree);

/// Fallen leaves on the ground y = height(x, z) between two corners (x, z), thicker where noise gathers them.
void add_fallen_leaves(Assembly& assembly, Palette& palette, Vec2 lower, Vec2 upper, int count,
                       const std::function<float(float x, float z)>& height, uint64_t seed);

}  // namespace pluvia
