// Where and how a picture was taken, from the calibration files of data sets. Axes as everywhere here: the world has +Y
// up, a camera looks along its -z with +y up and +x to the right.
#pragma once

#include "renderer/core/transform.h"
#include "renderer/core/view.h"
#include "tools/augment/augment_options.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace pluvia {

struct PictureCamera {
    double focal_pixels = 0;      // 0: not known
    double fov = 0;               // degrees across the picture, where the above is not known; 0: not known either
    std::optional<Vec2> centre;   // where the axis meets the picture, pixels; empty: its middle
    Transform world_from_camera;  // scale is none
    double mid_exposure = 0;      // seconds
    std::optional<double> exposure_time;
    Vec3d velocity;  // m/s, world
};

/// A camera as frame.json has it. origin: subtracted from its place. where: file and key, for errors (input).
PictureCamera camera_from_json(const nlohmann::ordered_json& json, Vec3d origin, const std::string& where);

/// A JSON file, parsed. Throws Error (input).
nlohmann::ordered_json read_json(const std::string& path);

/// Rotation of axes right, down, forward, as OpenCV, KITTI and nuScenes have them, to those here.
Transform camera_from_opencv();

/// What a camera sees of rain with the options' lens. Throws Error (usage) where the focal length is not known.
View picture_view(const PictureCamera& camera, int width, int height, const AugmentOptions& options);

}  // namespace pluvia
