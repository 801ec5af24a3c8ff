// Depth of a picture from the points of a lidar beside the camera: known in few pixels.
#pragma once

#include "renderer/core/transform.h"
#include "renderer/image/image.h"

#include <string>

namespace pluvia {

struct LidarProjection {
    Transform camera_from_lidar;  // of the camera: right, down, forward
    double focal_pixels = 0;
    Vec2 centre;                // pixels
    int width = 0, height = 0;  // 0: those of the picture, which its reader fills in
    int numbers_per_point = 5;
};

/// points: file of float32, x, y, z of each point first: five a point in nuScenes, four in KITTI. Metres along the view
/// axis; of several points in a pixel the nearest; NaN where there is none. Points nearer than 1 m belong to the car
/// that carries it. Throws Error (input) with the file.
Image<float> read_lidar_depth(const std::string& points, const LidarProjection& projection);

}  // namespace pluvia
