// How a frame of any size is cut into overlapping tiles and how their answers are weighed where they meet.
// What is done in a tile is synthesis.h.
#pragma once

#include <vector>

namespace pluvia {

struct TileSettings {
    int size = 512;          // pixels of a side; smaller where the frame is
    int overlap = 96;        // at least, between neighbours
    bool plain = false;      // the published grid: tiles side by side, black beyond the frame
    int shift = 0;           // moves the grid to the upper left, for tests
    bool backwards = false;  // order of work; changes no bit
};

/// Tiles along one axis. Positions are pixels of the padded frame, which begins `before` pixels before the frame.
struct TileAxis {
    int size = 0;                // of a tile
    int before = 0, padded = 0;  // pixels
    int margin = 0, ramp = 0;    // of the weights: zero, then rising
    std::vector<int> positions;  // of the tiles' first pixels, multiples of the cell

    /// Raised cosine: hardly more than 0 within margin of either end, 1 from margin + ramp on.
    /// cell: pixels per value; returns size / cell weights. All 1 for plain tiles.
    std::vector<float> weights(int cell) const;
};

/// length: pixels of the frame along the axis. cell: what positions are multiples of; unit: what sizes are (a
/// multiple of cell). Throws Error (usage) when size or overlap do not fit together.
TileAxis tile_axis(int length, int cell, int unit, const TileSettings& settings);

struct TilePlan {
    TileAxis x, y;
    bool plain = false;

    int count() const { return int(x.positions.size() * y.positions.size()); }
};
TilePlan plan_tiles(int width, int height, int cell, int unit, const TileSettings& settings);

/// Index 0..length-1 of a position anywhere, reflected at both ends without repeating them.
int reflected(int position, int length);

}  // namespace pluvia
