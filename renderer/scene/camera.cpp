#include "renderer/scene/camera.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <cmath>

namespace pluvia {

View make_view(const Camera& camera, const CameraSettings& settings) {
    View view;
    view.width = settings.width;
    view.height = settings.height;
    view.focal_pixels = settings.focal_length > 0 ? settings.focal_length / sensor_width * settings.width
                                                  : settings.height / (2 * std::tan(camera.vertical_fov / 2));
    const Transform& t = camera.scene_from_camera;
    view.position = t.translation;
    view.back = normalize(t.column_z);
    view.right = normalize(cross(t.column_y, view.back));
    view.up = cross(view.back, view.right);
    view.velocity = settings.velocity.value_or(camera.velocity);
    view.angular_velocity = camera.angular_velocity;
    if (settings.f_number > 0)
        view.lens_radius = view.focal_pixels * sensor_width / settings.width / (2 * settings.f_number);
    view.focus_distance = settings.focus_distance;
    view.exposure_time = settings.exposure_time;
    view.shutter_open = settings.mid_exposure - settings.exposure_time / 2;
    return view;
}

Camera find_camera(const Scene& scene, const std::string& choice) {
    if (choice.empty()) return scene.cameras.empty() ? framing_camera(scene) : scene.cameras.front();
    for (const Camera& camera : scene.cameras)
        if (camera.name == choice) return camera;
    if (choice.find_first_not_of("0123456789") == std::string::npos && choice.size() < 6 &&
        size_t(std::stoi(choice)) < scene.cameras.size())
        return scene.cameras[std::stoi(choice)];
    std::string names;
    for (const Camera& camera : scene.cameras) names += (names.empty() ? "" : ", ") + camera.name;
    throw usage_error("--camera", fmt::format("no such camera (got \"{}\", expected {})", choice,
                                              names.empty() ? "nothing: the scene has no camera" : names));
}

}  // namespace pluvia
