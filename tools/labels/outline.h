// Outlines of regions of equal ids: polygons along the edges of pixels, exact, for formats that hold polygons.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace pluvia {

struct Outline {
    uint32_t id = 0;
    std::vector<std::array<int, 2>> points;  // [x, y] of corners, each between two edges of different direction
    int64_t area = 0;                        // enclosed, holes included, pixels
};

/// One per region of pixels that share an id and touch by an edge, the one with the largest area first: who paints them
/// in this order, each pixel whose centre is inside, gets the ids back, since what lies in a hole comes later.
std::vector<Outline> outlines(const std::vector<uint32_t>& ids, int width);

}  // namespace pluvia
