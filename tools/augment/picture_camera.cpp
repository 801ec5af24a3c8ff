#include "tools/augment/picture_camera.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "renderer/scene/camera.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <fstream>

namespace pluvia {

using Json = nlohmann::ordered_json;

Json read_json(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw input_error(path, fmt::format("cannot be opened ({})", std::strerror(errno)));
    Json json = Json::parse(file, nullptr, false);
    if (json.is_discarded()) throw input_error(path, "is no JSON");
    return json;
}

Transform camera_from_opencv() {
    return {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {}};
}

PictureCamera camera_from_json(const Json& json, Vec3d origin, const std::string& where) {
    PictureCamera camera;
    try {
        if (json.contains("intrinsics")) {
            const Json& k = json.at("intrinsics");
            camera.focal_pixels = k.at(0).at(0).get<double>();
            camera.centre = Vec2{k.at(0).at(2).get<float>(), k.at(1).at(2).get<float>()};
        }
        if (json.contains("world_from_camera")) {
            const Json& m = json.at("world_from_camera");
            const auto column = [&](int c) {
                return Vec3d(m.at(0).at(c).get<double>(), m.at(1).at(c).get<double>(), m.at(2).at(c).get<double>());
            };
            camera.world_from_camera = {column(0), column(1), column(2), column(3) - origin};
            if (!(std::abs(camera.world_from_camera.determinant() - 1) < 1e-3))
                throw input_error(where, fmt::format("\"world_from_camera\" is no rotation (got a determinant of {:g})",
                                                     camera.world_from_camera.determinant()));
        }
        if (json.contains("exposure_time_s")) camera.exposure_time = json.at("exposure_time_s").get<double>();
        if (json.contains("shutter_open_s"))
            camera.mid_exposure = json.at("shutter_open_s").get<double>() + camera.exposure_time.value_or(0) / 2;
        if (json.contains("time_s")) camera.mid_exposure = json.at("time_s").get<double>();
        if (json.contains("velocity")) {
            const Json& v = json.at("velocity");
            camera.velocity = {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
        }
    } catch (const Json::exception& e) {
        throw input_error(where, fmt::format("is no camera ({})", e.what()));
    }
    if (json.contains("intrinsics") && !(camera.focal_pixels > 0))
        throw input_error(where, fmt::format("has no focal length (got {:g} pixels)", camera.focal_pixels));
    return camera;
}

View picture_view(const PictureCamera& camera, int width, int height, const AugmentOptions& options) {
    double focal = camera.focal_pixels;
    const double fov = options.fov.value_or(focal > 0 ? 0 : camera.fov);
    if (fov > 0) focal = width / (2 * std::tan(radians_from_degrees(fov) / 2));
    if (options.render.focal_length) focal = metres_from_mm(*options.render.focal_length) / sensor_width * width;
    if (!(focal > 0))
        throw usage_error("--fov",
                          "is needed: nothing says how wide the pictures see (or --focal-length, or "
                          "--calibration)");
    // Checked as those of a rendered camera are.
    CameraSettings settings = camera_settings(options.render);
    settings.width = width, settings.height = height;
    settings.focal_length = focal / width * sensor_width;
    settings.mid_exposure = camera.mid_exposure;
    if (camera.exposure_time) settings.exposure_time = *camera.exposure_time;
    settings.velocity =
        options.render.camera_velocity.empty() ? camera.velocity : camera.world_from_camera.vector(*settings.velocity);
    Camera placed;
    placed.scene_from_camera = camera.world_from_camera;
    View view = make_view(placed, settings);
    view.focal_pixels = focal;
    if (camera.centre) view.centre_offset = *camera.centre - Vec2{0.5f * float(width), 0.5f * float(height)};
    return view;
}

}  // namespace pluvia
