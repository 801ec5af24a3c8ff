// `pluvia dataset export`: a dataset in the layouts that other programs read.
#pragma once

#include "tools/dataset/config.h"

#include <string>
#include <vector>

namespace pluvia {

/// hri: HRI's own layout, lists with its nine keys, nothing else. hf: train/ and test/ with metadata.jsonl, as Hugging
/// Face's image folders. webdataset: tar shards, one sample a frame. Then those of labels/label_export.h, for frames
/// with label layers. In the order shown to users.
const std::vector<std::string>& export_formats();

/// Files are linked where the file system allows, else copied. Returns the number of pairs, of labels that of
/// frames.
/// Throws Error: usage for an unknown format or a folder that is not empty, check_failed when frames are missing.
size_t export_dataset(const DatasetConfig& config, const std::string& dataset, const std::string& format,
                      const std::string& to);

}  // namespace pluvia
