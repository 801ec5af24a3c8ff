#include "tools/augment/kitti_files.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

namespace pluvia {

namespace fs = std::filesystem;

NumberTable read_number_table(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw input_error(path, "cannot be opened");
    NumberTable table;
    for (std::string line; std::getline(file, line);) {
        const size_t colon = line.find(':');
        if (colon == std::string::npos) continue;
        std::istringstream numbers(line.substr(colon + 1));
        for (double v; numbers >> v;) table[line.substr(0, colon)].push_back(v);
    }
    return table;
}

const std::vector<double>& table_numbers(const NumberTable& table, const std::string& key, size_t count,
                                         const std::string& where) {
    const auto found = table.find(key);
    if (found == table.end() || found->second.size() != count)
        throw input_error(where,
                          fmt::format("\"{}\" is missing or has another length (expected {} numbers)", key, count));
    return found->second;
}

Transform rotation_rows(const std::vector<double>& r) {
    return {{r[0], r[3], r[6]}, {r[1], r[4], r[7]}, {r[2], r[5], r[8]}, {}};
}

Transform rigid_rows(const std::vector<double>& r) {
    return {{r[0], r[4], r[8]}, {r[1], r[5], r[9]}, {r[2], r[6], r[10]}, {r[3], r[7], r[11]}};
}

Vec3d set_projection(PictureCamera& camera, const std::vector<double>& p, const std::string& where) {
    if (!(p[0] > 0)) throw input_error(where, fmt::format("has no focal length (got {:g} pixels)", p[0]));
    camera.focal_pixels = p[0];
    camera.centre = Vec2{float(p[2] + 0.5), float(p[6] + 0.5)};  // KITTI's pixel centres are whole numbers
    return {-(p[3] - p[2] * p[11]) / p[0], -(p[7] - p[6] * p[11]) / p[5], -p[11]};
}

void set_kitti_depth(AugmentItem& item, const std::vector<std::string>& pictures, const std::string& scan,
                     const Transform& camera_from_lidar) {
    item.depth = pictures.at(0);
    item.format.encoding = DepthInput::kitti16;
    for (const std::string& path : pictures)
        if (fs::exists(path)) {
            item.depth = path;
            return;
        }
    if (!fs::exists(scan)) return;
    item.depth = scan;
    item.format.encoding = DepthInput::lidar;
    item.format.lidar = std::make_shared<LidarProjection>(LidarProjection{
        .camera_from_lidar = camera_from_lidar,
        .focal_pixels = item.camera.focal_pixels,
        .centre = *item.camera.centre,
        .numbers_per_point = 4,
    });
}

}  // namespace pluvia
