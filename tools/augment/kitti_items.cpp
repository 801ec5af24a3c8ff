// KITTI. Of the object benchmark image_2 and image_3 with calib, and depth_2 and depth_3 (kitti16); below the input or
// below its folder training. Of raw data DATE/DRIVE/image_02 and image_03 with calib_*.txt, timestamps and oxts, and
// proj_depth/groundtruth as the depth benchmark has it.
// Source: Geiger et al. 2013, "Vision meets Robotics: The KITTI Dataset", and the development kit's conversion of oxts.
#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "tools/augment/augment_items.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace pluvia {
namespace {

namespace fs = std::filesystem;
using NumberTable = std::map<std::string, std::vector<double>>;

/// Lines "KEY: numbers".
NumberTable read_table(const std::string& path) {
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

const std::vector<double>& numbers(const NumberTable& table, const std::string& key, size_t count,
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

Transform rigid(const NumberTable& table, const std::string& where) {
    Transform t = rotation_rows(numbers(table, "R", 9, where));
    const auto& move = numbers(table, "T", 3, where);
    t.translation = {move[0], move[1], move[2]};
    return t;
}

/// Focal length and centre of a projection 3 x 4, and where its camera is in the rectified frame of the first one,
/// right, down, forward.
Vec3d set_projection(PictureCamera& camera, const std::vector<double>& p, const std::string& where) {
    if (!(p[0] > 0)) throw input_error(where, fmt::format("has no focal length (got {:g} pixels)", p[0]));
    camera.focal_pixels = p[0];
    camera.centre = Vec2{float(p[2] + 0.5), float(p[6] + 0.5)};  // KITTI's pixel centres are whole numbers
    return {-(p[3] - p[2] * p[11]) / p[0], -(p[7] - p[6] * p[11]) / p[5], -p[11]};
}

std::vector<AugmentItem> object_items(const std::string& root) {
    std::vector<AugmentItem> items;
    for (const int number : {2, 3})
        for (const FoundFile& file : find_matching(root, fmt::format("image_{}/*.png", number))) {
            const std::string stem = file.stars.at(0), calib = fmt::format("{}/calib/{}.txt", root, stem);
            AugmentItem item;
            item.name = fmt::format("image_{}/{}", number, stem);
            item.picture = root + "/" + file.path;
            item.depth = fmt::format("{}/depth_{}/{}.png", root, number, stem);
            item.format.encoding = DepthInput::kitti16;
            item.rain = stem;  // both cameras of a pair
            try {
                const auto p = numbers(read_table(calib), fmt::format("P{}", number), 12, calib);
                const Vec3d place = set_projection(item.camera, p, calib);
                item.camera.world_from_camera.translation = camera_from_opencv().vector(place);
            } catch (const Error& e) {
                item.fault = e.what();
            }
            if (const std::string label = fmt::format("label_2/{}.txt", stem);
                number == 2 && fs::exists(root + "/" + label))
                item.labels.push_back({root + "/" + label, label});
            items.push_back(std::move(item));
        }
    return items;
}

/// Of one line of oxts: where the car is in the world and how it moves.
struct CarPose {
    Transform world_from_imu;  // world: east, north, up
    Vec3d velocity;
};

CarPose read_oxts(const std::string& path, double mercator_scale) {
    std::ifstream file(path);
    std::array<double, 11> v;
    for (double& value : v)
        if (!(file >> value)) throw input_error(path, "is missing or has fewer than 11 numbers");
    constexpr double earth_radius = 6378137;
    const double latitude = v[0], longitude = v[1];
    CarPose pose;
    const Transform yaw = rotate(0, 0, std::sin(v[5] / 2), std::cos(v[5] / 2));
    const Transform pitch = rotate(0, std::sin(v[4] / 2), 0, std::cos(v[4] / 2));
    const Transform roll = rotate(std::sin(v[3] / 2), 0, 0, std::cos(v[3] / 2));
    pose.world_from_imu = yaw * pitch * roll;
    pose.world_from_imu.translation = {
        mercator_scale * radians_from_degrees(longitude) * earth_radius,
        mercator_scale * earth_radius * std::log(std::tan(radians_from_degrees(90 + latitude) / 2)), v[2]};
    pose.velocity = {v[7], v[6], v[10]};
    return pose;
}

double read_latitude(const std::string& path) {
    std::ifstream file(path);
    double latitude = 0;
    if (!(file >> latitude)) throw input_error(path, "is missing or holds no numbers");
    return latitude;
}

/// Seconds of the day of each line "2011-09-26 13:02:25.964389445".
std::vector<double> read_timestamps(const std::string& path) {
    std::ifstream file(path);
    std::vector<double> times;
    for (std::string line; std::getline(file, line);) {
        int hour = 0, minute = 0;
        double second = 0;
        if (std::sscanf(line.c_str(), "%*d-%*d-%*d %d:%d:%lf", &hour, &minute, &second) != 3)
            throw input_error(path, fmt::format("line {} is no time", times.size() + 1));
        times.push_back(hour * 3600 + minute * 60 + second);
    }
    return times;
}

/// East, north, up to the axes here: east is +X, north -Z.
Transform world_from_enu() {
    return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
}

void place_in_drive(AugmentItem& item, const std::string& date, const std::string& drive, const std::string& camera,
                    const std::string& stem) {
    const std::string path = date + "/calib_cam_to_cam.txt";
    const NumberTable table = read_table(path);
    const Vec3d offset = set_projection(item.camera, numbers(table, "P_rect_" + camera, 12, path), path);
    const std::string velo = date + "/calib_velo_to_cam.txt", imu = date + "/calib_imu_to_velo.txt";
    const Transform rectified_from_imu = rotation_rows(numbers(table, "R_rect_00", 9, path)) *
                                         rigid(read_table(velo), velo) * rigid(read_table(imu), imu);
    const std::string folder = drive + "/oxts/data/", first = fmt::format("{:010}", 0);
    const double scale = std::cos(radians_from_degrees(read_latitude(folder + first + ".txt")));
    const CarPose start = read_oxts(folder + first + ".txt", scale), pose = read_oxts(folder + stem + ".txt", scale);
    Transform world_from_imu = pose.world_from_imu;
    world_from_imu.translation = world_from_imu.translation - start.world_from_imu.translation;
    item.camera.world_from_camera =
        world_from_enu() * world_from_imu * inverse(rectified_from_imu) * translate(offset) * camera_from_opencv();
    item.camera.velocity = world_from_enu().vector(pose.velocity);
    const std::vector<double> times = read_timestamps(drive + "/image_" + camera + "/timestamps.txt");
    const size_t frame = size_t(std::stoul(stem));
    if (frame >= times.size())
        throw input_error(drive + "/image_" + camera + "/timestamps.txt", fmt::format("has no line {}", frame + 1));
    item.camera.mid_exposure = times[frame] - times[0];
}

std::vector<AugmentItem> drive_items(const std::string& root) {
    std::vector<AugmentItem> items;
    for (const std::string camera : {"02", "03"})
        for (const FoundFile& file : find_matching(root, "*/*/image_" + camera + "/data/*.png")) {
            const std::string &date = file.stars.at(0), &drive = file.stars.at(1), &stem = file.stars.at(2);
            if (stem.find_first_not_of("0123456789") != std::string::npos || stem.size() > 10) continue;
            const std::string folder = root + "/" + date + "/" + drive;
            AugmentItem item;
            item.name = drive + "/image_" + camera + "/" + stem;
            item.picture = root + "/" + file.path;
            item.depth = folder + "/proj_depth/groundtruth/image_" + camera + "/" + stem + ".png";
            item.format.encoding = DepthInput::kitti16;
            item.rain = drive;
            try {
                place_in_drive(item, root + "/" + date, folder, camera, stem);
            } catch (const Error& e) {
                item.fault = e.what();
            }
            items.push_back(std::move(item));
        }
    return items;
}

}  // namespace

std::vector<AugmentItem> kitti_items(const AugmentOptions& o) {
    std::vector<AugmentItem> items;
    for (const std::string& root : {o.input, o.input + "/training"})
        for (AugmentItem& item : object_items(root)) items.push_back(std::move(item));
    for (AugmentItem& item : drive_items(o.input)) items.push_back(std::move(item));
    return items;
}

}  // namespace pluvia
