// A frame's labels as `pluvia render --layers ...` and datasets hold them, in memory for exports and checks.
#pragma once

#include "renderer/core/view.h"
#include "renderer/image/exr.h"
#include "renderer/scene/taxonomy.h"

#include <nlohmann/json.hpp>

#include <string>
#include <unordered_map>
#include <vector>

namespace pluvia {

/// What frame.json says of an object.
struct FrameObject {
    std::string name;
    uint32_t id = 0;
    int class_id = 0, number = 0, index = 0;
    bool moves = false;
    nlohmann::ordered_json json;  // all of it

    const LabelClass& label() const { return taxonomy()[size_t(class_id)]; }
    bool visible() const { return json.at("visible_pixels").get<int64_t>() > 0; }
};

/// Where a frame is.
struct LabelSource {
    std::string exr, json;  // files: all layers, and what frame.json says
    std::string name;       // for files that are made of it
};
/// Of a folder of `pluvia render`, by whose name the frame goes.
LabelSource label_source(const std::string& folder);

class LabelFrame {
public:
    /// Throws Error (input) when a file is missing or broken.
    explicit LabelFrame(const LabelSource& source);

    std::string path, name;  // path: of the EXR file, for messages
    nlohmann::ordered_json json;
    int width = 0, height = 0;
    std::vector<FrameObject> objects;

    size_t pixels() const { return size_t(width) * size_t(height); }
    bool has(const std::string& channel) const { return exr_.has_channel(channel); }
    /// Whole planes. Throw Error (input) naming the option of `pluvia render` that a missing one needs.
    std::vector<uint32_t> ids(const std::string& channel);
    std::vector<float> values(const std::string& channel);
    /// Index in `objects`, -1 for id 0 and for ids that frame.json does not know.
    int object_of(uint32_t id) const;
    /// "world_from_camera" or one of its neighbours: a pinhole view with positions in the file's coordinates.
    View view(const std::string& key = "world_from_camera") const;
    bool has_view(const std::string& key) const { return json.at("camera").contains(key); }

private:
    void require_channel(const std::string& channel) const;

    ExrReader exr_;
    std::unordered_map<uint32_t, int> object_of_id_;
};

}  // namespace pluvia
