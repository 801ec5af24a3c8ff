// A frame on disk: frame.exr with all layers, and frame.json with everything needed to repeat it.
// Neither holds a time, a host, a path or a number of threads: the same frame has the same bytes everywhere.
#pragma once

#include "renderer/image/exposure.h"
#include "renderer/image/exr.h"
#include "renderer/transport/frame_channels.h"
#include "tools/render_options.h"

namespace pluvia {

/// What is known of a frame before its pixels.
struct FrameHeader {
    std::string scene_name;
    uint64_t scene_hash = 0;
    Vec3d scene_origin;
    std::string camera_name;
    View view;
    nlohmann::ordered_json options;  // of the command line
    std::vector<double> intensities;
    LabelLayers labels = {};
    std::map<std::string, std::string> label_entries = {};  // of the EXR file's header
    std::optional<View> next = {}, previous = {};           // with flow: of the frames after and before
    bool things_move = false;                               // to or from those, not only the camera
};

/// Header entries of frame.exr: version, scene, settings, camera matrices, units; the exposure is not known yet (NaN).
ExrAttributes exr_attributes(const FrameHeader& header);

/// Writes bands of layers to an EXR file and meters the background on the way.
class FrameWriter {
public:
    FrameWriter(const std::string& path, const FrameHeader& header);
    void write(const Band& band);
    /// ev100: the exposure that the pictures beside the file have, for its header.
    void finish(double ev100);
    const LuminanceHistogram& background_luminance() const { return histogram_; }

private:
    ExrWriter writer_;
    LuminanceHistogram histogram_;
};

/// JSON as text, on one line unless indented. Bytes that are not UTF-8, as names of files may have them, become U+FFFD.
std::string json_text(const nlohmann::ordered_json& json, int indent = -1);

/// Writes text under a temporary name and renames it. Throws Error (render_failed) when that is impossible.
void write_text(const std::string& path, const std::string& text);

/// The object of frame.json. ev100: the exposure of the pictures beside it. objects: of frame_objects.h, or null.
nlohmann::ordered_json frame_json(const FrameHeader& header, double ev100, const Counters& counters,
                                  const nlohmann::ordered_json& objects = {});

}  // namespace pluvia
