// One exposure for all frames of a sequence, so that its light changes as the street's does and no frame pulses.
#pragma once

#include "tools/dataset/item.h"
#include "tools/dataset/scene_source.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace pluvia {

/// So many frames of a sequence, or all that it has, tell its exposure.
constexpr size_t metered_frames = 8;

/// Meters sequences once each, by the automatic exposure of the backgrounds of a few of their frames taken as one
/// picture. These are small and coarse; the value depends on the configuration alone, not on what was made before.
class SequenceExposure {
public:
    /// items: all of the dataset, whatever part of it is made here. scratch: an existing folder.
    SequenceExposure(std::vector<DatasetItem> items, std::string scratch)
        : items_(std::move(items)), scratch_(std::move(scratch)) {}

    /// Of the item's sequence; empty where frames have exposures of their own, or a fixed one.
    std::optional<double> of(const DatasetItem& item, SceneSource& source);

private:
    double meter(std::span<const DatasetItem* const> frames, SceneSource& source) const;

    std::vector<DatasetItem> items_;
    std::string scratch_;
    std::map<std::pair<size_t, std::string>, double> known_;  // by scene and camera
};

}  // namespace pluvia
