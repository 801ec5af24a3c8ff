// Data sets in the folders, names and calibration texts in which they are published, small: `pluvia augment --dataset`
// takes each as it is.
#include "tests/dataset_fixture.h"
#include "tests/street_pictures.h"

#include <fmt/format.h>

#include <bit>
#include <filesystem>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

struct Published {
    TemporaryFolder folder;

    std::string at(const std::string& path) const {
        fs::create_directories(fs::path(folder / ("in/" + path)).parent_path());
        return folder / ("in/" + path);
    }
    void put(const std::string& path, const std::string& text) const { write_file(at(path), text); }
    void picture(const std::string& path) const { write_rgb(at(path), 64, 32, street); }
    void depth(const std::string& path, const std::function<uint16_t(int, int)>& value = street_depth) const {
        write_grey16(at(path), 64, 32, value);
    }
    /// Points 10 m ahead of a lidar whose axes are forward, left, up.
    void scan(const std::string& path, int numbers_per_point) const {
        std::string bytes;
        for (int i = 0; i < 40; ++i) {
            const float point[] = {10, float(i % 8) - 4, float(i / 8) - 3, 0.5f, float(i)};
            bytes.append(reinterpret_cast<const char*>(point), sizeof(float) * size_t(numbers_per_point));
        }
        put(path, bytes);
    }
    Outcome run(const std::string& dataset, const std::string& more = "") const {
        return run_program(fmt::format("augment {} -o {} --dataset {} --rain 100 --spp 2 --progress none --json {}",
                                       folder / "in", folder / "out", dataset, more));
    }
    nlohmann::json record(const std::string& name) const {
        return nlohmann::json::parse(read_file(folder / ("out/records/" + name + ".json")));
    }
    /// All of these pictures got rain.
    void check(const Outcome& outcome, const std::vector<std::string>& names) const {
        CAPTURE(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        CHECK(nlohmann::json::parse(outcome.out)["made"] == names.size());
        for (const std::string& name : names) {
            CAPTURE(name);
            CHECK(fs::exists(folder / ("out/rainy_100/" + name + ".png")));
            CHECK(record(name)["pairs"][0]["coverage"] > 0);
        }
    }
};

constexpr const char* object_calib =
    "P0: 7.215377000000e+01 0 32 0 0 7.215377000000e+01 14 0 0 0 1 0\n"
    "P1: 7.215377000000e+01 0 32 -38 0 7.215377000000e+01 14 0 0 0 1 0\n"
    "P2: 7.215377000000e+01 0 32 4.485728000000e+00 0 7.215377000000e+01 14 2.163791e-01 0 0 1 2.745884e-03\n"
    "P3: 7.215377000000e+01 0 32 -3.395242000000e+01 0 7.215377000000e+01 14 2.199936e+00 0 0 1 2.729905e-03\n"
    "R0_rect: 1 0 0 0 1 0 0 0 1\n"
    "Tr_velo_to_cam: 0 -1 0 0 0 0 -1 -0.08 1 0 0 -0.27\n"
    "Tr_imu_to_velo: 1 0 0 -0.81 0 1 0 0.32 0 0 1 -0.8\n\n";

}  // namespace

TEST_CASE("KITTI's object benchmark: stereo pairs with calib and velodyne, labels kept") {
    const Published set;
    for (const char* camera : {"image_2", "image_3"}) set.picture(fmt::format("training/{}/000000.png", camera));
    set.picture("testing/image_2/000003.png");
    for (const char* stem : {"training/{}/000000", "testing/{}/000003"}) {
        set.put(fmt::format(fmt::runtime(stem), "calib") + ".txt", object_calib);
        set.scan(fmt::format(fmt::runtime(stem), "velodyne") + ".bin", 4);
    }
    set.put("training/label_2/000000.txt", "Car 0.00 0 -1.5 10 10 20 20 1.5 1.6 3.9 0 1.5 20 -1.5\n");
    set.check(set.run("kitti"), {"image_2/000000", "image_3/000000", "image_2/000003"});
    const auto depth = set.record("image_2/000000")["depth"];
    CHECK(depth["encoding"] == "lidar");
    CHECK(depth["filled_pixels"] > 64 * 32 - 41);
    CHECK(depth["sky_pixels"] == 0);
    CHECK(read_file(set.folder / "out/label_2/000000.txt").starts_with("Car 0.00"));
}

TEST_CASE("KITTI's raw drives with the depth benchmark's archives beside them, annotated or as the lidar saw it") {
    const Published set;
    const std::string date = "2011_09_26", drive = date + "_drive_0002_sync", raw = date + "/" + drive;
    set.put(date + "/calib_cam_to_cam.txt",
            "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.950000e-02\nS_rect_02: 64 32\n"
            "R_rect_00: 1 0 0 0 1 0 0 0 1\nP_rect_02: 72 0 32 4.48 0 72 14 0.21 0 0 1 0.0027\n"
            "P_rect_03: 72 0 32 -33.9 0 72 14 2.2 0 0 1 0.0027\n");
    set.put(date + "/calib_velo_to_cam.txt",
            "calib_time: 15-Mar-2012 11:37:16\nR: 0 -1 0 0 0 -1 1 0 0\nT: -0.004 -0.076 -0.27\ndelta_f: 0 0\n");
    set.put(date + "/calib_imu_to_velo.txt",
            "calib_time: 25-May-2012 16:47:16\nR: 1 0 0 0 1 0 0 0 1\nT: -0.8 0.3 -0.8\n");
    std::string times;
    for (int i = 0; i < 3; ++i) {
        times += fmt::format("2011-09-26 13:02:44.{}31879239\n", i);
        set.put(fmt::format("{}/oxts/data/{:010}.txt", raw, i),
                fmt::format("49.0{} 8.43 112.8 0.03 0.01 -1.2 -3 5 7 0.1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 4 10 4 4 0", i));
        set.picture(fmt::format("{}/image_02/data/{:010}.png", raw, i));
    }
    set.put(raw + "/image_02/timestamps.txt", times);
    set.depth("train/" + drive + "/proj_depth/groundtruth/image_02/0000000000.png");
    set.depth("data_depth_velodyne/val/" + drive + "/proj_depth/velodyne_raw/image_02/0000000001.png",
              [](int x, int y) { return x % 5 == 0 && y % 4 == 2 && y > 12 ? street_depth(x, y) : uint16_t(0); });
    set.scan(raw + "/velodyne_points/data/0000000002.bin", 4);
    set.check(set.run("kitti"),
              {drive + "/image_02/0000000000", drive + "/image_02/0000000001", drive + "/image_02/0000000002"});
    // Dense annotation leaves the sky open; what is sparse is filled.
    CHECK(set.record(drive + "/image_02/0000000000")["depth"]["sky_pixels"] == 12 * 64);
    CHECK(set.record(drive + "/image_02/0000000001")["depth"]["sky_pixels"] == 0);
    CHECK(set.record(drive + "/image_02/0000000002")["depth"]["encoding"] == "lidar");
}

TEST_CASE("KITTI's odometry sequences move by their poses, its depth selection brings intrinsics") {
    const Published set;
    set.put("dataset/sequences/04/calib.txt",
            "P0: 72 0 32 0 0 72 14 0 0 0 1 0\nP2: 72 0 32 4.6 0 72 14 -0.1 0 0 1 0.003\n"
            "Tr: 0 -1 0 0 0 0 -1 -0.06 1 0 0 -0.33\n");
    set.put("dataset/sequences/04/times.txt", "0.000000e+00\n1.036224e-01\n");
    set.put("dataset/poses/04.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0.01 0 1 0 -0.02 0 0 1 1.3\n");
    for (const char* stem : {"000000", "000001"}) {
        set.picture(fmt::format("dataset/sequences/04/image_2/{}.png", stem));
        set.scan(fmt::format("dataset/sequences/04/velodyne/{}.bin", stem), 4);
    }
    const std::string validation = "2011_09_26_drive_0002_sync_{}_0000000005_image_02";
    const std::string val = "depth_selection/val_selection_cropped/",
                      test = "depth_selection/test_depth_completion_anonymous/";
    const std::string picked = fmt::format(fmt::runtime(validation), "image");
    set.picture(val + "image/" + picked + ".png");
    set.put(val + "intrinsics/" + picked + ".txt", "72.1 0.0 32.5 0.0 72.1 14.2 0.0 0.0 1.0");
    set.depth(val + "groundtruth_depth/" + fmt::format(fmt::runtime(validation), "groundtruth_depth") + ".png");
    set.picture(test + "image/0000000000.png");
    set.put(test + "intrinsics/0000000000.txt", "72.1 0.0 32.5 0.0 72.1 14.2 0.0 0.0 1.0\n");
    set.depth(test + "velodyne_raw/0000000000.png");
    set.check(set.run("kitti"),
              {"sequences/04/image_2/000000", "sequences/04/image_2/000001", "val_selection_cropped/image/" + picked,
               "test_depth_completion_anonymous/image/0000000000"});
    // The camera looks along -z here: what KITTI's poses call +z.
    const auto camera = set.record("sequences/04/image_2/000001")["camera"]["world_from_camera"];
    CHECK(camera[2][3].get<double>() == doctest::Approx(-1.3).epsilon(0.01));
    CHECK(camera[1][3].get<double>() == doctest::Approx(0.02).epsilon(0.1).scale(0));
}

TEST_CASE("Cityscapes: splits, cities, disparity, camera, vehicle and annotations") {
    const Published set;
    for (const std::string place : {"train/aachen/aachen_000000_000019_", "val/frankfurt/frankfurt_000001_007407_"}) {
        set.picture("leftImg8bit/" + place + "leftImg8bit.png");
        set.depth("disparity/" + place + "disparity.png",
                  [](int, int y) { return y < 12 ? uint16_t(0) : uint16_t(1 + 256 * (y - 11)); });
        set.put("camera/" + place + "camera.json",
                R"({"extrinsic": {"baseline": 0.209313, "pitch": 0.038, "roll": 0.0, "x": 1.7, "y": 0.1, "yaw": -0.0195,
                    "z": 1.22}, "intrinsic": {"fx": 70.8, "fy": 70.7, "u0": 32.1, "v0": 15.9}})");
        set.put("vehicle/" + place + "vehicle.json",
                R"({"gpsHeading": 281, "gpsLatitude": 50.78, "gpsLongitude": 6.09, "outsideTemperature": 20.5,
                    "speed": 10.81, "yawRate": 0.171})");
        for (const char* label : {"labelIds.png", "instanceIds.png", "color.png"})
            set.picture("gtFine/" + place + "gtFine_" + label);
        set.put("gtFine/" + place + "gtFine_polygons.json", "{}");
    }
    set.picture("rightImg8bit/train/aachen/aachen_000000_000019_rightImg8bit.png");
    set.check(set.run("cityscapes"), {"leftImg8bit/train/aachen/aachen_000000_000019_leftImg8bit",
                                      "leftImg8bit/val/frankfurt/frankfurt_000001_007407_leftImg8bit",
                                      "rightImg8bit/train/aachen/aachen_000000_000019_rightImg8bit"});
    for (const char* label : {"labelIds.png", "instanceIds.png", "color.png", "polygons.json"}) {
        const std::string path = fmt::format("gtFine/val/frankfurt/frankfurt_000001_007407_gtFine_{}", label);
        CHECK(read_file(set.folder / ("out/" + path)) == read_file(set.folder / ("in/" + path)));
    }
}

TEST_CASE("nuScenes: tables of the small set, key frames of a camera and the lidar's sweeps") {
    const Published set;
    const std::string name = "n015-2018-07-24-11-22-45+0800__{}__15324029276{}";
    const auto table = [&](const std::string& file, const std::string& rows) {
        set.put("v1.0-mini/" + file + ".json", "[\n" + rows + "\n]");
    };
    table("sensor", R"({"token": "s1", "channel": "CAM_FRONT", "modality": "camera"},
                       {"token": "s2", "channel": "LIDAR_TOP", "modality": "lidar"})");
    table("calibrated_sensor",
          R"({"token": "c1", "sensor_token": "s1", "translation": [1.72, 0.0, 1.49],
              "rotation": [0.5, -0.5, 0.5, -0.5], "camera_intrinsic": [[70.0, 0.0, 32.0], [0.0, 70.0, 16.0], [0.0, 0.0, 1.0]]},
             {"token": "c2", "sensor_token": "s2", "translation": [0.94, 0.0, 1.84], "rotation": [1.0, 0.0, 0.0, 0.0],
              "camera_intrinsic": []})");
    table("ego_pose", R"({"token": "e1", "timestamp": 1532402927612460, "rotation": [0.57, 0.0, 0.0, -0.82],
                          "translation": [411.25, 1181.19, 0.0]})");
    table("sample",
          R"({"token": "m1", "timestamp": 1532402927647951, "prev": "", "next": "", "scene_token": "scene"})");
    const std::string picture = "samples/CAM_FRONT/" + fmt::format(fmt::runtime(name), "CAM_FRONT", "12460");
    const std::string points =
        "samples/LIDAR_TOP/" + fmt::format(fmt::runtime(name), "LIDAR_TOP", "47951") + ".pcd.bin";
    const auto data = [](const char* token, const char* calibrated, const std::string& file, const char* format,
                         int width, int height) {
        return fmt::format(
            R"({{"token": "{}", "sample_token": "m1", "ego_pose_token": "e1", "calibrated_sensor_token": "{}",
                 "timestamp": 1532402927612460, "fileformat": "{}", "is_key_frame": true, "height": {}, "width": {},
                 "filename": "{}", "prev": "", "next": ""}})",
            token, calibrated, format, height, width, file);
    };
    table("sample_data",
          data("d1", "c1", picture + ".jpg", "jpg", 64, 32) + ",\n" + data("d2", "c2", points, "pcd", 0, 0));
    set.picture(picture + ".jpg");
    set.scan(points, 5);
    set.check(set.run("nuscenes"), {picture});
    CHECK(set.record(picture)["depth"]["encoding"] == "lidar");
}

TEST_CASE("CARLA's cameras as its client saves them, with depth of 24 bits or logarithmic, and ExtremeRain's folders") {
    const Published set;
    const auto write_depth = [&](const std::string& path, bool logarithmic) {
        write_rgb(set.at(path), 64, 32, [&](int x, int y) {
            if (y < 12) return Rgba8{255, 255, 255, 255};  // the far plane, in both
            const float metres = float(street_depth(x, y)) / 256;
            const auto grey = uint8_t(std::lround(255 * (1 + std::log(metres / 1000) / 5.70378)));
            return logarithmic ? Rgba8{grey, grey, grey, 255} : encode_carla24(metres);
        });
    };
    set.picture("rgb/00001042.png");
    write_depth("depth/00001042.png", false);
    set.picture("background/seqTown01Clear_000044.jpg");
    write_depth("depth/seqTown01Clear_000044.png", true);
    for (const char* kind : {"semantic_segmentation", "instance_segmentation"})
        set.picture(fmt::format("{}/seqTown01Clear_000044.png", kind));
    set.check(set.run("carla"), {"00001042", "seqTown01Clear_000044"});
    for (const char* name : {"00001042", "seqTown01Clear_000044"})
        CHECK(set.record(name)["depth"]["sky_pixels"] == 12 * 64);
    CHECK(fs::exists(set.folder / "out/instance_segmentation/seqTown01Clear_000044.png"));
}

}  // namespace pluvia
