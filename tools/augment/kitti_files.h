// KITTI's calibration files, and where its benchmarks keep the depth of a picture.
// Source: Geiger et al. 2013, "Vision meets Robotics: The KITTI Dataset"; the development kits of its benchmarks.
#pragma once

#include "tools/augment/augment_items.h"

#include <map>
#include <string>
#include <vector>

namespace pluvia {

/// Lines "KEY: numbers".
using NumberTable = std::map<std::string, std::vector<double>>;

/// Throws Error (input).
NumberTable read_number_table(const std::string& path);
/// Throws Error (input) with `where` if they are missing or not so many.
const std::vector<double>& table_numbers(const NumberTable& table, const std::string& key, size_t count,
                                         const std::string& where);

/// 3 x 3 numbers, row by row.
Transform rotation_rows(const std::vector<double>& r);
/// 3 x 4 numbers, row by row.
Transform rigid_rows(const std::vector<double>& r);

/// Focal length and centre of a projection 3 x 4, and where its camera is in the rectified frame of the first one,
/// right, down, forward.
Vec3d set_projection(PictureCamera& camera, const std::vector<double>& p, const std::string& where);

/// Depth from the first of `pictures` (kitti16) that is there, else from the points of the file `scan`. Where neither
/// is there, the first picture, which will be missed.
void set_kitti_depth(AugmentItem& item, const std::vector<std::string>& pictures, const std::string& scan,
                     const Transform& camera_from_lidar);

// Layouts beside those of kitti_items.cpp.
std::vector<AugmentItem> kitti_odometry_items(const std::string& root);
std::vector<AugmentItem> kitti_selection_items(const std::string& root);

}  // namespace pluvia
