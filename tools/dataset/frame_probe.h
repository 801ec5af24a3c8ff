// What one frame of a dataset takes, part by part, without making all of it.
#pragma once

#include "tools/clock.h"
#include "tools/dataset/config.h"
#include "tools/dataset/item.h"
#include "tools/frame_render.h"

#include <string>

namespace pluvia {

struct TracingCost {
    SpentTime ready;   // until the first ray: light, acceleration structures, streaks
    SpentTime sample;  // one for all pixels
    int samples = 0;   // per pixel
};
/// Traces some pixels of the frame at its full size with few samples. folder: an existing one.
TracingCost probe_tracing(const DatasetItem& item, const FrameScene& scene, const std::string& folder);

struct FilesCost {
    SpentTime time;   // from the first ray on: samples and labels of all pixels, and all files
    int samples = 0;  // per pixel
    double bytes = 0;
};
/// Makes the frame's files as a small picture of few samples, whose time and bytes grow with the pixels.
/// folder: an empty one, left empty. progress: of its rendering.
FilesCost probe_files(const DatasetItem& item, const PictureFormat& pictures, const FrameScene& scene,
                      const std::string& folder, const ProgressCallback& progress);

}  // namespace pluvia
