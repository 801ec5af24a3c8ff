// Masks as COCO's uncompressed run lengths: counts of pixels, column by column from the left, beginning with those
// outside. Source: COCO's mask API.
#pragma once

#include <cstdint>
#include <vector>

namespace pluvia {

/// Of the pixels that have this id; rows from the top.
std::vector<int64_t> run_lengths(const std::vector<uint32_t>& ids, int width, uint32_t id);
/// The mask, 0 or 1, rows from the top. Throws Error (input) when the counts do not add up to width * height.
std::vector<uint8_t> mask_from_run_lengths(const std::vector<int64_t>& counts, int width, int height);

}  // namespace pluvia
