// The flow layers of a frame as a Flow.
#pragma once

#include "tools/labels/flow_file.h"
#include "tools/labels/label_frame.h"

namespace pluvia {

/// layer: "flow_fwd" or "flow_bwd". Valid is what has a place in front of the other camera; with only_visible, what is
/// seen there.
Flow flow_layer(LabelFrame& frame, const std::string& layer, bool only_visible);

}  // namespace pluvia
