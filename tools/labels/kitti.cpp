#include "renderer/core/units.h"
#include "tools/frame_file.h"
#include "tools/labels/flow_layer.h"
#include "tools/labels/label_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

Vec3d vector_from(const Json& j) {
    return {j.at(0), j.at(1), j.at(2)};
}

/// KITTI's camera looks along +z with y down.
Vec3d in_camera(const View& view, Vec3d world_vector) {
    return {dot(world_vector, view.right), -dot(world_vector, view.up), -dot(world_vector, view.back)};
}

double in_half_turn(double angle) {
    return std::remainder(angle, 2 * std::numbers::pi);
}

/// One line of label_2; empty for what KITTI has no type for, or nobody sees.
std::string label_line(const LabelFrame& frame, const FrameObject& object) {
    if (object.label().kitti_type.empty() || !object.visible() || !object.json.contains("box_3d")) return "";
    const View view = frame.view();
    const double fraction = object.json.at("visible_fraction");
    const int occluded = fraction >= 0.8 ? 0 : fraction >= 0.4 ? 1 : 2;
    const Json& box = object.json.at("amodal_box");
    // The centre of the first pixel is 0 there and 1/2 here.
    const auto edge = [&](size_t k, int size) { return std::clamp(box.at(k).get<double>() - 0.5, 0.0, size - 1.0); };
    const Json& solid = object.json.at("box_3d");
    const Vec3d size = vector_from(solid.at("size")), up = vector_from(solid.at("axes").at(1));
    const Vec3d front = in_camera(view, vector_from(solid.at("axes").at(2)));
    const Vec3d bottom = in_camera(view, vector_from(solid.at("center")) - up * (size.y / 2) - view.position);
    const double rotation = std::atan2(-front.z, front.x);  // 0: it faces along the camera's x
    const double alpha = in_half_turn(rotation - std::atan2(bottom.x, bottom.z));
    return fmt::format(
        "{} {:.2f} {} {:.4f} {:.2f} {:.2f} {:.2f} {:.2f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f} {:.4f}\n",
        object.label().kitti_type, object.json.at("truncated").get<double>(), occluded, alpha, edge(0, frame.width),
        edge(1, frame.height), edge(2, frame.width), edge(3, frame.height), size.y, size.x, size.z, bottom.x, bottom.y,
        bottom.z, rotation);
}

/// All four cameras are the same one, rectified; there is no laser scanner, so its frame is the camera's.
std::string calibration(const LabelFrame& frame) {
    const double f = frame.view().focal_pixels, cx = frame.width / 2.0 - 0.5, cy = frame.height / 2.0 - 0.5;
    std::string text;
    for (int k = 0; k < 4; ++k)
        text += fmt::format("P{}: {:.12e} 0 {:.12e} 0 0 {:.12e} {:.12e} 0 0 0 1 0\n", k, f, cx, f, cy);
    text += "R0_rect: 1 0 0 0 1 0 0 0 1\n";
    for (const char* key : {"Tr_velo_to_cam", "Tr_imu_to_velo"})
        text += fmt::format("{}: 1 0 0 0 0 1 0 0 0 0 1 0\n", key);
    return text;
}

/// Row-major 3 x 4: from a frame's camera to that of the first frame, both with y down.
std::string pose_line(const View& first, const View& view) {
    const Vec3d x = in_camera(first, view.right), y = in_camera(first, -view.up), z = in_camera(first, -view.back),
                t = in_camera(first, view.position - first.position);
    std::string text;
    for (int r = 0; r < 3; ++r)
        text += fmt::format("{}{:.9e} {:.9e} {:.9e} {:.9e}", r == 0 ? "" : " ", x[r], y[r], z[r], t[r]);
    return text + "\n";
}

}  // namespace

void export_kitti(const std::vector<LabelSource>& frames, const std::string& folder) {
    for (const char* part : {"label_2", "calib"}) std::filesystem::create_directories(folder + "/" + part);
    std::string poses;
    std::optional<View> first;
    for (const LabelSource& source : frames) {
        LabelFrame frame(source);
        std::string labels;
        for (const FrameObject& object : frame.objects) labels += label_line(frame, object);
        write_text(folder + "/label_2/" + frame.name + ".txt", labels);
        write_text(folder + "/calib/" + frame.name + ".txt", calibration(frame));
        if (!first) first = frame.view();
        poses += pose_line(*first, frame.view());
        if (!frame.has("flow_fwd.U")) continue;
        for (const bool only_visible : {false, true}) {
            const std::string flow = folder + (only_visible ? "/flow_noc" : "/flow_occ");
            std::filesystem::create_directories(flow);
            write_kitti_flow(flow + "/" + frame.name + ".png", flow_layer(frame, "flow_fwd", only_visible));
        }
    }
    write_text(folder + "/poses.txt", poses);
}

}  // namespace pluvia
