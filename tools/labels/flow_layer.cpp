#include "tools/labels/flow_layer.h"

#include "renderer/transport/label_layers.h"
#include "tools/labels/label_export.h"

#include <filesystem>

namespace pluvia {

Flow flow_layer(LabelFrame& frame, const std::string& layer, bool only_visible) {
    Flow flow{frame.width, frame.height, frame.values(layer + ".U"), frame.values(layer + ".V"), {}};
    for (const float value : frame.values(layer + ".occlusion")) {
        const auto visibility = FlowVisibility(int(value));
        flow.valid.push_back(visibility == FlowVisibility::visible ||
                             (!only_visible && visibility != FlowVisibility::behind));
    }
    return flow;
}

void export_flo(LabelFrame& frame, const std::string& folder) {
    std::filesystem::create_directories(folder + "/flow");
    write_flo(folder + "/flow/" + frame.name + "_fwd.flo", flow_layer(frame, "flow_fwd", false));
    write_flo(folder + "/flow/" + frame.name + "_bwd.flo", flow_layer(frame, "flow_bwd", false));
}

}  // namespace pluvia
