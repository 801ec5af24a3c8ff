// From a scene's camera and the photographer's settings to the View that rays and rain are made from.
#pragma once

#include "renderer/core/view.h"
#include "renderer/scene/scene.h"

#include <optional>
#include <string>

namespace pluvia {

/// Width of the sensor that focal lengths and f-numbers refer to: full frame.
constexpr double sensor_width = 0.036;  // metres

struct CameraSettings {
    int width = 1024, height = 512;      // pixels
    double focal_length = 0;             // metres, for a sensor 36 mm wide; 0 = the camera's own vertical field of view
    double f_number = 0;                 // 0 = pinhole
    double focus_distance = 10;          // metres of view depth
    double exposure_time = 1.0 / 60;     // seconds
    double mid_exposure = 0;             // seconds of the sequence
    std::optional<Vec3d> velocity = {};  // m/s, where it is not to be the camera's own
};

View make_view(const Camera& camera, const CameraSettings& settings);

/// The camera named or numbered (from 0) by `choice`; empty = the first, or a framing camera when the scene has none.
/// Throws Error (usage) listing the cameras there are.
Camera find_camera(const Scene& scene, const std::string& choice);

}  // namespace pluvia
