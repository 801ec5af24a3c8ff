// Ground of a street: carriageway with its wear and markings, kerbs, and pavements of slabs with pits for trees.
// The street runs along z from `near` down to `far` < near; x across, the carriageway between -half_width and
// half_width.
#pragma once

#include "scenes/palette.h"

namespace pluvia {

struct Road {
    float half_width = 4.4f, near = 40, far = -80;
    float crown = 0.09f;        // the middle lies this much higher than the gutters
    float kerb_height = 0.15f;  // of the pavements above the gutters
    float pavement = 4.6f;      // their width, kerb included
    uint64_t seed = 1;

    /// Height of the carriageway, gutters at 0: crown, ruts, and hollows of up to 2 cm in which puddles can stand.
    float height(float x, float z) const;
    /// x of the inner edge of a pavement's slabs and of the walls, positive.
    float wall() const { return half_width + pavement; }
};

/// Asphalt with wheel tracks, patches, manholes and a double line in the middle; "STREET/road".
void add_carriageway(Street& street, Palette& palette, const std::string& street_name, const Road& road);

/// A square hole in the slabs, with a tree's soil and an iron edge.
struct TreePit {
    float x, z, half = 0.6f;
};
/// Slabs and kerb stones on both sides.
void add_pavements(Street& street, Palette& palette, const std::string& street_name, const Road& road,
                   const std::vector<TreePit>& pits);

/// A round cover of iron, radius 0.33 m, in its own frame.
Assembly manhole(Palette& palette);

}  // namespace pluvia
