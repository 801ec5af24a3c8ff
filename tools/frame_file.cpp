#include "tools/frame_file.h"

#include "renderer/image/pending_file.h"

#include <fmt/format.h>

#include <limits>

namespace pluvia {
namespace {

constexpr auto exposure_attribute = "pluvia:exposure_ev100";

std::vector<ExrChannel> exr_channels(const FrameHeader& header) {
    const FrameChannels names = frame_channels(header.intensities, header.labels);
    std::vector<ExrChannel> channels;
    for (const std::string& name : names.values) channels.push_back({name, false});
    for (const std::string& name : names.ids) channels.push_back({name, true});
    return channels;
}

/// worldToCamera and worldToNDC as the OpenEXR standard attributes have them, for points of the file's coordinates.
std::array<float, 16> world_to_camera(const View& view, Vec3d origin) {
    std::array<float, 16> m = {};
    const Vec3d axes[3] = {view.right, view.up, view.back};
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) m[4 * r + c] = float(axes[c][r]);
        m[12 + c] = float(-dot(axes[c], view.position + origin));
    }
    m[15] = 1;
    return m;
}

std::array<float, 16> multiply(const std::array<float, 16>& a, const std::array<float, 16>& b) {
    std::array<float, 16> m = {};
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
            for (int k = 0; k < 4; ++k) m[4 * r + c] += a[4 * r + k] * b[4 * k + c];
    return m;
}

/// Perspective to x and y in -1..1, depth left as it is (row vectors, camera looks along -z).
std::array<float, 16> camera_to_ndc(const View& view) {
    std::array<float, 16> m = {};
    m[0] = float(2 * view.focal_pixels / view.width);
    m[5] = float(2 * view.focal_pixels / view.height);
    m[8] = float(-2 * view.centre_offset.x / view.width);
    m[9] = float(2 * view.centre_offset.y / view.height);
    m[10] = -1;
    m[11] = -1;
    return m;
}

/// 4 x 4, columns: the camera's axes and its place in the file's coordinates.
nlohmann::ordered_json world_from_camera(const View& v, Vec3d origin) {
    const Vec3d p = v.position + origin;
    const auto row = [](Vec3d a, double t) { return nlohmann::ordered_json{a.x, a.y, a.z, t}; };
    return {row({v.right.x, v.up.x, v.back.x}, p.x),
            row({v.right.y, v.up.y, v.back.y}, p.y),
            row({v.right.z, v.up.z, v.back.z}, p.z),
            {0, 0, 0, 1}};
}

std::vector<float> floats(Vec3d v) {
    return {float(v.x), float(v.y), float(v.z)};
}

}  // namespace

ExrAttributes exr_attributes(const FrameHeader& h) {
    const auto to_camera = world_to_camera(h.view, h.scene_origin);
    ExrAttributes entries(h.label_entries.begin(), h.label_entries.end());
    entries.merge(
        ExrAttributes{{"pluvia:version", PLUVIA_VERSION},
                      {"pluvia:scene", h.scene_name},
                      {"pluvia:scene_hash", fmt::format("{:016x}", h.scene_hash)},
                      {"pluvia:camera", h.camera_name},
                      {"pluvia:settings", json_text(h.options)},
                      {"pluvia:units", "radiance: cd/m2, linear Rec.709; Z, distance: metres"},
                      {"pluvia:intensities_mm_per_h", std::vector<float>(h.intensities.begin(), h.intensities.end())},
                      {"pluvia:camera_velocity", floats(h.view.velocity)},
                      {"pluvia:shutter_open", h.view.shutter_open},
                      {exposure_attribute, std::numeric_limits<float>::quiet_NaN()},
                      {"expTime", h.view.exposure_time},
                      {"worldToCamera", to_camera},
                      {"worldToNDC", multiply(to_camera, camera_to_ndc(h.view))}});
    return entries;
}

FrameWriter::FrameWriter(const std::string& path, const FrameHeader& header)
    : writer_(path, header.view.width, header.view.height, exr_channels(header), exr_attributes(header)) {}

void FrameWriter::write(const Band& band) {
    std::vector<ExrRows> rows;
    for (const auto& plane : band.planes) rows.push_back(plane.data());
    for (const auto& ids : band.ids) rows.push_back(ids.data());
    writer_.write_rows(band.y, band.rows, rows);
    for (size_t i = 0; i < band.planes[0].size(); ++i)
        histogram_.add({band.planes[0][i], band.planes[1][i], band.planes[2][i]});
}

void FrameWriter::finish(double ev100) {
    writer_.set_attribute(exposure_attribute, float(ev100));
    writer_.finish();
}

std::string json_text(const nlohmann::ordered_json& json, int indent) {
    return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void write_text(const std::string& path, const std::string& text) {
    PendingFile file(path);
    file.stream() << text;
    file.commit();
}

nlohmann::ordered_json frame_json(const FrameHeader& h, double ev100, const Counters& counters,
                                  const nlohmann::ordered_json& objects) {
    const View& v = h.view;
    nlohmann::ordered_json j;
    j["version"] = PLUVIA_VERSION;
    j["scene"] = {{"name", h.scene_name},
                  {"hash", fmt::format("{:016x}", h.scene_hash)},
                  {"origin", {h.scene_origin.x, h.scene_origin.y, h.scene_origin.z}}};
    j["settings"] = h.options;
    j["camera"] = {{"name", h.camera_name},
                   {"world_from_camera", world_from_camera(v, h.scene_origin)},
                   {"axes", "x right, y up, looks along -z"},
                   {"intrinsics",
                    {{v.focal_pixels, 0, v.width / 2.0 + v.centre_offset.x},
                     {0, v.focal_pixels, v.height / 2.0 + v.centre_offset.y},
                     {0, 0, 1}}},
                   {"shutter_open_s", v.shutter_open},
                   {"exposure_time_s", v.exposure_time}};
    if (h.next) j["camera"]["world_from_camera_next"] = world_from_camera(*h.next, h.scene_origin);
    if (h.previous) j["camera"]["world_from_camera_previous"] = world_from_camera(*h.previous, h.scene_origin);
    if (h.next) j["things_move"] = h.things_move;
    j["exposure_ev100"] = ev100;
    j["units"] = {{"radiance", "cd/m2, linear Rec.709"}, {"depth", "metres"}};
    for (size_t i = 0; i < h.intensities.size(); ++i)
        j["layers"][intensity_label(h.intensities[i])] = {{"intensity_mm_per_h", h.intensities[i]}};
    if (!objects.is_null()) j["objects"] = objects;
    for (size_t i = 0; i < feature_names.size(); ++i) j["feature_calls"][feature_names[i]] = counters.calls[i];
    j["invalid_samples"] = counters.invalid_samples;
    return j;
}

}  // namespace pluvia
