// Light of fine drops from a table, in scenes: as bright as that of their paths, and as exact in everything else.
#include "renderer/core/parallel.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

namespace pluvia {
namespace {

RenderSettings tabled(std::vector<double> intensities, int samples = 4) {
    RenderSettings settings;
    settings.samples = samples;
    settings.rain.intensities_mm_per_h = std::move(intensities);
    settings.rain.min_width_pixels = 0.25;
    settings.streaks.tabled_veil = true;
    return settings;
}

const Environment& sky_over_dark_ground() {
    static const Environment world = [] {
        Image<Rgb> picture(64, 32);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 64; ++x)
                picture.at(x, y) = y < 16 ? Rgb(1, 1.2f, 1.5f) * (x < 32 ? 2.0f : 0.5f) : Rgb(0);
        return Environment(std::move(picture));
    }();
    return world;
}

/// Between two walls, one white and one dark, open at the far end.
Scene make_lane() {
    Scene scene = make_plane(lambert(Rgb(0.3f)));
    add_box(scene, {-5, 0, -40}, {-4, 9, 5}, lambert(Rgb(0.8f)));
    add_box(scene, {4, 0, -40}, {5, 9, 5}, lambert(Rgb(0.1f, 0.05f, 0.02f)));
    return scene;
}

View lane_view() {
    return look_at({0, 1.6, 4}, {0, 2.2, -10}, 64, 32, 60);
}

double rain_light(const Picture& p, size_t pixel) {
    return p.plane("rain_100.G")[pixel] + p.plane("inscatter_100.G")[pixel];
}

}  // namespace

TEST_CASE("light of fine drops in a street from a table is that of their paths, by day and at night by lamps") {
    for (const bool night : {false, true}) {
        Scene scene = make_lane();
        if (night) {
            add_sphere(scene, {2.5f, 6, -8}, 0.1f, 16, emitter(Rgb(20000)));
            scene.lights.push_back({.name = "far", .intensity = Rgb(500), .position = {-2, 5, -25}});
        }
        const Environment world = night ? Environment::uniform(Rgb(0.02f)) : sky_over_dark_ground();
        // Of the left wall, the middle and the right wall, by the same drops.
        std::array<RunningMean, 3> exact, change;
        for (uint64_t seed = 0; seed < 16; ++seed) {
            std::array<std::array<double, 3>, 2> sums = {};
            for (const bool table : {false, true}) {
                RenderSettings settings = tabled({100}, night ? 64 : 16);
                settings.streaks.tabled_veil = table;
                settings.seed = settings.rain.seed = seed;
                const Picture p = render_picture(scene, world, lane_view(), settings);
                for (size_t i = 0; i < p.plane("Z").size(); ++i) sums[table][i % 64 * 3 / 64] += rain_light(p, i);
                CHECK((p.report.counters[Feature::medium_path] > 0) == !table);
            }
            for (size_t k = 0; k < 3; ++k) exact[k].add(sums[0][k]), change[k].add(sums[1][k] - sums[0][k]);
        }
        for (size_t k = 0; k < 3; ++k) {
            CAPTURE(night);
            CAPTURE(k);
            const double bias = change[k].mean() / exact[k].mean();
            const double error = change[k].standard_error() / exact[k].mean();
            CAPTURE(bias);
            CAPTURE(error);
            CHECK(error < 0.01);
            CHECK(std::abs(bias) < 0.02 + 5 * error);
        }
    }
}

TEST_CASE("in a uniform world rain by the light of a table is invisible, under a roof as well") {
    Scene scene = make_plane(lambert(Rgb(1)));
    Material shining = emitter(Rgb(1));
    shining.double_sided = true;
    add_quad(scene, {-30, 6, -5}, {60, 0, 0}, {0, 0, -25}, shining);
    const View view = look_at({0, 2, 0}, {0, 2.5, -10}, 32, 16, 30);
    const Estimate e = estimate(scene, Environment::uniform(Rgb(1)), view, tabled({100}, 64), "rainy_100.G", 16);
    CAPTURE(e.mean);
    CAPTURE(e.standard_error);
    CHECK(std::abs(e.mean - 1) < 5 * e.standard_error + 1e-4);
    CHECK(e.standard_error < 2e-3);
}

TEST_CASE("the table changes neither background nor coverage, and no intensity depends on others beside it") {
    const Scene scene = make_lane();
    RenderSettings traced = tabled({10, 100});
    traced.streaks.tabled_veil = false;
    const Picture exact = render_picture(scene, sky_over_dark_ground(), lane_view(), traced);
    const Picture both = render_picture(scene, sky_over_dark_ground(), lane_view(), tabled({10, 100}));
    const Picture one = render_picture(scene, sky_over_dark_ground(), lane_view(), tabled({10}));
    for (const auto& [channel, plane] : exact.planes) {
        CAPTURE(channel);
        const bool is_light = channel.starts_with("rain_") && !channel.ends_with(".A");
        if (!is_light && !channel.starts_with("inscatter") && !channel.starts_with("rainy_0") &&
            !channel.starts_with("rainy_1"))
            CHECK(plane == both.plane(channel));
    }
    CHECK_FALSE(exact.plane("inscatter_100.G") == both.plane("inscatter_100.G"));
    for (const auto& [channel, plane] : one.planes) {
        CAPTURE(channel);
        CHECK(plane == both.plane(channel));
    }
}

TEST_CASE("a frame with a table has the same bytes for any number of threads and any tile size") {
    Scene scene = make_lane();
    add_sphere(scene, {2.5f, 6, -8}, 0.1f, 16, emitter(Rgb(20000)));
    RenderSettings settings = tabled({10, 100});
    const Picture first = render_picture(scene, sky_over_dark_ground(), lane_view(), settings);
    set_thread_count(1);
    CHECK(first == render_picture(scene, sky_over_dark_ground(), lane_view(), settings));
    set_thread_count(0);
    settings.tile_size = 7;
    CHECK(first == render_picture(scene, sky_over_dark_ground(), lane_view(), settings));
}

TEST_CASE("in fog drops are traced although a table is asked for") {
    RenderSettings settings = tabled({10});
    settings.rain.fog_extinction = 0.01;
    const Picture p = render_picture(make_lane(), sky_over_dark_ground(), lane_view(), settings);
    CHECK(p.report.counters[Feature::medium_path] > 0);
}

}  // namespace pluvia
