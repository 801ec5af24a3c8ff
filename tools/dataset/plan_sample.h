// A short measured sample of a dataset's work.
#pragma once

#include "tools/dataset/item.h"

#include <string>

namespace pluvia {

struct FrameCost {
    double seconds = 0;
    double bytes = 0;
};

/// Mean cost of the scene's frames on this machine, from two of them at opposite hours, with one sample per pixel,
/// whose time is multiplied. Bytes are an upper bound: a noisier picture takes more. scratch: an empty folder.
FrameCost measure_frame_cost(const DatasetConfig& config, size_t scene, const std::string& scratch);

}  // namespace pluvia
