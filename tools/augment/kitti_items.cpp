// KITTI. Of the object benchmark image_2 and image_3 with calib, and depth_2 and depth_3 (kitti16) or velodyne; below
// the input or below its folders training and testing. Of raw data DATE/DRIVE/image_02 and image_03 with calib_*.txt,
// timestamps and oxts, and proj_depth as the depth benchmark has it, or velodyne_points. More in kitti_sequences.cpp.
// Source: Geiger et al. 2013, "Vision meets Robotics: The KITTI Dataset", and the development kit's conversion of oxts.
#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "tools/augment/kitti_files.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace pluvia {
namespace {

namespace fs = std::filesystem;
std::vector<AugmentItem> object_items(const std::string& root) {
    std::vector<AugmentItem> items;
    for (const int number : {2, 3})
        for (const FoundFile& file : find_matching(root, fmt::format("image_{}/*.png", number))) {
            const std::string stem = file.stars.at(0), calib = fmt::format("{}/calib/{}.txt", root, stem);
            AugmentItem item;
            item.name = fmt::format("image_{}/{}", number, stem);
            item.picture = root + "/" + file.path;
            item.rain = stem;  // both cameras of a pair
            try {
                const NumberTable table = read_number_table(calib);
                const auto p = table_numbers(table, fmt::format("P{}", number), 12, calib);
                const Vec3d place = set_projection(item.camera, p, calib);
                item.camera.world_from_camera.translation = camera_from_opencv().vector(place);
                const std::string depth = fmt::format("{}/depth_{}/{}.png", root, number, stem);
                const std::string scan = fmt::format("{}/velodyne/{}.bin", root, stem);
                Transform camera_from_lidar;
                if (!fs::exists(depth) && fs::exists(scan))
                    camera_from_lidar = translate(-place) * rotation_rows(table_numbers(table, "R0_rect", 9, calib)) *
                                        rigid_rows(table_numbers(table, "Tr_velo_to_cam", 12, calib));
                set_kitti_depth(item, {depth}, scan, camera_from_lidar);
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

Transform rigid(const std::string& path) {
    const NumberTable table = read_number_table(path);
    Transform t = rotation_rows(table_numbers(table, "R", 9, path));
    const auto& move = table_numbers(table, "T", 3, path);
    t.translation = {move[0], move[1], move[2]};
    return t;
}

/// Where the depth benchmark's archives put the depth of a drive: beside the raw data, or in folders of their own.
std::vector<std::string> drive_depth(const std::string& root, const std::string& folder, const std::string& drive,
                                     const std::string& camera, const std::string& stem) {
    std::vector<std::string> paths;
    for (const char* kind : {"groundtruth", "velodyne_raw"}) {
        const std::string below = fmt::format("proj_depth/{}/image_{}/{}.png", kind, camera, stem);
        paths.push_back(folder + "/" + below);
        for (const char* split : {"train", "val"})
            for (const char* archive : {"", "data_depth_annotated/", "data_depth_velodyne/"})
                paths.push_back(fmt::format("{}/{}{}/{}/{}", root, archive, split, drive, below));
    }
    return paths;
}

/// Returns where the lidar is seen from the camera.
Transform place_in_drive(AugmentItem& item, const std::string& date, const std::string& drive,
                         const std::string& camera, const std::string& stem) {
    const std::string path = date + "/calib_cam_to_cam.txt";
    const NumberTable table = read_number_table(path);
    const Vec3d offset = set_projection(item.camera, table_numbers(table, "P_rect_" + camera, 12, path), path);
    const std::string velo = date + "/calib_velo_to_cam.txt", imu = date + "/calib_imu_to_velo.txt";
    const Transform rectified_from_velo = rotation_rows(table_numbers(table, "R_rect_00", 9, path)) * rigid(velo);
    const Transform rectified_from_imu = rectified_from_velo * rigid(imu);
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
    return translate(-offset) * rectified_from_velo;
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
            item.rain = drive;
            try {
                const Transform camera_from_lidar = place_in_drive(item, root + "/" + date, folder, camera, stem);
                set_kitti_depth(item, drive_depth(root, folder, drive, camera, stem),
                                folder + "/velodyne_points/data/" + stem + ".bin", camera_from_lidar);
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
    const auto add = [&](std::vector<AugmentItem> more) {
        for (AugmentItem& item : more) items.push_back(std::move(item));
    };
    for (const std::string& root : {o.input, o.input + "/training", o.input + "/testing"}) add(object_items(root));
    add(drive_items(o.input));
    for (const std::string& root : {o.input, o.input + "/dataset"}) add(kitti_odometry_items(root));
    for (const std::string& root : {o.input, o.input + "/depth_selection"}) add(kitti_selection_items(root));
    return items;
}

}  // namespace pluvia
