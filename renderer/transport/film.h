// The sums of a whole frame in memory, for samples that come in passes over the picture.
#pragma once

#include "renderer/transport/pixel.h"

#include <utility>
#include <vector>

namespace pluvia {

class Film {
public:
    /// intensities: how many.
    Film(const View& view, int tile_size, size_t intensities)
        : width_(view.width),
          tile_size_(tile_size),
          columns_((view.width + tile_size - 1) / tile_size),
          block_rows_(tile_size / DryPartsOfTile::block + 2),
          pixels_(size_t(view.width) * view.height, PixelFilm{{{}, std::vector<RainSums>(intensities)}, {}, {}}),
          dry_(size_t(columns_) * ((view.height + tile_size - 1) / tile_size) * block_rows_) {}

    /// Gives the scratch of a pixel what earlier passes left of it; called again it takes back what the pass has added.
    void exchange(int x, int y, PixelScratch& scratch) {
        std::swap(scratch.film, pixels_[size_t(y) * width_ + x]);
        // Blocks keep what they know of their shelter: it is found once, as by a single pass.
        const int row = y / tile_size_;
        const int block_row = y / DryPartsOfTile::block - row * tile_size_ / DryPartsOfTile::block;
        std::swap(scratch.dry, dry_[size_t(row * columns_ + x / tile_size_) * block_rows_ + block_row]);
    }

private:
    int width_, tile_size_, columns_, block_rows_;
    std::vector<PixelFilm> pixels_;
    std::vector<DryPartsOfTile> dry_;  // of each tile's rows of blocks
};

}  // namespace pluvia
