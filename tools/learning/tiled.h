// Runs a network over the tiles of a frame and joins its answers.
#pragma once

#include "renderer/core/error.h"
#include "tools/learning/tiles.h"

#include <ATen/ATen.h>

#include <functional>

namespace pluvia {

/// Counts what is done of all tiles of all steps, and stops when the caller says so.
class TileCount {
public:
    TileCount(int total, std::function<bool(double)> report) : total_(total), report_(std::move(report)) {}
    /// Throws Error (stopped_early) when the report says false.
    void next() {
        ++done_;
        if (report_ && !report_(double(done_) / total_))
            throw Error(ExitCode::stopped_early, "learn", "was interrupted; run it again to go on");
    }

private:
    int total_, done_ = 0;
    std::function<bool(double)> report_;
};

/// A tile of a padded frame. frame: [1, channels, padded height / cell, padded width / cell]; x, y: pixels.
at::Tensor cut(const at::Tensor& frame, const TilePlan& plan, int cell, int x, int y);

/// Weighted mean of the answers where tiles overlap: [1, channels, padded height / out_cell, padded width / out_cell].
/// body(x, y): pixels of the tile in the padded frame; returns [1, channels, tile height / out_cell, ...]. The mean is
/// formed in one order, whatever the order of work.
at::Tensor over_tiles(const TilePlan& plan, int out_cell, bool backwards, TileCount& count,
                      const std::function<at::Tensor(int x, int y)>& body);

}  // namespace pluvia
