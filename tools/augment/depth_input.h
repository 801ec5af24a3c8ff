// Depth as data sets store it, made whole: every pixel gets a depth or is sky, and what was filled in is counted.
#pragma once

#include "renderer/image/image.h"
#include "tools/augment/lidar_depth.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pluvia {

/// carla: carla24 where the file is coloured, carla_log where it is grey. metres: EXR (Z) or NPY. disparity: 16 bits,
/// (value - 1) / 256 pixels, 0 = none. The others: renderer/image/depth_encoding.h.
enum class DepthInput { kitti16, mm16, carla24, carla_log, carla, metres, disparity, lidar };

/// Names in the order of the enum.
const std::vector<std::string>& depth_input_names();
/// Throws Error (usage) with the list of names for any other, and for lidar, which only a data set brings.
DepthInput depth_input_from_name(const std::string& name, const std::string& where);

struct DepthFormat {
    DepthInput encoding = DepthInput::metres;
    double focal_times_baseline = 0;  // pixels * metres, of disparities: depth is this over the disparity
    /// The disparity belongs to the left picture of a pair and the depth wanted to the right one: what the left one
    /// does not see is not known.
    bool seen_from_right = false;
    std::shared_ptr<const LidarProjection> lidar = nullptr;  // of the encoding lidar
};

/// As stored: metres along the view axis, +inf where the file says that there is nothing, NaN where it does not know.
/// Throws Error (input) with the file.
Image<float> read_depth(const std::string& path, const DepthFormat& format);

struct DepthFilling {
    int64_t filled = 0;  // pixels without depth that took that of the nearest one with a depth
    int64_t sky = 0;     // pixels of the sky: those the file says and those below
    int64_t assumed_sky = 0;
};

/// Fills what is NaN in place. Where more than half of the pixels are known, unknown ones that reach the top edge are
/// sky; all others take the depth of the nearest known pixel, to within a pixel. Depth from a lidar, known in fewer
/// places, has no sky. where: the file. Throws Error (input) where nothing is known.
DepthFilling fill_depth(Image<float>& z, const std::string& where);

}  // namespace pluvia
