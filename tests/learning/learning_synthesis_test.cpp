// Whole pictures through tiny random models: seams, borders, order of work, and pixels that must not change.
#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "tests/learning/small_models.h"
#include "tests/temporary_folder.h"
#include "tools/learning/synthesis.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

using namespace pluvia;

namespace {

struct Frame {
    Image<Rgba8> background;
    Image<uint8_t> coverage;
};

/// Smooth colours and slanted streaks.
Frame street(int width, int height) {
    Frame f{Image<Rgba8>(width, height), Image<uint8_t>(width, height)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            f.background.at(x, y) = {uint8_t(90 + 60 * std::sin(x * 0.05)), uint8_t(100 + 50 * std::cos(y * 0.07)),
                                     uint8_t(80 + (x + y) % 40), 255};
            const int phase = (3 * x + y) % 47;
            f.coverage.at(x, y) = uint8_t(phase < 6 ? 40 * phase : 0);
        }
    return f;
}

/// Printed as true or false: glog, which libtorch brings, cannot print pixels.
bool same_bytes(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    return a.pixels == b.pixels;
}

int level_difference(Rgba8 a, Rgba8 b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

double share_that_differs(const Image<Rgba8>& a, const Image<Rgba8>& b, int levels) {
    size_t n = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) n += level_difference(a.pixels[i], b.pixels[i]) > levels;
    return double(n) / double(a.pixels.size());
}

/// In levels, over pixels.
double mean_difference(const Image<Rgba8>& a, const Image<Rgba8>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) sum += level_difference(a.pixels[i], b.pixels[i]);
    return sum / double(a.pixels.size());
}

SynthesisSettings small_tiles() {
    SynthesisSettings s;
    s.steps = 3;
    s.tiles.size = 64;
    s.tiles.overlap = 32;
    return s;
}

struct Models {
    TemporaryFolder folder;
    std::shared_ptr<const RainModel> regression, diffusion, guided, other_guide;
    Models() {
        write_regression_model(folder / "regression");
        write_diffusion_model(folder / "plain", false, 0);
        write_diffusion_model(folder / "guided", true, 5);
        write_diffusion_model(folder / "other", true, 6);
        regression = load_model(folder / "regression");
        diffusion = load_model(folder / "plain");
        guided = load_model(folder / "guided");
        other_guide = load_model(folder / "other");
    }
};
const Models& models() {
    static const Models m;
    return m;
}

ExitCode exit_code_of(const auto& action) {
    try {
        action();
    } catch (const Error& e) {
        return e.code();
    }
    return ExitCode::ok;
}

/// Largest step between neighbours along rows, in levels.
int largest_step(const Image<Rgba8>& image) {
    int largest = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 1; x < image.width; ++x)
            largest = std::max(largest, level_difference(image.at(x, y), image.at(x - 1, y)));
    return largest;
}

}  // namespace

TEST_CASE("pixels without rain come back with their bytes, at any size") {
    for (const auto& model : {models().regression, models().guided}) {
        const Frame f = street(101, 67);
        const Image<Rgba8> result = synthesize(*model, f.background, f.coverage, small_tiles());
        int changed = 0;
        for (size_t i = 0; i < result.pixels.size(); ++i) {
            if (f.coverage.pixels[i] < rain_alpha)
                REQUIRE(level_difference(result.pixels[i], f.background.pixels[i]) == 0);
            changed += f.coverage.pixels[i] >= rain_alpha && result.pixels[i] != f.background.pixels[i];
        }
        CHECK(changed > 100);
    }
}

TEST_CASE("a constant frame shows no seam between joined tiles, and does between plain ones") {
    Frame f{Image<Rgba8>(400, 128, Rgba8{120, 110, 100, 255}), Image<uint8_t>(400, 128, 255)};
    SynthesisSettings s = small_tiles();
    s.tiles.size = 128;
    s.tiles.overlap = 64;
    s.blend.anchor_colors = false;
    const int joined = largest_step(synthesize(*models().regression, f.background, f.coverage, s));
    s.tiles.plain = true;
    const int plain = largest_step(synthesize(*models().regression, f.background, f.coverage, s));
    MESSAGE("largest step: joined ", joined, ", plain ", plain);
    CHECK(joined <= 1);         // what differs between tiles is spread over a ramp of 32 pixels
    CHECK(plain > 4 * joined);  // the network's zero padding shows along plain tiles: the test can see seams
}

TEST_CASE("a grid of tiles moved by a quarter changes little") {
    const Frame f = street(300, 200);
    SynthesisSettings s = small_tiles();
    s.tiles.size = 128;
    s.tiles.overlap = 64;
    const auto change = [&] {
        s.tiles.shift = 0;
        const auto here = synthesize(*models().regression, f.background, f.coverage, s);
        s.tiles.shift = 32;
        return mean_difference(here, synthesize(*models().regression, f.background, f.coverage, s));
    };
    const double joined = change();
    s.tiles.plain = true;
    const double plain = change();
    MESSAGE("mean change in levels: joined ", joined, ", plain ", plain);
    // What is left is the frame's border, reflected by 16 or by 48 pixels, and statistics of normalisation, which are
    // those of a tile; random weights have learnt nothing of either.
    CHECK(joined < 0.25);
    CHECK(joined < plain);
}

TEST_CASE("the order in which tiles are worked on changes no bit") {
    const Frame f = street(150, 100);
    SynthesisSettings s = small_tiles();
    s.eta = 0.5;
    const auto forwards = synthesize(*models().guided, f.background, f.coverage, s);
    s.tiles.backwards = true;
    CHECK(same_bytes(synthesize(*models().guided, f.background, f.coverage, s), forwards));
}

TEST_CASE("the number of threads changes at most one level in a thousandth of the pixels") {
    const Frame f = street(150, 100);
    for (const auto& model : {models().regression, models().guided}) {
        set_learning_threads(1);
        const auto one = synthesize(*model, f.background, f.coverage, small_tiles());
        set_learning_threads(2);
        const auto two = synthesize(*model, f.background, f.coverage, small_tiles());
        set_learning_threads(1);
        CHECK(share_that_differs(one, two, 0) <= 0.001);
        CHECK(share_that_differs(one, two, 1) == 0);
    }
}

TEST_CASE("seed, steps and guide change what a diffusion model draws") {
    const Frame f = street(96, 64);
    SynthesisSettings s = small_tiles();
    const auto first = synthesize(*models().guided, f.background, f.coverage, s);
    CHECK(same_bytes(synthesize(*models().guided, f.background, f.coverage, s), first));
    CHECK_FALSE(same_bytes(synthesize(*models().other_guide, f.background, f.coverage, s), first));
    s.seed = 1;
    CHECK_FALSE(same_bytes(synthesize(*models().guided, f.background, f.coverage, s), first));
}

TEST_CASE("a guiding model that the UNet does not look at is skipped with a notice") {
    const TemporaryFolder folder;
    write_diffusion_model(folder / "ignored", false, 5);
    const auto model = load_model(folder / "ignored");
    REQUIRE(config_of(*model).notices.size() == 1);
    CHECK(config_of(*models().diffusion).notices.empty());
    const Frame f = street(64, 64);
    CHECK(same_bytes(synthesize(*model, f.background, f.coverage, small_tiles()),
                     synthesize(*models().diffusion, f.background, f.coverage, small_tiles())));
}

TEST_CASE("models that do not fit together are refused with exit code 3") {
    const TemporaryFolder folder;
    ModelConfig config;
    config.unet = {
        .channels = 32, .multipliers = {1, 2}, .res_blocks = 1, .attention_factors = {2}, .context_channels = 3};
    NamedTensors tensors;
    add_network<UNet>(tensors, unet_prefix, config.unet, 3);
    write_model(folder / "no_stage", tensors, config);
    CHECK(exit_code_of([&] { load_model(folder / "no_stage"); }) == ExitCode::input);
    const FirstStageConfig stage{.channels = 32, .multipliers = {1, 1, 1}, .res_blocks = 1, .codes = 16};
    add_network<FirstStage>(tensors, first_stage_prefix, stage, 4);
    write_model(folder / "no_guide", tensors, config);
    CHECK(exit_code_of([&] { load_model(folder / "no_guide"); }) == ExitCode::input);
    write_diffusion_model(folder / "whole", false, 0);
    CHECK(exit_code_of([&] { load_model(folder / "whole"); }) == ExitCode::ok);
    NamedTensors fewer;
    add_network<FirstStage>(fewer, first_stage_prefix, stage, 4);
    UNetConfig plain = config.unet;
    plain.context_channels = 0;
    add_network<UNet>(fewer, unet_prefix, plain, 3);
    fewer.erase(fewer.begin() + 20);
    write_model(folder / "missing", fewer, config);
    CHECK(exit_code_of([&] { load_model(folder / "missing"); }) == ExitCode::input);
    CHECK(exit_code_of([&] { load_model(folder / "whole", "tpu"); }) == ExitCode::usage);
}

TEST_CASE("an interrupted picture ends with exit code 75, and pictures of two sizes with 3") {
    const Frame f = street(150, 100);
    const auto stop = [](double) { return false; };
    CHECK(exit_code_of([&] { synthesize(*models().regression, f.background, f.coverage, small_tiles(), stop); }) ==
          ExitCode::stopped_early);
    CHECK(exit_code_of([&] {
              synthesize(*models().regression, f.background, Image<uint8_t>(150, 99), small_tiles());
          }) == ExitCode::input);
}
