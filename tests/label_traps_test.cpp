// What other pipelines for rainy pictures get wrong without saying so, and Pluvia must not: one test for each.
#include "renderer/image/color.h"
#include "renderer/image/depth_encoding.h"
#include "renderer/image/exposure.h"
#include "renderer/image/image_io.h"
#include "tests/dataset_fixture.h"
#include "tests/label_fixture.h"
#include "tools/labels/label_export.h"

#include <cmath>
#include <map>
#include <set>
#include <thread>

namespace pluvia {
namespace {

struct Shot {
    TemporaryFolder folder;
    LabelSource source = render_labels(folder, labelled_street(), "frame", 3, "--rain 100 --composition paper");
    LabelFrame frame{source};
};
Shot& shot() {
    static Shot shared;
    return shared;
}

}  // namespace

TEST_CASE("trap: depth is metric and linear, not a logarithm in 8 bits for display") {
    LabelFrame& frame = shot().frame;
    CHECK(read_image_info(shot().folder / "frame/depth.png").bits == 16);
    const auto stored = read_grey16(shot().folder / "frame/depth.png");
    const auto z = frame.values("Z");
    float near = 1e9f, far = 0;
    for (size_t i = 0; i < z.size(); ++i) {
        if (!(z[i] < 255)) continue;
        // Half a step of 1/256 m, as far away as near, where 8 bits of a logarithm are 2 % off.
        REQUIRE(std::abs(float(stored.pixels[i]) / 256 - z[i]) <= 0.5f / 256 + 1e-6f);
        near = std::min(near, z[i]), far = std::max(far, z[i]);
    }
    CHECK(far > 3 * near);
}

TEST_CASE("trap: what a value of depth means stands beside it, for every encoding") {
    const auto z = shot().frame.values("Z");
    for (const std::string encoding : {"kitti16", "mm16", "carla24", "hri"}) {
        const std::string to = shot().folder / ("depth_" + encoding);
        const Outcome outcome =
            run_program("render " + (shot().folder / "frame.glb") + " -o " + to +
                        " --frame 3 --fps 10 --size 192x96 --spp 1 --bounces 0 --environment 100,100,100"
                        " --progress none --depth-max 50 --depth-encoding " +
                        encoding);
        REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
        // A reader that knows this file only.
        const auto j = nlohmann::json::parse(read_file(to + "/frame.json"));
        const std::string stated = j.at("settings").at("depth-encoding");
        CHECK(j.at("units").at("depth") == "metres");
        const double full = j.at("settings").at("depth-max");
        const auto metres = [&](const Rgba8 p, uint16_t grey) -> double {
            if (stated == "kitti16") return grey / 256.0;
            if (stated == "mm16") return grey / 1000.0;
            if (stated == "carla24") return (p.r + 256.0 * p.g + 65536.0 * p.b) / 16777215 * 1000;
            return grey / 65535.0 * full;
        };
        const bool is_grey = stated != "carla24";
        const auto grey = is_grey ? read_grey16(to + "/depth.png").pixels : std::vector<uint16_t>(z.size());
        const auto color = is_grey ? std::vector<Rgba8>(z.size()) : read_rgba8(to + "/depth.png").pixels;
        int64_t compared = 0;
        for (size_t i = 0; i < z.size(); ++i) {
            if (!(z[i] < 49)) continue;
            REQUIRE(std::abs(metres(color[i], grey[i]) - double(z[i])) < 0.51 / 256);
            ++compared;
        }
        CHECK(compared > 5000);
    }
}

TEST_CASE("trap: no id comes from a colour, so that classes of one colour stay apart and cars are cars") {
    export_labels({shot().source}, "cityscapes", shot().folder / "cityscapes");
    const std::string stem = shot().folder / "cityscapes/frame_gtFine_";
    const auto ids = read_rgba8(stem + "labelIds.png"), train = read_rgba8(stem + "labelTrainIds.png"),
               color = read_rgba8(stem + "color.png");
    std::map<std::array<int, 3>, std::set<int>> ids_of_color;
    int64_t cars = 0;
    for (size_t i = 0; i < ids.pixels.size(); ++i) {
        const Rgba8 c = color.pixels[i];
        ids_of_color[{c.r, c.g, c.b}].insert(ids.pixels[i].r);
        if (ids.pixels[i].r != 26) continue;
        ++cars;
        REQUIRE(train.pixels[i].r == 13);  // and not 255, that of licence plates, which have a car's colour
        REQUIRE((c.r == 0 && c.g == 0 && c.b == 142));
    }
    CHECK(cars > 100);
    CHECK(ids_of_color.at({153, 153, 153}) == std::set<int>{17, 18});  // no table of colours could tell these
}

TEST_CASE("trap: tags of one dataset are not looked up in another's table, and outlines are no convex hulls") {
    export_labels({shot().source}, "carla", shot().folder / "carla");
    export_labels({shot().source}, "cityscapes", shot().folder / "cityscapes");
    const auto tags = read_rgba8(shot().folder / "carla/semantic/frame.png"),
               ids = read_rgba8(shot().folder / "cityscapes/frame_gtFine_labelIds.png");
    std::set<std::pair<int, int>> pairs;
    for (size_t i = 0; i < ids.pixels.size(); ++i) pairs.insert({tags.pixels[i].r, ids.pixels[i].r});
    CHECK(pairs.contains({14, 26}));  // a car, where id 14 would be a guard rail
    CHECK(pairs.contains({12, 24}));  // a person, where id 12 would be a wall
    CHECK(!pairs.contains({14, 14}));
    const auto document = nlohmann::json::parse(read_file(shot().folder / "cityscapes/frame_gtFine_polygons.json"));
    std::set<std::string> labels;
    bool has_notch = false;
    for (const auto& entry : document.at("objects")) {
        labels.insert(entry.at("label"));
        if (entry.at("label") != "building") continue;
        // Turning both ways along its edge is what a hull cannot.
        const auto& points = entry.at("polygon");
        bool left = false, right = false;
        for (size_t i = 0; i < points.size(); ++i) {
            const auto at = [&](size_t k, int axis) {
                return points[(i + k) % points.size()][size_t(axis)].get<int>();
            };
            const int turn =
                (at(1, 0) - at(0, 0)) * (at(2, 1) - at(1, 1)) - (at(1, 1) - at(0, 1)) * (at(2, 0) - at(1, 0));
            left = left || turn < 0, right = right || turn > 0;
        }
        has_notch = has_notch || (left && right);
    }
    CHECK(labels.contains("car"));
    CHECK(!labels.contains("guard rail"));
    CHECK(has_notch);
}

TEST_CASE("trap: one command makes a dataset with its split, which may be moved, and names no machine") {
    const SmallDataset small(1);
    REQUIRE(small.command("run", "out").exit_code == 0);
    for (const auto& [list, camera] : {std::pair{"trainset.json", "eye"}, {"testset.json", "low"}}) {
        const auto entries = nlohmann::json::parse(read_file(small.folder / ("out/" + std::string(list))));
        REQUIRE(entries.size() == 2);
        for (const auto& entry : entries) CHECK(entry.at("sequence") == camera);
    }
    std::filesystem::create_directories(small.folder / "elsewhere");
    std::filesystem::rename(small.folder / "out", small.folder / "elsewhere/moved");
    const Outcome outcome = small.command("check", "elsewhere/moved");
    CHECK_MESSAGE(outcome.exit_code == 0, outcome.out);
}

TEST_CASE("trap: rain is put over the background in linear light, not in display values") {
    LabelFrame& frame = shot().frame;
    const DisplayView view("srgb");
    const float scale = exposure_scale(frame.json.at("exposure_ev100").get<double>());
    const auto shown = read_display(shot().folder / "frame/rainy_100.png");
    int64_t compared = 0;
    double worst = 0, worst_in_display = 0;
    const auto b = frame.values("background.G"), t = frame.values("transmittance_100.G"),
               r = frame.values("rain_100.G");
    for (size_t i = 0; i < b.size(); ++i) {
        const float g = shown.pixels[i].g;
        if (r[i] <= 0 || g >= 0.99f) continue;
        const double linear = srgb_from_linear(scale * (b[i] * t[i] + r[i]));
        const double blended = srgb_from_linear(scale * b[i]) * t[i] + srgb_from_linear(scale * r[i]);
        worst = std::max(worst, std::abs(linear - g)), ++compared;
        worst_in_display = std::max(worst_in_display, std::abs(blended - g));
    }
    CHECK(compared > 100);
    CHECK(worst < 1.01 / 255);             // rounding, and that of the view
    CHECK(worst_in_display > 10.0 / 255);  // what the test tells apart
}

TEST_CASE("trap: two runs of a dataset at once do not collide") {
    const SmallDataset small(2);
    REQUIRE(small.command("run", "alone").exit_code == 0);
    Outcome other;
    std::thread beside([&] { other = small.command("run", "both"); });
    const Outcome one = small.command("run", "both");
    beside.join();
    CHECK_MESSAGE(one.exit_code == 0, one.err);
    CHECK_MESSAGE(other.exit_code == 0, other.err);
    CHECK(difference(product_files(small.folder / "alone"), product_files(small.folder / "both")) == "");
}

TEST_CASE("trap: other seeds have other rain, and a finished frame is neither asked about nor overwritten") {
    const std::string common =
        "render " + (shot().folder / "frame.glb") +
        " --size 64x32 --spp 1 --bounces 0 --environment 100,100,100 --rain 100 --progress none ";
    const auto layers = [&](const std::string& name, const std::string& more) {
        REQUIRE(run_program(common + "-o " + (shot().folder / name) + " " + more).exit_code == 0);
        return read_file(shot().folder / (name + "/rain_layer_100.png"));
    };
    const std::string first = layers("a", "--seed 1");
    CHECK(layers("b", "--seed 1") == first);
    CHECK(layers("c", "--seed 2") != first);
    CHECK(layers("d", "--seed 1 --rain-seed 2") != first);
    const Outcome again = run_program(common + "-o " + (shot().folder / "a"));  // with nothing on stdin
    CHECK(again.exit_code == 2);
    CHECK(again.err.find("--overwrite") != std::string::npos);
}

}  // namespace pluvia
