// The furnace: where light of radiance 1 comes from everywhere and nothing absorbs, everything has radiance 1, and rain
// is invisible.
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

namespace pluvia {
namespace {

/// Per pixel the means of independent renders. Their standard errors come from the renders themselves.
struct FurnaceResult {
    double mean_error;
    int outliers;  // pixels beyond five sigma
};

FurnaceResult furnace(const Scene& scene, const View& view, RenderSettings settings, const std::string& channel,
                      int seeds) {
    const Environment world = Environment::uniform(Rgb(1));
    std::vector<RunningMean> pixels(size_t(view.width) * view.height);
    for (int k = 0; k < seeds; ++k) {
        settings.seed = settings.rain.seed = 77 + uint64_t(k);
        const Picture picture = render_picture(scene, world, view, settings);
        REQUIRE(picture.report.counters.invalid_samples == 0);
        const auto& plane = picture.plane(channel);
        for (size_t i = 0; i < plane.size(); ++i) pixels[i].add(plane[i]);
    }
    RunningMean all;
    FurnaceResult result{0, 0};
    for (const RunningMean& pixel : pixels) {
        all.add(pixel.mean());
        // 1e-6: float rounding, all that is left where no sample deviates.
        if (!pixel.agrees_with(1, 1e-6)) ++result.outliers;
    }
    result.mean_error = all.mean() - 1;
    return result;
}

}  // namespace

TEST_CASE("in a uniform world white walls have the world's radiance and rain of 100 mm/h is invisible") {
    const Scene scene = make_court(lambert(Rgb(1)));
    const View view = court_view(48, 24);
    RenderSettings settings;
    settings.samples = 32;
    settings.rain.intensities_mm_per_h = {10, 100};
    settings.rain.min_width_pixels = 0.25;  // a small picture has few drops a pixel wide
    const int seeds = 64;
    for (const char* channel : {"background.G", "rainy_010.G", "rainy_100.G"}) {
        const FurnaceResult result = furnace(scene, view, settings, channel, seeds);
        CAPTURE(channel);
        CHECK(std::abs(result.mean_error) < 1e-3);
        CHECK(result.outliers == 0);
    }
    // The test sees the rain: there is some in front of most pixels.
    settings.samples = 4;
    const Picture picture = render_picture(scene, Environment::uniform(Rgb(1)), view, settings);
    CHECK(picture.mean("rain_100.A") > 1e-3);
}

TEST_CASE("in a uniform world surfaces that absorb nothing are invisible") {
    Material metal = lambert(Rgb(1));
    metal.metallic = 1, metal.roughness = 0.5f;
    Material plastic = lambert(Rgb(1));
    plastic.specular = 1, plastic.roughness = 0.4f;
    Material pane = lambert(Rgb(1));
    pane.transmission = 1, pane.roughness = 0;
    Material veil = lambert(Rgb(1));
    veil.alpha_mode = AlphaMode::blend, veil.alpha = 0.5f;
    Material half_pane = pane;
    half_pane.transmission = 0.5f;
    RenderSettings settings;
    settings.samples = 64;
    for (const Material& material : {metal, plastic, pane, veil, half_pane}) {
        const FurnaceResult result = furnace(make_court(material), court_view(24, 12), settings, "background.G", 48);
        CAPTURE(material.metallic);
        CAPTURE(material.transmission);
        CAPTURE(material.alpha);
        // 1e-3 is the accuracy of the tables of multiple scattering.
        CHECK(std::abs(result.mean_error) < 1e-3);
    }
}

TEST_CASE("in a uniform world streaks and finer rain are as bright as what they hide") {
    // Rain covers a hundredth of the pictures above, so that they would hide an error of its light.
    const Scene scene = make_court(lambert(Rgb(1)));
    RenderSettings settings;
    settings.samples = 16;
    settings.rain.intensities_mm_per_h = {100};
    settings.rain.min_width_pixels = 0.05;
    RunningMean excess;
    for (uint64_t seed = 0; seed < 64; ++seed) {
        settings.seed = settings.rain.seed = seed;
        const Picture picture = render_picture(scene, Environment::uniform(Rgb(1)), court_view(64, 32), settings);
        const double light = picture.mean("rain_100.G") + picture.mean("inscatter_100.G");
        excess.add(light / (1 - picture.mean("transmittance_100.G")) - 1);
    }
    CAPTURE(excess.mean());
    CAPTURE(excess.standard_error());
    CHECK(excess.agrees_with(0));
    CHECK(excess.standard_error() < 5e-3);
}

TEST_CASE("in a uniform world kilometres of heavy rain and fog are invisible") {
    const Scene nothing;
    const View view = look_at({0, 2, 0}, {0, 2.3, -1}, 24, 12, 24);
    RenderSettings settings;
    settings.samples = 32;
    settings.rain.intensities_mm_per_h = {1, 10, 500};
    settings.rain.fog_extinction = 0.001;
    const Picture once = render_picture(nothing, Environment::uniform(Rgb(1)), view, settings);
    CHECK(once.mean("transmittance_500.G") < 0.01);
    CHECK(once.mean("transmittance_001.G") < 0.5);
    for (const char* channel : {"rainy_001.G", "rainy_010.G", "rainy_500.G"}) {
        const FurnaceResult result = furnace(nothing, view, settings, channel, 64);
        CAPTURE(channel);
        CAPTURE(result.mean_error);
        CHECK(std::abs(result.mean_error) < 2e-3);  // 600 thousand samples with weights up to 2: a sigma of 1.5e-3
        CHECK(result.outliers == 0);
    }
}

}  // namespace pluvia
