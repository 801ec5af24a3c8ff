// What other pipelines for rainy pictures get wrong without saying so, and Pluvia must not. Ids that come from colours,
// tags taken for ids of another dataset, convex hulls and logarithmic depth are in label_export_test.cpp; folders and
// splits by hand in dataset_config_test.cpp and dataset_run_test.cpp.
#include "renderer/image/color.h"
#include "renderer/image/depth_encoding.h"
#include "renderer/image/exposure.h"
#include "renderer/image/image_io.h"
#include "tests/label_fixture.h"

#include <cmath>

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

TEST_CASE("trap: what a value of depth means stands beside it, and is metres") {
    LabelFrame& frame = shot().frame;
    CHECK(frame.json.at("settings").at("depth-encoding") == "kitti16");
    CHECK(frame.json.at("units").at("depth") == "metres");
    CHECK(read_image_info(shot().folder / "frame/depth.png").bits == 16);
    const auto stored = read_grey16(shot().folder / "frame/depth.png");
    const auto z = frame.values("Z");
    int64_t compared = 0;
    for (size_t i = 0; i < z.size(); ++i) {
        if (!(z[i] < 255)) continue;
        REQUIRE(std::abs(decode_kitti16(stored.pixels[i]) - z[i]) <= 0.5f / 256 + 1e-6f);
        ++compared;
    }
    CHECK(compared > 1000);
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
