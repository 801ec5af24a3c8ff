// Counts that a pilot chooses: the error is what was asked for, and the picture is that of the count.
#include "tools/sample_choice.h"
#include "renderer/scene/gltf.h"
#include "tests/run_program.h"
#include "tests/temporary_folder.h"
#include "tools/validate/color_metrics.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/rendered_picture.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace pluvia {
namespace {

Image<Rgb> colours(const Picture& p, const std::string& layer) {
    Image<Rgb> image(p.width, p.height);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {p.plane(layer + ".R")[i], p.plane(layer + ".G")[i], p.plane(layer + ".B")[i]};
    return image;
}

double error(const Picture& p, const Picture& reference, const std::string& layer) {
    return std::sqrt(trimmed_mean(relative_squared_errors(colours(p, layer), colours(reference, layer))));
}

Scene lit_court() {
    Scene scene = make_court(lambert(Rgb(0.6f)));
    Material lamp = emitter(Rgb(40));
    lamp.double_sided = true;
    add_quad(scene, {-4, 4, 0}, {1, 0, 0}, {0, 0, 1}, lamp);
    return scene;
}

}  // namespace

TEST_CASE("with a target the true error is within a factor of 1.3 of it in 18 of 20 runs, clean and in rain") {
    const Scene scene = lit_court();
    const Environment world = Environment::uniform(Rgb(0.5f));
    const View view = court_view(32, 16);
    for (const bool rains : {false, true}) {
        RenderSettings settings{.samples = 8192, .seed = 1};
        if (rains) settings.samples = 2048, settings.rain.intensities_mm_per_h = {10, 100};
        const Picture reference = render_picture(scene, world, view, settings);
        const int most = settings.samples / 10;
        const double target = rains ? 0.1 : 0.05;
        int near = 0;
        for (uint64_t run = 0; run < 20; ++run) {
            settings.seed = 100 + run;
            settings.choose_samples = [&](const PixelRenderer& pilot) {
                return samples_for_error(target, pilot, settings.rain.intensities_mm_per_h,
                                         int64_t(view.width) * view.height, settings.seed);
            };
            const Picture p = render_picture(scene, world, view, settings);
            double got = error(p, reference, "background");
            if (rains) got = std::max(got, error(p, reference, "rainy_100"));
            INFO("samples " << p.report.samples << ", error " << got << " for " << target);
            near += got <= 1.3 * target && got >= target / 1.3;
            CHECK(p.report.samples < most);  // the reference's own error does not matter
        }
        CHECK(near >= 18);
    }
}

TEST_CASE("the picture of a chosen count has the bytes of --spp with it, and the pilot none of its samples") {
    const Scene scene = lit_court();
    RenderSettings settings{.samples = 7, .seed = 5};
    settings.rain.intensities_mm_per_h = {50};
    const Picture plain = render_picture(scene, Environment::uniform(Rgb(0.5f)), court_view(32, 16), settings);
    settings.samples = 99;
    settings.choose_samples = [](const PixelRenderer& pilot) {
        const std::vector<int64_t> pixels = {3, 511};
        const auto a = pilot(pixels, 4, 5), b = pilot(pixels, 4, 6), c = pilot(pixels, 4, 6);
        CHECK(a.size() == 2 * layer_channels({50}).size());
        CHECK(a != b);
        CHECK(b == c);
        return 7;
    };
    const Picture chosen = render_picture(scene, Environment::uniform(Rgb(0.5f)), court_view(32, 16), settings);
    CHECK(chosen.report.samples == 7);
    CHECK(chosen == plain);
}

TEST_CASE("render records the count that it chose and repeats it with --spp") {
    const TemporaryFolder folder;
    save_glb(lit_court(), folder / "court.glb");
    const std::string common = "render " + (folder / "court.glb") +
                               " --size 32x16 --environment 1,1,1 --progress none --json --seed 3 -o " + folder.path();
    const Outcome a = run_program(common + "/a --target-error 0.1");
    REQUIRE(a.exit_code == 0);
    const int samples = nlohmann::json::parse(a.out)["samples"];
    CHECK(samples > 1);
    const Outcome b = run_program(common + "/b --spp " + std::to_string(samples));
    REQUIRE(b.exit_code == 0);
    CHECK(read_file(folder / "a/frame.exr").size() > 1000);
    CHECK((read_file(folder / "a/frame.exr") == read_file(folder / "b/frame.exr")));
    CHECK((read_file(folder / "a/frame.json") == read_file(folder / "b/frame.json")));
    CHECK(run_program(common + "/c --spp 4 --target-error 0.1").exit_code == 2);
    CHECK(run_program(common + "/c --target-error 0").exit_code == 2);
}

}  // namespace pluvia
