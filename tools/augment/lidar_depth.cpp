#include "tools/augment/lidar_depth.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>

namespace pluvia {

Image<float> read_lidar_depth(const std::string& path, const LidarProjection& p) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw input_error(path, "cannot be opened");
    Image<float> z(p.width, p.height, std::numeric_limits<float>::quiet_NaN());
    const auto size = std::streamsize(sizeof(float)) * p.numbers_per_point;
    for (std::array<float, 5> point; file.read(reinterpret_cast<char*>(point.data()), size);) {
        const Vec3d seen = p.camera_from_lidar.point({double(point[0]), double(point[1]), double(point[2])});
        if (!(seen.z >= 1)) continue;
        const double x = std::floor(double(p.centre.x) + p.focal_pixels * seen.x / seen.z);
        const double y = std::floor(double(p.centre.y) + p.focal_pixels * seen.y / seen.z);
        if (!(x >= 0 && x < p.width && y >= 0 && y < p.height)) continue;
        float& there = z.at(int(x), int(y));
        if (!(there <= float(seen.z))) there = float(seen.z);
    }
    if (file.gcount() != 0)
        throw input_error(path, fmt::format("ends within a point (expected {} float32 for each)", p.numbers_per_point));
    return z;
}

}  // namespace pluvia
