// What the pictures of one frame must have in common, as read back from its files.
#pragma once

#include "tools/dataset/record.h"

#include <string>
#include <vector>

namespace pluvia {

// The layers add up to the rainy picture, but files are rounded and the background is a JPEG: blocks of 16 pixels a
// side may be off by this many of 255 displayed levels on average, and the whole picture by that many, beyond twice
// what the codec does to the rainy picture's own blocks.
constexpr float block_tolerance = 4, picture_tolerance = 1;

/// Faults of a frame whose files have the recorded bytes, each "PATH: WHAT". Throws Error (input) for one that is no
/// picture.
std::vector<std::string> item_faults(const std::string& dataset, const DatasetItem& item, const Record& record);

}  // namespace pluvia
