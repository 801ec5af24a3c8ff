// Layouts of data sets: which pictures there are, where their cameras stand and how deep they see.
#include "renderer/image/image_io.h"
#include "tests/temporary_folder.h"
#include "tools/augment/augment_items.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <filesystem>

namespace pluvia {
namespace {

void put(const TemporaryFolder& folder, const std::string& path, const std::string& text = "") {
    std::filesystem::create_directories(std::filesystem::path(folder / path).parent_path());
    write_file(folder / path, text);
}

AugmentOptions options_of(const TemporaryFolder& folder, const std::string& dataset) {
    AugmentOptions o;
    o.input = folder.path(), o.dataset = dataset;
    return o;
}

bool near(Vec3d a, Vec3d b, double tolerance = 1e-6) {
    return length(a - b) <= tolerance;
}

}  // namespace

TEST_CASE("patterns name the pictures, and their stars the depth") {
    const TemporaryFolder folder;
    for (const char* path : {"one/rgb/a.1.png", "two/rgb/b.png", "two/rgb/b.txt", "two/other/c.png"}) put(folder, path);
    const auto found = find_matching(folder.path(), "*/rgb/*.png");
    REQUIRE(found.size() == 2);
    CHECK(found[0].path == "one/rgb/a.1.png");
    CHECK(found[0].stars == std::vector<std::string>{"one", "a.1"});
    CHECK(filled_pattern("depth/*/*.exr", found[1].stars) == "depth/two/b.exr");
}

TEST_CASE("KITTI's stereo pairs stand where their projections say and see the same drops") {
    const TemporaryFolder folder;
    for (const char* path :
         {"training/image_2/000007.png", "training/image_3/000007.png", "training/label_2/000007.txt"})
        put(folder, path);
    put(folder, "training/calib/000007.txt",
        "P0: 700 0 600 0 0 700 170 0 0 0 1 0\n"
        "P2: 700 0 600 42 0 700 170 0 0 0 1 0\nP3: 700 0 600 -336 0 700 170 0 0 0 1 0\n");
    const auto items = augment_items(options_of(folder, "kitti"));
    REQUIRE(items.size() == 2);
    CHECK(items[0].fault == "");
    CHECK(items[0].name == "image_2/000007");
    CHECK(items[0].depth.ends_with("training/depth_2/000007.png"));
    CHECK(items[0].labels.size() == 1);
    CHECK(items[0].rain == items[1].rain);
    CHECK(items[0].camera.focal_pixels == 700);
    CHECK(near(items[0].camera.world_from_camera.translation, {-0.06, 0, 0}));
    CHECK(near(items[1].camera.world_from_camera.translation, {0.48, 0, 0}));
    // One picture without calibration is at fault alone.
    put(folder, "training/image_2/000008.png");
    CHECK(augment_items(options_of(folder, "kitti"))[1].fault.find("calib/000008.txt: cannot be opened") !=
          std::string::npos);
}

TEST_CASE("KITTI's drives move through one rain: east is +X, north -Z, the camera looks ahead") {
    const TemporaryFolder folder;
    const std::string date = "2011_09_26/", drive = date + "2011_09_26_drive_0001_sync/";
    put(folder, date + "calib_cam_to_cam.txt",
        "calib_time: 09-Jan-2012 13:57:47\nR_rect_00: 1 0 0 0 1 0 0 0 1\n"
        "P_rect_02: 700 0 600 42 0 700 170 0 0 0 1 0\n");
    // The axes of velodyne and imu are forward, left, up; the camera stands 1 m before the imu.
    put(folder, date + "calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 -1\n");
    put(folder, date + "calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\nT: 0 0 0\n");
    put(folder, drive + "image_02/timestamps.txt", "2011-09-26 13:02:25.5\n2011-09-26 13:02:25.6\n");
    const double north = 8.0 / 6378137 * 180 / 3.14159265358979;  // degrees for 8 m
    const double yaw_north = std::acos(0.0);
    put(folder, drive + "oxts/data/0000000000.txt", fmt::format("0 0 110 0 0 {} 10 0 10 0 0 0", yaw_north));
    put(folder, drive + "oxts/data/0000000001.txt", fmt::format("{} 0 110 0 0 {} 10 0 10 0 0 0", north, yaw_north));
    for (const char* stem : {"0000000000", "0000000001"})
        put(folder, drive + "image_02/data/" + std::string(stem) + ".png");
    const auto items = augment_items(options_of(folder, "kitti"));
    REQUIRE(items.size() == 2);
    CHECK(items[0].fault == "");
    CHECK(items[0].rain == items[1].rain);
    const Transform &a = items[0].camera.world_from_camera, &b = items[1].camera.world_from_camera;
    CHECK(near(a.column_z, {0, 0, 1}));  // looks north
    CHECK(near(a.column_y, {0, 1, 0}));
    CHECK(near(a.translation, {-0.06, 0, -1}));
    CHECK(near(b.translation - a.translation, {0, 0, -8}, 1e-3));
    CHECK(near(items[0].camera.velocity, {0, 0, -10}));
    CHECK(items[1].camera.mid_exposure == doctest::Approx(0.1));
}

TEST_CASE("Cityscapes' cameras, speeds and labels come with its pictures; the right depth is the left one's, moved") {
    const TemporaryFolder folder;
    const std::string name = "train/aachen/aachen_000001_000019_";
    put(folder, "leftImg8bit/" + name + "leftImg8bit.png");
    put(folder, "rightImg8bit/" + name + "rightImg8bit.png");
    put(folder, "gtFine/" + name + "gtFine_labelIds.png", "ids");
    put(folder, "vehicle/" + name + "vehicle.json", R"({"speed": 9.5, "yawRate": 0})");
    put(folder, "camera/" + name + "camera.json",
        R"({"extrinsic": {"baseline": 0.2, "pitch": 0.04, "roll": 0, "yaw": 0, "x": 1.7, "y": 0.1, "z": 1.2},
            "intrinsic": {"fx": 2000, "fy": 2001, "u0": 1000, "v0": 500}})");
    std::vector<uint16_t> disparity(32, 0);
    disparity[20] = 1 + 256 * 8;   // 8 pixels: 50 m
    disparity[21] = 1 + 256 * 16;  // 25 m
    std::filesystem::create_directories(folder / "disparity/train/aachen");
    PngWriter writer(folder / ("disparity/" + name + "disparity.png"), 32, 1, 1, 16);
    writer.write_rows(0, 1, disparity.data());
    writer.finish();
    const auto items = augment_items(options_of(folder, "cityscapes"));
    REQUIRE(items.size() == 2);
    const AugmentItem &left = items[0], &right = items[1];
    CHECK(left.fault == "");
    CHECK(left.name == "leftImg8bit/train/aachen/aachen_000001_000019_leftImg8bit");
    CHECK(left.labels.size() == 1);
    CHECK(left.rain == right.rain);
    CHECK(near(left.camera.velocity, {0, 0, -9.5}));
    CHECK(near(right.camera.world_from_camera.translation, {0.2, 0, 0}));
    // The axis points down by the pitch.
    CHECK(left.camera.world_from_camera.vector({0, 0, -1}).y == doctest::Approx(-std::sin(0.04)));
    const Image<float> z = read_depth(left.depth, left.format), moved = read_depth(right.depth, right.format);
    CHECK(z.pixels[20] == doctest::Approx(50));
    CHECK(std::isnan(z.pixels[0]));
    CHECK(moved.pixels[12] == doctest::Approx(50));
    CHECK(moved.pixels[5] == doctest::Approx(25));
    CHECK(std::isnan(moved.pixels[20]));
}

TEST_CASE("nuScenes' key frames have the depth of their lidar and the pose of their car") {
    const TemporaryFolder folder;
    const auto table = [&](const std::string& name, const std::string& rows) {
        put(folder, "v1.0-mini/" + name + ".json", "[" + rows + "]");
    };
    table("sensor", R"({"token": "sc", "channel": "CAM_FRONT", "modality": "camera"},
                       {"token": "sl", "channel": "LIDAR_TOP", "modality": "lidar"})");
    // The car's axes: forward, left, up. The camera looks along them; rotation w, x, y, z.
    table("calibrated_sensor",
          R"({"token": "cc", "sensor_token": "sc", "translation": [1.5, 0, 1.5], "rotation": [0.5, -0.5, 0.5, -0.5],
              "camera_intrinsic": [[100, 0, 31.5], [0, 100, 15.5], [0, 0, 1]]},
             {"token": "cl", "sensor_token": "sl", "translation": [0.5, 0, 1.5], "rotation": [1, 0, 0, 0],
              "camera_intrinsic": []})");
    table("ego_pose", R"({"token": "e0", "translation": [1000, 2000, 0], "rotation": [1, 0, 0, 0]},
                         {"token": "e1", "translation": [1005, 2000, 0], "rotation": [1, 0, 0, 0]},
                         {"token": "unused", "translation": [0, 0, 0], "rotation": [1, 0, 0, 0]})");
    table("sample", R"({"token": "m0", "scene_token": "drive"}, {"token": "m1", "scene_token": "drive"})");
    const auto row = [](const std::string& token, int i, const std::string& kind, const std::string& file, bool key) {
        return fmt::format(
            R"({{"token": "{}", "sample_token": "m{}", "ego_pose_token": "e{}", "calibrated_sensor_token": "c{}",
                "timestamp": {}, "is_key_frame": {}, "width": 64, "height": 32, "filename": "{}"}})",
            token, i, i, kind, 1000000 + 500000 * i, key, file);
    };
    table("sample_data", row("d0", 0, "c", "samples/CAM_FRONT/f0.jpg", true) + "," +
                             row("d1", 1, "c", "samples/CAM_FRONT/f1.jpg", true) + "," +
                             row("d2", 0, "l", "samples/LIDAR_TOP/l0.pcd.bin", true) + "," +
                             row("d3", 1, "c", "sweeps/CAM_FRONT/f2.jpg", false));
    const float points[] = {21, 0, 0, 0, 0, 0.2f, 0, 0, 0, 0};  // 20 m before the camera, and on the car itself
    put(folder, "samples/LIDAR_TOP/l0.pcd.bin", std::string(reinterpret_cast<const char*>(points), sizeof points));
    const auto items = augment_items(options_of(folder, "nuscenes"));
    REQUIRE(items.size() == 2);
    CHECK(items[0].name == "samples/CAM_FRONT/f0");
    CHECK(items[0].fault == "");
    CHECK(items[1].fault.find("has no lidar") != std::string::npos);
    const Transform& camera = items[0].camera.world_from_camera;
    CHECK(near(camera.column_y, {0, 1, 0}));
    CHECK(near(camera.vector({0, 0, -1}), {1, 0, 0}));  // east, where the car heads
    CHECK(near(items[1].camera.world_from_camera.translation - camera.translation, {5, 0, 0}));
    CHECK(near(items[0].camera.velocity, {10, 0, 0}));
    CHECK(items[1].camera.mid_exposure == doctest::Approx(0.5));
    const Image<float> z = read_depth(items[0].depth, items[0].format);
    int known = 0;
    for (const float metres : z.pixels) known += !std::isnan(metres);
    CHECK(known == 1);
    CHECK(z.at(32, 16) == doctest::Approx(20));
}

}  // namespace pluvia
