#include "tools/labels/label_frame.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace pluvia {
namespace {

/// "out/dry/" and "out/dry" are named "dry".
std::string own_name(const std::string& folder) {
    const auto path = std::filesystem::path(folder).lexically_normal();
    return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

}  // namespace

LabelSource label_source(const std::string& folder) {
    return {folder + "/frame.exr", folder + "/frame.json", own_name(folder)};
}

LabelFrame::LabelFrame(const LabelSource& source) : path(source.exr), name(source.name), exr_(source.exr) {
    std::ifstream file(source.json);
    if (!file)
        throw input_error(source.json, "cannot be opened (expected what pluvia render writes beside the layers)");
    width = exr_.width(), height = exr_.height();
    try {
        json = nlohmann::ordered_json::parse(file);
        if (json.contains("objects"))
            for (const auto& entry : json.at("objects")) {
                FrameObject object{entry.at("name"),
                                   entry.at("id"),
                                   entry.at("class_id"),
                                   entry.at("number"),
                                   entry.at("index"),
                                   entry.value("moves", false),
                                   entry};
                if (object.class_id < 0 || size_t(object.class_id) >= taxonomy().size())
                    throw input_error(source.json, fmt::format("object \"{}\" has no class of the taxonomy (got {})",
                                                               object.name, object.class_id));
                object_of_id_[object.id] = int(objects.size());
                objects.push_back(std::move(object));
            }
        json.at("camera").at("intrinsics").at(0).at(0).get<double>();
        view();
    } catch (const nlohmann::json::exception& e) {
        throw input_error(source.json, fmt::format("is no description of a frame ({})", e.what()));
    }
}

void LabelFrame::require_channel(const std::string& channel) const {
    if (has(channel)) return;
    const bool flow = channel.starts_with("flow");
    throw input_error(path, fmt::format("has no channel {} (expected a frame rendered with --layers {})", channel,
                                        flow                       ? "flow"
                                        : channel == "semantic.ID" ? "semantic"
                                        : channel == "instance.ID" ? "instance"
                                                                   : "all"));
}

std::vector<uint32_t> LabelFrame::ids(const std::string& channel) {
    require_channel(channel);
    std::vector<uint32_t> plane(pixels());
    const ExrRequest request{channel, plane.data()};
    exr_.read_rows(0, height, std::span(&request, 1));
    return plane;
}

std::vector<float> LabelFrame::values(const std::string& channel) {
    require_channel(channel);
    std::vector<float> plane(pixels());
    const ExrRequest request{channel, plane.data()};
    exr_.read_rows(0, height, std::span(&request, 1));
    return plane;
}

int LabelFrame::object_of(uint32_t id) const {
    const auto found = object_of_id_.find(id);
    return found == object_of_id_.end() ? -1 : found->second;
}

View LabelFrame::view(const std::string& key) const {
    const auto& camera = json.at("camera");
    const auto& m = camera.at(key);
    const auto column = [&](size_t c) {
        return Vec3d(m.at(0).at(c).get<double>(), m.at(1).at(c).get<double>(), m.at(2).at(c).get<double>());
    };
    View view;
    view.width = width, view.height = height;
    view.focal_pixels = camera.at("intrinsics").at(0).at(0).get<double>();
    view.right = column(0), view.up = column(1), view.back = column(2), view.position = column(3);
    return view;
}

}  // namespace pluvia
