// What frames of a dataset take, from a short measured sample of the work.
#pragma once

#include "tools/clock.h"
#include "tools/dataset/item.h"
#include "tools/progress.h"

#include <map>
#include <string>
#include <vector>

namespace pluvia {

struct FrameCost {
    SpentTime time;
    double bytes = 0;
};

/// Mean cost of the frames of these scenes on this machine, by scene, from 48 frames of all scenes together, but two to
/// eight of each, spread over its cameras and frames. Of each some pixels are traced as they are in the frame of full
/// size, with few samples, whose time is multiplied; of one of each scene a small picture is written, whose bytes and
/// time for labels and files grow with the pixels. Building a street is once a run and not in it. scratch: an empty
/// folder. Throws Error (stopped_early) when progress is interrupted.
std::map<size_t, FrameCost> measure_frame_costs(const DatasetConfig& config, const std::vector<size_t>& scenes,
                                                const std::string& scratch, Progress& progress);

}  // namespace pluvia
