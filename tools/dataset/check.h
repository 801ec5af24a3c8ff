// `pluvia dataset check`: whether a dataset is what it says it is. Nothing is believed that a file can show.
#pragma once

#include "tools/dataset/manifest.h"

#include <string>
#include <vector>

namespace pluvia {

struct CheckReport {
    size_t frames = 0, missing = 0, files = 0;
    std::vector<std::string> faults;    // "WHERE: WHAT", in order
    std::vector<std::string> warnings;  // several builds, what could not be checked
};

/// Every frame's record and files (size, hash, decoded size, depths, masks, coverage rising with intensity, the sum of
/// the layers), the lists, the split, and that there is no file that no record names.
CheckReport check_dataset(const DatasetConfig& config, const std::string& dataset);

}  // namespace pluvia
