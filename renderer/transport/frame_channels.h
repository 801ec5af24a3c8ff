// All channels of a frame, in the order in which bands hold them.
#pragma once

#include "renderer/transport/label_layers.h"

#include <string>
#include <vector>

namespace pluvia {

struct FrameChannels {
    std::vector<std::string> values;  // Band::planes: light and depth (layers.h), labels, mattes
    std::vector<std::string> ids;     // Band::ids
};

FrameChannels frame_channels(const std::vector<double>& intensities_mm_per_h, const LabelLayers& labels);

}  // namespace pluvia
