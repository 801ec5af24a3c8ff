// Frames as wholes: the same bytes whatever the machine does, the algebra of the layers, and what rain does to them.
#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/rain/drop_size.h"
#include "shaders/fog.h"
#include "shaders/raindrop.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pluvia {
namespace {

RenderSettings rainy(std::vector<double> intensities, int samples = 4) {
    RenderSettings settings;
    settings.samples = samples;
    settings.rain.intensities_mm_per_h = std::move(intensities);
    settings.rain.min_width_pixels = 0.25;
    return settings;
}

const Environment& grey_world() {
    static const Environment world = Environment::uniform({0.8f, 1.0f, 1.3f});
    return world;
}

}  // namespace

TEST_CASE("a frame has the same bytes for any number of threads, any tile size and any run") {
    Scene scene = make_court(lambert(Rgb(0.6f)));
    add_sphere(scene, {1, 3, -2}, 0.2f, 16, emitter(Rgb(50)));
    const View view = court_view(70, 37);
    const RenderSettings settings = rainy({10, 100});
    const Picture first = render_picture(scene, grey_world(), view, settings);
    CHECK(first == render_picture(scene, grey_world(), view, settings));
    for (const int tile : {7, 16, 64}) {
        RenderSettings other = settings;
        other.tile_size = tile;
        CAPTURE(tile);
        CHECK(first == render_picture(scene, grey_world(), view, other));
    }
    for (const int threads : {1, 2}) {
        set_thread_count(threads);
        CAPTURE(threads);
        CHECK(first == render_picture(scene, grey_world(), view, settings));
    }
    set_thread_count(0);
    RenderSettings other = settings;
    other.seed = 1;
    CHECK_FALSE(first == render_picture(scene, grey_world(), view, other));  // the comparison can fail
}

TEST_CASE("the background and the layers of one intensity do not depend on what else is asked for") {
    const auto check = [](const Scene& scene, const View& view) {
        const Picture dry = render_picture(scene, grey_world(), view, rainy({}));
        const Picture one = render_picture(scene, grey_world(), view, rainy({10}));
        const Picture many = render_picture(scene, grey_world(), view, rainy({100, 10, 50}));
        for (const auto& [channel, plane] : dry.planes) CHECK(plane == one.plane(channel));
        for (const auto& [channel, plane] : one.planes) {
            CAPTURE(channel);
            CHECK(plane == many.plane(channel));
        }
        CHECK(one.mean("rain_010.A") > 0);
        return one;
    };
    check(make_court(lambert(Rgb(0.6f))), court_view(64, 32));
    // Far away fine rain hides so much that it is lit for every sample, at each of these intensities.
    Scene plain;
    add_quad(plain, {-3000, 0, 3000}, {6000, 0, 0}, {0, 0, -6000}, lambert(Rgb(0.6f)));
    const Picture one = check(plain, look_at({0, 2, 0}, {0, 2, -100}, 32, 16, 400));
    CHECK(one.plane("transmittance_010.G")[32 * 8 + 16] < 0.5f);
}

TEST_CASE("rainy is background times transmittance plus rain plus in-scatter in every pixel") {
    Scene scene = make_court(lambert(Rgb(0.6f)));
    add_sphere(scene, {1, 3, -2}, 0.2f, 16, emitter(Rgb(50)));
    for (const Composition composition : {Composition::physical, Composition::paper}) {
        RenderSettings settings = rainy({10, 100}, 8);
        settings.streaks.composition = composition;
        const Picture p = render_picture(scene, grey_world(), court_view(64, 32), settings);
        double worst = 0;
        for (const char* label : {"010", "100"})
            for (const char* c : {".R", ".G", ".B"})
                for (size_t i = 0; i < p.plane("Z").size(); ++i) {
                    const std::string l = label;
                    const double sum =
                        double(p.plane(std::string("background") + c)[i]) * p.plane("transmittance_" + l + c)[i] +
                        p.plane("rain_" + l + c)[i] + p.plane("inscatter_" + l + c)[i];
                    const double rainy = p.plane("rainy_" + l + c)[i];
                    worst = std::max(worst, std::abs(sum - rainy) / std::max(rainy, 1e-30));
                }
        // Four roundings of half a unit in the last place each.
        CHECK(worst <= 4 * 0.5 * std::numeric_limits<float>::epsilon());
        for (size_t i = 0; i < p.plane("Z").size(); ++i) {
            CHECK(p.plane("rain_010.A")[i] <= p.plane("rain_100.A")[i]);  // the drops of 10 mm/h are among those of 100
            CHECK(p.plane("rain_100.A")[i] <= 1);
            CHECK(p.plane("rainy_Z_100")[i] <= p.plane("Z")[i]);
        }
        CHECK(p.mean("rain_100.G") > p.mean("rain_010.G"));
    }
}

TEST_CASE("depth is exact along the view axis and infinite in the sky") {
    Scene scene;
    add_quad(scene, {-100, -100, -7}, {200, 0, 0}, {0, 100, 0}, lambert(Rgb(0.5f)));  // below the horizon only
    const View view = look_at({0, 0, 0}, {0, 0, -1}, 16, 16, 10);
    const Picture p = render_picture(scene, grey_world(), view, {.samples = 1});
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const float z = p.plane("Z")[size_t(y * 16 + x)], distance = p.plane("distance.Y")[size_t(y * 16 + x)];
            if (y < 8) {
                CHECK(std::isinf(z));
                CHECK(std::isinf(distance));
                continue;
            }
            const double dx = (x + 0.5 - 8) / 10, dy = (y + 0.5 - 8) / 10;
            CHECK(z == doctest::Approx(7).epsilon(1e-6));
            CHECK(distance == doctest::Approx(7 * std::sqrt(1 + dx * dx + dy * dy)).epsilon(1e-6).scale(0));
        }
}

TEST_CASE("a scene a million metres away renders the same within noise") {
    Scene near_scene = make_court(lambert(Rgb(0.6f)));
    near_scene.cameras.push_back({"camera", translate({1, 1.6, 3.5}), 0.6});
    Scene far_scene = near_scene;
    const Vec3d offset(1e6, 2e4, -1e6);
    for (Instance& i : far_scene.instances) i.scene_from_object.translation += offset;
    far_scene.cameras[0].scene_from_camera.translation += offset;
    rebase(near_scene), rebase(far_scene);
    const CameraSettings camera{.width = 64, .height = 32};
    RenderSettings settings;
    settings.samples = 64;
    const Picture a = render_picture(near_scene, grey_world(), make_view(near_scene.cameras[0], camera), settings);
    settings.seed = 5;
    const Picture b = render_picture(near_scene, grey_world(), make_view(near_scene.cameras[0], camera), settings);
    const Picture far = render_picture(far_scene, grey_world(), make_view(far_scene.cameras[0], camera), settings);
    double noise = 0, difference = 0;
    for (size_t i = 0; i < a.plane("Z").size(); ++i) {
        noise += std::pow(a.plane("background.G")[i] - b.plane("background.G")[i], 2);
        difference += std::pow(a.plane("background.G")[i] - far.plane("background.G")[i], 2);
        // The ground is flat: depths differ by the rounding of doubles at a million metres, 1e-10 m, and of float.
        if (std::isfinite(a.plane("Z")[i]))
            CHECK(far.plane("Z")[i] == doctest::Approx(a.plane("Z")[i]).epsilon(1e-5).scale(0));
    }
    CHECK(difference < 1.3 * noise);  // two sums of 2048 squares: 3 % sigma each
    CHECK(difference > 0);
    CHECK(far.mean("background.G") == doctest::Approx(a.mean("background.G")).epsilon(5e-3).scale(0));
}

TEST_CASE("twice the exposure leaves the summed coverage of streaks as it is") {
    // The drop's disk passes over twice the pixels for half the share of time each. Drops at the borders come and go,
    // so the exposures are compared over a wide picture without ground.
    Scene scene;
    add_quad(scene, {-1, -200, 1}, {2, 0, 0}, {0, 0, 2}, lambert(Rgb(0.5f)));
    View view = look_at({0, 0, 0}, {0, 0, -1}, 128, 128, 100);
    RunningMean ratio;
    for (uint64_t seed = 0; seed < 12; ++seed) {
        RenderSettings settings = rainy({100}, 8);
        settings.rain.seed = seed;
        view.exposure_time = 1.0 / 120, view.shutter_open = -view.exposure_time / 2;
        const double shorter = render_picture(scene, grey_world(), view, settings).mean("rain_100.A");
        view.exposure_time = 1.0 / 60, view.shutter_open = -view.exposure_time / 2;
        ratio.add(render_picture(scene, grey_world(), view, settings).mean("rain_100.A") / shorter);
    }
    CAPTURE(ratio.mean());
    CAPTURE(ratio.standard_error());
    CHECK(ratio.agrees_with(1, 0.01));  // 1 %: overlap of drops differs a little
}

TEST_CASE("by night rain is seen by the light of lamps alone") {
    Scene scene;
    add_quad(scene, {-20, 0, 5}, {40, 0, 0}, {0, 0, -40}, lambert(Rgb(0)));
    const View view = look_at({0, 1.6, 4}, {0, 1.6, 0}, 64, 32, 60);
    CHECK(render_picture(scene, Environment(), view, rainy({100})).mean("rain_100.G") == 0);
    scene.lights.push_back({.name = "lamp", .intensity = Rgb(1000), .position = {0, 2, -2}});
    const Picture lit = render_picture(scene, Environment(), view, rainy({100}, 16));
    CHECK(lit.mean("rain_100.G") > 0);
    CHECK(lit.mean("background.G") == 0);
    CHECK(lit.mean("inscatter_100.G") > 0);
    for (size_t i = 0; i < lit.plane("Z").size(); ++i)  // nothing behind: transmittance is the mean transmission
        CHECK(lit.plane("transmittance_100.G")[i] <= 1 - lit.plane("rain_100.A")[i]);
    // By the paper's composition the air between the streaks is clear.
    RenderSettings paper = rainy({100}, 16);
    paper.streaks.composition = Composition::paper;
    const Picture clear = render_picture(scene, Environment(), view, paper);
    CHECK(clear.mean("inscatter_100.G") == 0);
    for (size_t i = 0; i < clear.plane("Z").size(); ++i)
        CHECK(clear.plane("transmittance_100.G")[i] ==
              doctest::Approx(1 - clear.plane("rain_100.A")[i]).epsilon(1e-6).scale(0));
}

TEST_CASE("under a roof there is no rain") {
    Scene scene;
    add_quad(scene, {-200, 0, 200}, {400, 0, 0}, {0, 0, -400}, lambert(Rgb(0.5f)));
    const View view = look_at({0, 1.6, 4}, {0, 1.5, 0}, 64, 32, 60);
    const Picture open = render_picture(scene, grey_world(), view, rainy({100}));
    CHECK(open.mean("rain_100.A") > 0);
    CHECK(open.report.sheltered_streaks == 0);
    add_quad(scene, {-200, 20, -200}, {400, 0, 0}, {0, 0, 400}, lambert(Rgb(0.5f)));
    const Picture roofed = render_picture(scene, grey_world(), view, rainy({100}));
    CHECK(roofed.mean("rain_100.A") == 0);
    CHECK(roofed.report.sheltered_streaks > 0);
}

TEST_CASE("a lens blurs what is out of focus and keeps its light") {
    Scene scene;
    add_quad(scene, {-0.2f, -0.2f, -2}, {0.4f, 0, 0}, {0, 0.4f, 0}, emitter(Rgb(1)));
    View view = look_at({0, 0, 0}, {0, 0, -1}, 64, 64, 60);
    const Picture pinhole = render_picture(scene, Environment(), view, {.samples = 256});
    view.lens_radius = 0.1;
    for (const double focus : {2.0, 4.0}) {
        view.focus_distance = focus;
        const Picture p = render_picture(scene, Environment(), view, {.samples = 256});
        double difference = 0;
        for (size_t i = 0; i < p.plane("Z").size(); ++i)
            difference =
                std::max(difference, double(std::abs(p.plane("background.G")[i] - pinhole.plane("background.G")[i])));
        CAPTURE(focus);
        CHECK((difference < 0.2) == (focus == 2.0));  // in focus only the sampled edges differ
        CHECK(p.mean("background.G") == doctest::Approx(pinhole.mean("background.G")).epsilon(0.01).scale(0));
    }
}

TEST_CASE("an interrupted render throws and leaves nobody waiting") {
    const Scene scene = make_court(lambert(Rgb(0.5f)));
    RenderSettings settings;
    settings.samples = 1, settings.tile_size = 8;
    int calls = 0;
    try {
        render(
            scene, grey_world(), court_view(64, 1024), settings, [](const Band&) {},
            [&](double) { return ++calls < 40; });
        FAIL("was not stopped");
    } catch (const Error& e) {
        CHECK(e.code() == ExitCode::stopped_early);
    }
}

TEST_CASE("a band sink that fails stops the render with its error") {
    const Scene scene = make_court(lambert(Rgb(0.5f)));
    RenderSettings settings;
    settings.samples = 1, settings.tile_size = 8;
    const auto full_disk = [](const Band&) { throw Error(ExitCode::render_failed, "disk", "is full"); };
    CHECK_THROWS_AS(render(scene, grey_world(), court_view(64, 512), settings, full_disk, [](double) { return true; }),
                    Error);
}

TEST_CASE("a picture of many narrow bands is finished by threads that overtake each other") {
    const Scene nothing;
    View view = court_view(8, 4096);
    RenderSettings settings;
    settings.samples = 1, settings.tile_size = 8;
    set_thread_count(16);
    for (int i = 0; i < 20; ++i) CHECK(render_picture(nothing, grey_world(), view, settings).mean("background.G") == 1);
    set_thread_count(0);
}

TEST_CASE("streaks cover their optical depth; they and the medium turn a lamp's light by one scattering each") {
    // Nothing but rain and a lamp behind it.
    Scene scene;
    const double intensity = 100, least_width = 0.04, candela = 500;
    const Vec3d to_lamp(1.5, 0, 12);  // from the camera, view axes
    scene.lights.push_back({.name = "lamp", .intensity = Rgb(float(candela)), .position = {1.5, 500, -12}});
    const View view = look_at({0, 500, 0}, {0, 500, -1}, 32, 16, 64);
    RenderSettings settings = rainy({intensity}, 16);
    settings.rain.min_width_pixels = least_width;
    RunningMean coverage, streak_light, medium_light;
    for (uint64_t seed = 0; seed < 64; ++seed) {
        settings.seed = settings.rain.seed = seed;
        const Picture picture = render_picture(scene, Environment(), view, settings);
        coverage.add(picture.mean("rain_100.A"));
        streak_light.add(picture.mean("rain_100.G"));
        medium_light.add(picture.mean("inscatter_100.G"));
    }

    RunningMean expected_coverage, expected_streaks, expected_medium;
    const double near = settings.rain.near, far = 200;  // beyond, the lamp is behind the drops: less than 1e-4 of it
    constexpr int n = 4;                                // towards the lamp light rises as 1 / distance within a pixel
    for (int y = 0; y < view.height * n; ++y)
        for (int x = 0; x < view.width * n; ++x) {
            const Vec3d direction(view.view_direction({(float(x) + 0.5f) / n, (float(y) + 0.5f) / n}));
            const double slant = length(direction), closest = dot(to_lamp, direction) / (slant * slant);
            const double aside = length(to_lamp - direction * closest) / slant;
            // Depths even in their logarithm, and even in the angle seen from the lamp.
            std::vector<double> depths;
            for (int i = 0; i <= 400; ++i) depths.push_back(near * std::pow(far / near, i / 400.0));
            for (int i = 1; i < 200; ++i)
                if (const double z = closest + aside / slant * std::tan(1.5707 * (i / 100.0 - 1)); z > near && z < far)
                    depths.push_back(z);
            std::sort(depths.begin(), depths.end());
            double covered = 0, depth = 0, by_streaks = 0, by_medium = 0;
            for (size_t i = 1; i < depths.size(); ++i) {
                const double z = (depths[i] + depths[i - 1]) / 2, step = (depths[i] - depths[i - 1]) * slant;
                const double smallest = std::max(smallest_drop, least_width * z / view.focal_pixels);
                const double streaks = extinction(intensity, smallest, largest_drop) * step;
                const double all = extinction(intensity) * step;
                const Vec3d rest = to_lamp - direction * z;
                const double cosine = dot(rest, direction) / (length(rest) * slant);
                const double light =
                    std::exp(-depth - all / 2) * drop_phase(float(cosine)) * candela / length_squared(rest);
                by_streaks += light * streaks, by_medium += light * (all - streaks);
                covered += streaks, depth += all;
            }
            expected_coverage.add(1 - std::exp(-covered));
            expected_streaks.add(by_streaks);
            expected_medium.add(by_medium);
        }
    const auto check = [](const RunningMean& measured, const RunningMean& expected) {
        CAPTURE(measured.mean());
        CAPTURE(expected.mean());
        CAPTURE(measured.standard_error());
        CHECK(measured.agrees_with(expected.mean(), 5e-3 * expected.mean()));  // of the quadrature beside the lamp
        CHECK(measured.standard_error() < 0.012 * expected.mean());
    };
    check(coverage, expected_coverage);
    check(streak_light, expected_streaks);
    check(medium_light, expected_medium);
}

TEST_CASE("through 100 m of rain at 10, 50 and 100 mm/h one sees 0.925, 0.81 and 0.72 of what is there") {
    Scene scene;
    add_quad(scene, {-60, -60, -100}, {120, 0, 0}, {0, 120, 0}, emitter(Rgb(1)));
    const View view = look_at({0, 20, 0}, {0, 20, -1}, 48, 24, 48 * 35 / 36.0);
    RenderSettings settings = rainy({10, 50, 100}, 16);
    std::array<RunningMean, 3> transmittance;
    for (uint64_t seed = 0; seed < 16; ++seed) {
        settings.seed = settings.rain.seed = seed;
        const Picture picture = render_picture(scene, Environment(), view, settings);
        int i = 0;
        for (const char* label : {"010", "050", "100"}) {
            double centre = 0;  // the card's middle: rays of 100 m
            for (int x = 22; x < 26; ++x)
                for (int y = 10; y < 14; ++y)
                    centre += picture.plane(std::string("transmittance_") + label + ".G")[size_t(y * 48 + x)] / 16;
            transmittance[i++].add(centre);
        }
    }
    const double expected[] = {0.925, 0.81, 0.72};
    for (int i = 0; i < 3; ++i) {
        CAPTURE(transmittance[i].mean());
        CHECK(std::abs(transmittance[i].mean() - expected[i]) < 0.01);
        CHECK(transmittance[i].standard_error() < 0.002);
    }
}

TEST_CASE("light from behind is seen through fog as bright as one scattering makes it") {
    Scene scene;
    scene.lights.push_back({.name = "lamp", .intensity = Rgb(500), .position = {1.5, 500, -12}});
    const View view = look_at({0, 500, 0}, {0, 500, -1}, 32, 16, 64);
    RenderSettings settings = rainy({100}, 64);
    settings.streaks.composition = Composition::paper;  // no fine drops
    settings.rain.min_width_pixels = 100;               // and hardly a streak
    settings.rain.fog_extinction = 0.01;
    RunningMean measured, expected;
    for (uint64_t seed = 0; seed < 16; ++seed) {
        settings.seed = settings.rain.seed = seed;
        measured.add(render_picture(scene, Environment(), view, settings).mean("inscatter_100.G"));
    }
    // Over whole pixels, since next to the lamp the light goes with the inverse of the ray's distance from it; and even
    // in the angle under which the lamp sees the ray (Kulla and Fajardo 2012, section 4), which leaves a smooth rest.
    constexpr int parts = 32, steps = 64;
    for (int y = 0; y < view.height * parts; ++y)
        for (int x = 0; x < view.width * parts; ++x) {
            const Vec2 pixel((float(x) + 0.5f) / parts, (float(y) + 0.5f) / parts);
            const Vec3d direction = normalize(Vec3d(view.view_direction(pixel))), lamp(1.5, 0, 12);
            const double closest = dot(lamp, direction), aside = length(lamp - direction * closest);
            const double first = std::atan((0.1 - closest) / aside), last = std::atan((2000 - closest) / aside);
            double sum = 0;
            for (int i = 0; i < steps; ++i) {
                const double t = closest + aside * std::tan(first + (i + 0.5) / steps * (last - first));
                const Vec3d rest = lamp - direction * t;
                sum += std::exp(-0.01 * t) * fog_phase(float(dot(rest, direction) / length(rest)));
            }
            expected.add(0.01 * 500 * sum * (last - first) / (steps * aside));
        }
    CAPTURE(measured.mean());
    CAPTURE(expected.mean());
    CHECK(measured.agrees_with(expected.mean(), 2e-3 * expected.mean()));  // the quadrature, and near ends off the axis
    CHECK(measured.standard_error() < 0.02 * expected.mean());
}

}  // namespace pluvia
