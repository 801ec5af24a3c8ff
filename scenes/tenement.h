// Houses of a Japanese shopping street: tiled or rendered, a shop or bar in every bay of the ground floor, offices
// above.
#pragma once

#include "scenes/palette.h"
#include "scenes/wall.h"

#include <string>
#include <vector>

namespace pluvia {

/// One house, in the facade frame of wall.h. One letter a bay of the ground floor, from left to right:
/// g glass doors with lit curtains, s roller shutter, n lattice door behind a noren, d dark entrance with a lamp,
/// w lit shop window, b wall
/// and one letter a storey above, from below: r ribbon of sliding windows, p pairs of windows, b blank
struct Tenement {
    std::string name = {};
    float width = 6.5f;
    std::string ground = "gs", upper = "rrr";
    float ground_height = 3.6f, storey_height = 3.05f;
    std::string wall = "brown_tiles", base = "brown_tiles", frame = "bronze_frame";  // finishes
    bool canopy = false;  // a small roof over the ground floor
    Rgb cloth = {0.5f, 0.05f, 0.04f};
    float lit = 0.5f;
    float depth = 10;
};
Assembly tenement(Palette& palette, const Tenement& house);

}  // namespace pluvia
