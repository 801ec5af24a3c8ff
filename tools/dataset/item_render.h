// Makes one frame of a dataset: renders, checks, encodes, and puts its files and last its record in place.
#pragma once

#include "tools/dataset/record.h"
#include "tools/frame_render.h"

namespace pluvia {

/// scratch: an empty folder of the dataset's file system; left empty but for what a failure leaves.
/// ev100: an exposure that the frame shares with others; empty: its own.
/// Files of an older record that the new one no longer names are removed.
/// Throws Error: some_failed when the frame itself is at fault (values that are not finite), stopped_early when
/// progress says so, others when nothing more can be done, as on a full disk.
void make_item(const std::string& dataset, const std::string& scratch, const DatasetItem& item,
               const PictureFormat& format, const FrameScene& scene, const std::string& scene_hash,
               std::optional<double> ev100, const ProgressCallback& progress);

}  // namespace pluvia
