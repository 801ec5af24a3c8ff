// Drops that are looked into: the picture in them, and that it passes over into the phase function without a step.
#include "renderer/core/sampling.h"
#include "renderer/core/transform.h"
#include "shaders/drop_lens.h"
#include "shaders/raindrop.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <cmath>

namespace pluvia {
namespace {

Vec3 turned(double degrees, double phi) {
    const double t = degrees * 0.0174532925199433;
    return Vec3(float(std::sin(t) * std::cos(phi)), float(std::sin(t) * std::sin(phi)), float(-std::cos(t)));
}

/// Mean density of a drop's disk towards directions turned by an angle, over all sides. shape_of(i): the drop at ray i.
template <class ShapeOf>
RunningMean mean_density(double degrees, float width, const ShapeOf& shape_of) {
    RunningMean mean;
    for (uint64_t i = 0; i < 40000; ++i) {
        const float r = std::sqrt(uniform(2, i, 0)), phi = 6.2831853f * uniform(2, i, 1);
        DropLens lens(width);
        lens.add(shape_of(i), {0, 0, -1}, {r * std::cos(phi), r * std::sin(phi), 0}, 1);
        double sum = 0;
        for (int k = 0; k < 16; ++k) sum += lens.evaluate(turned(degrees, (k + uniform(2, i, 2)) * 0.39269908));
        mean.add(sum / 16);
    }
    return mean;
}

/// A telephoto view into the air: a small picture in which drops are many pixels wide.
View tele_view(double focal_pixels) {
    View view;
    view.width = 48, view.height = 24;
    view.focal_pixels = focal_pixels;
    view.position = Vec3d(0, 2, 0);
    return view;
}

}  // namespace

TEST_CASE(
    "the mean of the pictures in round drops is the phase function, so that the switch between them is seamless") {
    for (const double degrees : {0.0, 10.0, 20.0, 30.0, 45.0, 60.0, 100.0, 120.0, 150.0}) {
        CAPTURE(degrees);
        // The phase function blurred by the lens's own cone.
        RunningMean expected;
        for (uint64_t i = 0; i < 200000; ++i) {
            const Vec3 wi =
                ShadingBasis(turned(degrees, 0)).to_world(sample_cone(uniform_2d(6, i, 0), 1 - std::cos(0.13962634f)));
            expected.add(drop_phase(-wi.z));
        }
        const RunningMean lens = mean_density(degrees, 1, [](uint64_t) { return DropShape(); });
        CAPTURE(lens.mean());
        CAPTURE(expected.mean());
        // 2 %: orders above the sixth are turned as the sixth by one, as the eleventh by the other, and a lens ends
        // inner reflections at half a per cent of the light, which is a few per cent of what little there is beside.
        const double beside = degrees > 90 ? 0.06 : 0.02;
        CHECK(std::abs(lens.mean() - expected.mean()) < beside * expected.mean() + 5 * lens.standard_error());
        // And the blur itself is no step where drops shine: 7 % in the cusp straight ahead, less elsewhere.
        if (degrees <= 30)
            CHECK(std::abs(expected.mean() / drop_phase(float(std::cos(degrees / 57.29578))) - 1) < 0.08);
    }
}

TEST_CASE("a drop shows the world upside down") {
    DropLens lens(20);
    lens.add(DropShape(), {0, 0, -1}, {0, 0.6f, 0}, 1);  // through its upper half
    const double turn = drop_paths(std::asin(0.6)).turn[1];
    const Vec3 below(0, float(-std::sin(turn)), float(-std::cos(turn)));
    CHECK(lens.evaluate(below) > 100);
    CHECK(lens.evaluate({below.x, -below.y, below.z}) == 0);
}

TEST_CASE("directions drawn from the picture in a drop have the density that it states") {
    DropLens lens(4);
    const DropOscillation drop = drop_oscillation(1.5e-3, 12);
    const Vec3 direction = normalize(Vec3(0.3f, 0.2f, -1)), side = normalize(cross(direction, Vec3(0, 1, 0)));
    for (int i = 0; i < 3; ++i) lens.add(drop.at(0.01 * i), direction, side * (0.3f * float(i) - 0.2f), 3);
    RunningMean total, found;
    for (uint64_t i = 0; i < 200000; ++i) {
        total.add(double(lens.evaluate(sample_sphere(uniform_2d(3, i, 0)))) * 4 * pi);
        const Vec3 wi = lens.sample(uniform_2d(3, i, 2));
        REQUIRE(lens.evaluate(wi) > 0);
        found.add(1 / double(lens.evaluate(wi)));
    }
    CHECK(total.agrees_with(1, 1e-3));
    // The mean of 1 / pdf is the solid angle in which there is any density: cones of 8 degrees, some of them
    // overlapping.
    const double cone = 2 * pi * (1 - std::cos(0.13962634));
    CHECK(found.mean() < 36 * cone);
    CHECK(found.mean() > 3 * cone);
}

TEST_CASE("in a uniform world drops that are looked into are invisible") {
    const Scene scene;
    RenderSettings settings;
    settings.samples = 16;
    settings.rain.intensities_mm_per_h = {100};
    settings.rain.min_width_pixels = 1;
    RunningMean excess;
    double wide = 0;
    for (uint64_t seed = 0; seed < 24; ++seed) {
        settings.seed = settings.rain.seed = seed;
        const Picture picture = render_picture(scene, Environment::uniform(Rgb(1)), tele_view(4000), settings);
        excess.add(picture.mean("rainy_100.G") - 1);
        wide += picture.mean("rain_wide_100.A") / 24;
    }
    CAPTURE(excess.mean());
    CHECK(wide > 0.01);  // the test sees drops
    CHECK(excess.agrees_with(0, 1e-5));
}

TEST_CASE("drops two pixels wide are as bright as drops one pixel wide, under a sky above dark ground") {
    const Scene scene;
    Image<Rgb> sky(64, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) sky.at(x, y) = Rgb(y < 14 ? 1.0f : 0.2f);
    const Environment world(sky);
    const auto brightness = [&](double focal_pixels, double streak_width) {
        RenderSettings settings;
        settings.samples = 32;
        settings.rain.intensities_mm_per_h = {100};
        settings.rain.min_width_pixels = streak_width;
        RunningMean mean;
        for (uint64_t seed = 0; seed < 32; ++seed) {
            settings.seed = settings.rain.seed = seed;
            const Picture picture = render_picture(scene, world, tele_view(focal_pixels), settings);
            mean.add(picture.mean("rain_100.G") / picture.mean("rain_100.A"));
        }
        return mean;
    };
    // The same drops at two focal lengths: mostly below and mostly above the switch.
    const RunningMean narrow = brightness(1500, 0.75), wide = brightness(3000, 1.5);
    CAPTURE(narrow.mean());
    CAPTURE(wide.mean());
    const double error = std::hypot(narrow.standard_error(), wide.standard_error());
    CAPTURE(error);
    // 3 %: wide drops are flat and turn a few per cent more light straight through than round ones.
    CHECK(std::abs(wide.mean() - narrow.mean()) < 0.03 + 5 * error);
    CHECK(error < 0.02);
}

}  // namespace pluvia
