// Configurations of datasets: what they mean, and what is said about mistakes.
#include "tests/dataset_fixture.h"
#include "tools/dataset/item.h"
#include "tools/dataset/suggestion.h"
#include "tools/quality.h"

#include <nlohmann/json.hpp>

#include <set>

namespace pluvia {
namespace {

using Json = nlohmann::json;
const std::string root = PLUVIA_SOURCE_DIR;

std::string message_of(const std::string& yaml) {
    const TemporaryFolder folder;
    write_file(folder / "d.yaml", yaml);
    try {
        read_dataset_config(folder / "d.yaml");
    } catch (const Error& e) {
        CHECK(e.code() == ExitCode::usage);
        const std::string text = e.what();
        return text.substr(text.find("d.yaml"));
    }
    return "";
}

const std::string scenes = "scenes:\n  - scene: lane\n    frames: 2\n    train: [front]\n";

}  // namespace

TEST_CASE("hri.yaml and hri-physical.yaml plan the paper's 2,500 training and 700 test pairs") {
    for (const char* name : {"hri", "hri-physical"}) {
        const Outcome plan =
            run_program("dataset plan " + root + "/scenes/" + name + ".yaml -o /nonexistent --no-sample --json");
        CAPTURE(plan.err);
        REQUIRE(plan.exit_code == 0);
        const Json j = Json::parse(plan.out);
        CHECK(j["train_pairs"] == 2500);
        CHECK(j["test_pairs"] == 700);
        CHECK(j["frames"] == 800);
        const std::map<std::string, std::pair<int, int>> expected = {
            {"lane", {1200, 400}}, {"citystreet", {500, 100}}, {"japanesestreet", {800, 200}}};
        for (const Json& scene : j["scenes"]) {
            const auto [train, test] = expected.at(scene["scene"]);
            CHECK(scene["train_pairs"] == train);
            CHECK(scene["test_pairs"] == test);
        }
    }
}

TEST_CASE("a dataset's quality sets what is not given beside it, in any order, and a scene's counts more") {
    const TemporaryFolder folder;
    const auto options = [&](const std::string& yaml, const std::string& of_scene = "") {
        write_file(folder / "d.yaml", yaml + "rain: [10]\n" + scenes + of_scene);
        return read_dataset_config(folder / "d.yaml").scenes[0].options;
    };
    RenderOptions draft;
    set_quality(draft, "draft");
    CHECK(options("quality: draft\n").spp == draft.spp);
    CHECK(options("spp: 5\nquality: draft\n").spp == 5);
    CHECK(options("quality: draft\nspp: 5\n").spp == 5);
    CHECK(options("quality: draft\n", "    quality: standard\n").spp == RenderOptions().spp);
    CHECK(message_of("quality: best\nrain: [10]\n" + scenes).find("d.yaml:1") == 0);
}

TEST_CASE("frames of hri.yaml are whole tiles, spread over 24 hours at equal steps, and none has another's noise") {
    const auto items = dataset_items(read_dataset_config(root + "/scenes/hri.yaml"));
    std::set<uint64_t> seeds;
    for (const DatasetItem& item : items) {
        const CameraSettings camera = camera_settings(item.options);
        CHECK(camera.width % 512 == 0);  // HRIGNet cuts pictures into tiles of 512 and does not pad
        CHECK(camera.height % 512 == 0);
        CHECK(item.options.light.hour == 24.0 * item.frame / (item.scene_name == "lane" ? 100 : 25));
        seeds.insert(item.options.seed);
    }
    CHECK(seeds.size() == items.size());
    CHECK(items[3].id() == "lane/front/frame_0003");
    CHECK(items[3].clean_path("background", "jpg") == "clean/lane/front/background/frame_0003.jpg");
    CHECK(items[3].rainy_path(25, "rain_layer", "png") == "rainy/lane/front/25mm/wind_0.5/rain_layer/frame_0003.png");
}

TEST_CASE("every configuration that comes with Pluvia is valid, and the template has every key of its own") {
    for (const char* name : {"hri", "hri-physical", "hri-smoke", "extremerain", "extremerain-smoke", "template"}) {
        CAPTURE(name);
        CHECK_NOTHROW(read_dataset_config(root + "/scenes/" + name + ".yaml"));
    }
    const std::string text = read_file(root + "/scenes/template.yaml");
    for (const char* key : {"name", "description", "license", "scenes", "hours", "winds", "bits", "jpeg-quality", "exr",
                            "scene", "frames", "train", "test", "hour", "traffic", "rain-over-time", "wind-over-time"})
        CHECK(text.find(std::string(key) + ":") != std::string::npos);
}

TEST_CASE("a mistake in a configuration is answered with its line and what to write instead") {
    CHECK(message_of("rain: [10]\n" + scenes) == "");
    const auto says = [&](const std::string& yaml, const std::string& where, const std::string& what) {
        const std::string message = message_of(yaml);
        CAPTURE(message);
        CHECK(message.starts_with("d.yaml:" + where + ": "));
        CHECK(message.find(what) != std::string::npos);
    };
    says("rain: [10]\nexposre: 3\n" + scenes, "2", "did you mean exposure?");
    says("rain: [10]\nqqqqqqqqqq: 3\n" + scenes, "2", "no key \"qqqqqqqqqq\"");
    says("rain: [10]\nscenes:\n  - scene: lane\n    frames: 2\n    tran: [front]\n", "5", "did you mean train?");
    says("rain: [10, 9000]\n" + scenes, "1", "0 to 1000 mm/h");
    says("rain: [50, 10]\n" + scenes, "2", "rising");
    says(scenes, "1", "no intensities");
    says("rain: [10]\nhour: 3\n" + scenes, "2", "hours");
    says("rain: [10]\nthreads: 3\n" + scenes, "2", "--threads on the command line");
    says("rain: [10]\nhours: [25]\n" + scenes, "2", "0 to 24");
    says("rain: [10]\nwinds: [[1, 2]]\n" + scenes, "2", "[X, Y, Z]");
    says("rain: [10]\nbits: 12\n" + scenes, "2", "8 or 16");
    says("rain: [10]\nspp: many\n" + scenes, "2", "many");
    says("rain: [10]\nview: nice\n" + scenes, "2", "nice");
    says("rain: [10]\nweather: snow\n" + scenes, "2", "thunderstorm");
    says("rain: [10]\nrain: [20]\n" + scenes, "2", "already, on line 1");
    says("rain: [10\n" + scenes, "2", "is not YAML");
    says("rain: [10]\n" + scenes + "    test: [front]\n", "6", "training and test share none");
    says("rain: [10]\n" + scenes + scenes.substr(8), "2", "two scenes have the name");
    says("rain: [10]\nname: a/b\n" + scenes, "2", "name of a folder");
}

TEST_CASE("a folder in place of a configuration is said to be one") {
    const TemporaryFolder folder;
    const Outcome run = run_program("dataset plan " + folder.path() + " -o " + (folder / "out"));
    CHECK(run.exit_code == 3);
    CHECK(run.err == "pluvia: error: " + folder.path() + ": is a folder (expected a YAML file)\n");
}

TEST_CASE("a word far from all others is not a misspelling of one") {
    CHECK(nearest_word("weathr", {"wind", "weather", "winds"}) == "weather");
    CHECK(nearest_word("xyzzy", {"wind", "weather", "winds"}).empty());
}

TEST_CASE("plan counts scenes that do not exist, run names those that do") {
    const TemporaryFolder folder;
    write_file(folder / "d.yaml", "rain: [10]\nscenes:\n  - scene: atlantis\n    frames: 3\n    train: [a, b]\n");
    const std::string arguments = (folder / "d.yaml") + " -o " + (folder / "out");
    const Outcome plan = run_program("dataset plan " + arguments);
    CHECK(plan.exit_code == 0);
    CHECK(plan.out.find("no such scene") != std::string::npos);
    const Outcome run = run_program("dataset run " + arguments);
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("no scene \"atlantis\"") != std::string::npos);
    CHECK(run.err.find("lane") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder / "out/work"));
}

TEST_CASE("a camera that a scene lacks is an error before anything is rendered") {
    const SmallDataset small;
    write_file(small.config_path(), read_file(small.config_path()) +
                                        "  - scene: court.glb\n    name: other\n    frames: 1\n"
                                        "    train: [ey]\n");
    const Outcome run = small.command("run", "out");
    CHECK(run.exit_code == 2);
    CHECK(run.err.find("did you mean eye?") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(small.folder / "out/clean"));
}

TEST_CASE("shards are contiguous, share nothing and leave nothing out") {
    const auto items = dataset_items(read_dataset_config(root + "/scenes/hri.yaml"));
    for (const int count : {1, 3, 7, 800, 1000}) {
        std::vector<std::string> ids;
        size_t most = 0, least = items.size();
        for (int number = 1; number <= count; ++number) {
            const auto shard = shard_items(items, {number, count});
            for (const DatasetItem& item : shard) ids.push_back(item.id());
            most = std::max(most, shard.size()), least = std::min(least, shard.size());
        }
        REQUIRE(ids.size() == items.size());
        for (size_t i = 0; i < items.size(); ++i) CHECK(ids[i] == items[i].id());
        CHECK(most - least <= 1);
    }
    for (const char* wrong : {"0/3", "4/3", "1", "a/b", "1/0", "-1/2"}) CHECK_THROWS_AS(Shard::parse(wrong), Error);
    CHECK(Shard::parse("2/3").label() == "2-of-3");
}

}  // namespace pluvia
