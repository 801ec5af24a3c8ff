// Sequences in which rain goes on from frame to frame while it and the wind change.
#include "tests/dataset_fixture.h"
#include "tools/dataset/frame_keys.h"

#include <cmath>
#include <map>
#include <set>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr auto over_time =
    "size: 64x32\nspp: 1\nfps: 10\nenvironment: 80,90,100\ncomposition: paper\nstreak-width: 0.25\n"
    "rain-over-time: [[0, 40], [3, 100]]\nwind-over-time: [[1, 2, 0, 0], [3, 6, 0, -4]]\n";

/// The court of SmallDataset in sequences of four frames.
struct Sequences {
    SmallDataset dataset;
    explicit Sequences(const std::string& exposure = "6", const std::string& more = "") {
        write_file(dataset.config_path(), over_time + more +
                                              "scenes:\n  - scene: court.glb\n    frames: 4\n    hour: 13.5\n"
                                              "    exposure: " +
                                              exposure + "\n    train: [eye]\n    test: [low]\n");
    }
};

}  // namespace

TEST_CASE("values change evenly between keys, and their integral is that of the straight lines") {
    const std::vector<FrameKey> keys = {{2, {1, 0, 0}}, {4, {3, -2, 0}}, {5, {3, 0, 8}}};
    CHECK(value_at(keys, 0) == Vec3d(1, 0, 0));
    CHECK(value_at(keys, 3) == Vec3d(2, -1, 0));
    CHECK(value_at(keys, 4.5) == Vec3d(3, -1, 4));
    CHECK(value_at(keys, 9) == Vec3d(3, 0, 8));
    CHECK(integral_to(keys, 0) == Vec3d());
    CHECK(integral_to(keys, 2) == Vec3d(2, 0, 0));
    CHECK(integral_to(keys, 3) == Vec3d(3.5, -0.5, 0));
    CHECK(integral_to(keys, 6) == Vec3d(2 + 4 + 3 + 3, -2 - 1, 4 + 8));
    // Against many small steps.
    Vec3d sum;
    for (int i = 0; i < 60000; ++i) sum += value_at(keys, (i + 0.5) * 1e-4) * 1e-4;
    CHECK(length(sum - integral_to(keys, 6)) < 1e-6);
}

TEST_CASE("frames of a sequence share their rain, and each has its own noise, intensity and wind") {
    const Sequences s;
    const auto items = dataset_items(s.dataset.config());
    REQUIRE(items.size() == 8);
    std::set<uint64_t> noise, rain;
    for (const DatasetItem& item : items) {
        noise.insert(item.options.seed);
        rain.insert(item.options.rain_seed.value());
        CHECK(item.options.light.hour == 13.5);
        CHECK(item.options.rain == std::vector<double>{40.0 + 20 * item.frame});
    }
    CHECK(noise.size() == 8);
    CHECK(rain.size() == 2);
    CHECK(items[2].options.wind == std::vector<double>{4, 0, -2});
    // 0.1 s at 2 m/s, then 0.1 s at 3 m/s on average; along z 0.1 s at -1 m/s.
    CHECK(items[2].options.wind_travel[0] == doctest::Approx(0.5));
    CHECK(items[2].options.wind_travel[2] == doctest::Approx(-0.1));
    CHECK(items[2].options.wet_wind.empty());
    const Sequences wet("6", "wetness: 1\n");
    for (const DatasetItem& item : dataset_items(wet.dataset.config())) {
        REQUIRE(item.options.wet_wind.size() == 3);
        CHECK(item.options.wet_wind[0] == doctest::Approx(10.0 / 3));
        CHECK(item.options.wet_wind[2] == doctest::Approx(-4.0 / 3));
    }
    CHECK(items[2].rainy_path(80, "rain_mask", "png") == "rainy/court/eye/over_time/rain_mask/frame_0002.png");
}

TEST_CASE("extremerain.yaml plans sequences of 1000 frames of one camera: 21 of seven streets, and 3 of another") {
    const std::string path = std::string(PLUVIA_SOURCE_DIR) + "/scenes/extremerain.yaml";
    std::map<std::string, size_t> frames[2];  // by sequence
    std::set<std::string> streets[2];
    std::map<std::string, std::set<double>> hours;          // by street
    std::map<std::string, std::vector<double>> rain, wind;  // by sequence
    double least = 1e9, most = 0, strongest = 0;
    for (const DatasetItem& item : dataset_items(read_dataset_config(path))) {
        ++frames[item.is_test][item.scene_name + "/" + item.camera];
        streets[item.is_test].insert(item.options.scene);
        hours[item.options.scene].insert(item.options.light.hour);
        least = std::min(least, item.options.rain[0]), most = std::max(most, item.options.rain[0]);
        REQUIRE(item.options.layers == std::vector<std::string>{"all"});
        REQUIRE(item.options.fps == 10);
        REQUIRE(item.camera == "drive");
        // Streets run along z between houses, which keep away what is blown across.
        REQUIRE(std::abs(item.options.wind[0]) <= 0.5);
        strongest = std::max(strongest, std::hypot(item.options.wind[0], item.options.wind[2]));
        rain[item.scene_name].push_back(item.options.rain[0]);
        wind[item.scene_name].push_back(item.options.wind[2]);
    }
    CHECK(strongest > 4);
    CHECK(strongest < 5);
    for (const auto* courses : {&rain, &wind}) {
        std::set<std::vector<double>> different;
        for (const auto& [sequence, course] : *courses) different.insert(course);
        CHECK(different.size() == 24);
    }
    CHECK(frames[0].size() == 21);
    CHECK(frames[1].size() == 3);
    for (const auto& split : frames)
        for (const auto& [sequence, count] : split) CHECK_MESSAGE(count == 1000, sequence);
    for (const auto& [street, of_day] : hours) CHECK_MESSAGE((of_day == std::set<double>{12, 17.4, 20}), street);
    CHECK(least == 5);
    CHECK(most == 100);
    CHECK(streets[0].size() == 7);
    CHECK(streets[1].size() == 1);
    CHECK(!streets[0].contains(*streets[1].begin()));
}

TEST_CASE("a scene's own rain and wind over time count more than the dataset's, each by itself") {
    const Sequences s;
    const auto scene = [](const std::string& name, const std::string& more) {
        return "  - scene: court.glb\n    name: " + name + "\n    frames: 4\n    train: [eye]\n" + more;
    };
    write_file(s.dataset.config_path(), over_time + ("scenes:\n" + scene("dataset", "") +
                                                     scene("own",
                                                           "    rain-over-time: [[0, 7], [2, 9]]\n"
                                                           "    wind-over-time: [[0, 0, 0, -1]]\n") +
                                                     scene("own-rain", "    rain-over-time: [[0, 5]]\n")));
    const auto items = dataset_items(s.dataset.config());
    REQUIRE(items.size() == 12);
    CHECK(items[2].options.rain == std::vector<double>{80});
    CHECK(items[2].options.wind == std::vector<double>{4, 0, -2});
    CHECK(items[5].options.rain == std::vector<double>{8});
    CHECK(items[5].options.wind == std::vector<double>{0, 0, -1});
    CHECK(items[5].options.wind_travel[2] == doctest::Approx(-0.1));
    CHECK(items[10].options.rain == std::vector<double>{5});
    CHECK(items[10].options.wind == items[2].options.wind);
}

TEST_CASE("a sequence is made, proven, and written as a clip where ffmpeg is installed") {
    const Sequences s;
    REQUIRE(s.dataset.command("run", "out").exit_code == 0);
    const Outcome checked = s.dataset.command("check", "out");
    CHECK_MESSAGE(checked.exit_code == 0, checked.out);
    CHECK(fs::exists(s.dataset.folder / "out/rainy/court/eye/over_time/rainy_image/frame_0003.png"));
    const Json list = Json::parse(read_file(s.dataset.folder / "out/trainset.json"));
    REQUIRE(list.size() == 4);
    CHECK(list[3].at("intensity") == 100);
    const Outcome video = s.dataset.command("video", "out");
    if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) {
        CHECK(video.exit_code == 4);
        CHECK(video.err.find("apt-get install ffmpeg") != std::string::npos);
        MESSAGE("skipped: the clips themselves; apt-get install ffmpeg");
        return;
    }
    REQUIRE_MESSAGE(video.exit_code == 0, video.err);
    const std::string clip = s.dataset.folder / "out/video/court_eye.mp4";
    const std::string probe = "test $(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 " +
                              clip + " | tr -d ,) = 4";
    CHECK(std::system(probe.c_str()) == 0);
    CHECK(s.dataset.command("check", "out").exit_code == 0);  // clips are no strays
    CHECK(s.dataset.command("video", "out", "--picture depth").exit_code == 2);
}

TEST_CASE("all frames of a sequence have one exposure, also of one that is made in parts") {
    const Sequences s("auto", "lamps: off\n");
    REQUIRE(s.dataset.command("run", "whole").exit_code == 0);
    std::set<double> values;
    const auto exposure = [&](const std::string& run, const std::string& id) {
        return Json::parse(read_file(s.dataset.folder / (run + "/records/court/" + id + ".json")))["exposure_ev100"]
            .get<double>();
    };
    for (int frame = 0; frame < 4; ++frame) values.insert(exposure("whole", "eye/frame_000" + std::to_string(frame)));
    CHECK(values.size() == 1);
    CHECK(*values.begin() > 0);
    CHECK(exposure("whole", "low/frame_0000") != *values.begin());  // another camera sees something else
    REQUIRE(s.dataset.command("run", "part", "--shard 2/3").exit_code == 0);
    CHECK(exposure("part", "eye/frame_0003") == *values.begin());
}

TEST_CASE("clips of an unfinished sequence are refused") {
    const Sequences s;
    const Outcome video = s.dataset.command("video", "out");
    CHECK(video.exit_code == 1);
    CHECK(video.err.find("8 of 8 frames are missing") != std::string::npos);
}

TEST_CASE("rain over time beside rain, out of order or out of range is refused with its line") {
    const auto refused = [](const std::string& keys, const std::string& of_scene = "") {
        const Sequences s;
        write_file(s.dataset.config_path(),
                   keys + "scenes:\n  - scene: court.glb\n    frames: 4\n    train: [eye]\n" + of_scene);
        const Outcome outcome = s.dataset.command("plan", "out", "--no-sample");
        CHECK(outcome.exit_code == 2);
        return outcome.err;
    };
    CHECK(refused("rain: [10]\nrain-over-time: [[0, 5]]\n").find("both rain and rain-over-time") != std::string::npos);
    CHECK(refused("rain-over-time: [[4, 5], [2, 5]]\n").find("court.yaml:1: frames are not in order") !=
          std::string::npos);
    CHECK(refused("rain-over-time: [[0, 5000]]\n").find("0 to 1000 mm/h") != std::string::npos);
    CHECK(refused("rain-over-time: [5, 10]\n").find("has not 2 numbers") != std::string::npos);
    CHECK(refused("rain: [10]\nwind-over-time: [[0, 1, 0, 0]]\n").find("without rain-over-time") != std::string::npos);
    const std::string over_time = "rain-over-time: [[0, 5]]\n", other = "  - scene: court.glb\n    name: other\n";
    CHECK(refused(over_time, "    rain-over-tme: [[0, 5]]\n")
              .find("court.yaml:6: there is no key \"rain-over-tme\"; did you mean rain-over-time?") !=
          std::string::npos);
    CHECK(refused(over_time, "    rain-over-time: [[0, -5]]\n").find("court.yaml:6: rain-over-time is out of range") !=
          std::string::npos);
    CHECK(refused(over_time, "    rain: [10]\n").find("both rain and rain-over-time") != std::string::npos);
    CHECK(refused("rain: [10]\n", "    wind-over-time: [[0, 1, 0, 0]]\n").find("without rain-over-time") !=
          std::string::npos);
    CHECK(refused("", "    rain-over-time: [[0, 5]]\n" + other + "    frames: 1\n    train: [eye]\n    rain: [5]\n")
              .find("others none") != std::string::npos);
}

}  // namespace pluvia
