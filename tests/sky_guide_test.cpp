// Light samples of the sky that know where it is hidden: they follow their pdf, lose nothing, and bring less noise.
#include "renderer/transport/sky_guide.h"
#include "renderer/transport/camera_ray.h"
#include "renderer/transport/path.h"
#include "renderer/transport/sky_sights.h"
#include "shaders/sky.h"
#include "tests/environments.h"
#include "tests/skies.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

using namespace pluvia;

namespace {

constexpr int width = 64, height = 32;
const Receiver here = {{1, 0, 2}, {0, 1, 0}};

/// A place that sees two gaps, one of them narrow.
std::vector<SkySight> two_gaps(const Environment& environment) {
    std::vector<SkySight> sights;
    for (int i = 0; i < 600; ++i)
        sights.push_back(
            {here, environment.sky(direction_from_equirectangular(0.2 + 0.1 * uniform(3, i, 0), 0.2)).block});
    for (int i = 0; i < 50; ++i)
        sights.push_back({here, environment.sky(direction_from_equirectangular(0.7, 0.3)).block});
    return sights;
}

EnvironmentSample draw_guided(const SkyGuide& guide, const Receiver& receiver, uint64_t seed, uint64_t i) {
    Counters counters;
    return guide.estimate(receiver, uniform_2d(seed, i, 0), counters);
}

}  // namespace

TEST_CASE("guided samples of the sky follow their pdf") {
    const Environment environment(rough_picture(width, height));
    const SkyGuide guide(environment, two_gaps(environment));
    const Receiver beside{{3, 1, 2}, {0, 1, 0}}, far_off{{500, 0, 0}, {0, 1, 0}}, wall{{1, 0, 2}, {1, 0, 0}};
    for (const Receiver& receiver : {here, beside, far_off, wall}) {
        CAPTURE(receiver.position.x);
        std::vector<double> found(width * height), expected(found.size());
        constexpr int count = 400000;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const EnvironmentSample sky =
                    environment.sky(direction_from_equirectangular((x + 0.5) / width, (y + 0.5) / height));
                const double solid_angle =
                    2 * std::numbers::pi / width *
                    (std::cos(std::numbers::pi * y / height) - std::cos(std::numbers::pi * (y + 1) / height));
                expected[size_t(y * width + x)] = count * double(guide.pdf(receiver, sky)) * solid_angle;
            }
        for (int i = 0; i < count; ++i) {
            const EnvironmentSample s = draw_guided(guide, receiver, 11, i);
            const Vec2 uv = equirectangular_from_direction(s.wi);
            const int x = std::min(int(uv.x * width), width - 1), y = std::min(int(uv.y * height), height - 1);
            ++found[size_t(y * width + x)];
        }
        const ChiSquare test = chi_square_test(found, expected);
        CHECK(test.degrees_of_freedom > 100);
        CHECK(test.p_value > five_sigma_p_value);
    }
}

TEST_CASE("guided samples find all the light of the sky, and most of them what can be seen") {
    const Environment environment(rough_picture(width, height));
    const std::vector<SkySight> sights = two_gaps(environment);
    const SkyGuide guide(environment, sights);
    RunningMean light, seen;
    for (int i = 0; i < 200000; ++i) {
        const EnvironmentSample s = draw_guided(guide, here, 12, i);
        if (s.pdf > 0) light.add(double(luminance(environment.sky(s.wi).radiance) / s.pdf));
        const Vec2 uv = equirectangular_from_direction(s.wi);
        // Sights speak for the blocks around theirs as well: 1/32 of the azimuth, 1/16 of the height.
        const bool in_wide = std::abs(uv.x - 0.25f) < 0.12f && uv.y < 0.35f;
        const bool in_narrow = std::abs(uv.x - 0.7f) < 0.07f && uv.y < 0.42f;
        seen.add(in_wide || in_narrow ? 1 : 0);
    }
    const double expected = 4 * std::numbers::pi * luminance(environment.mean_radiance());
    CHECK(std::abs(light.mean() - expected) < 5 * light.standard_error());
    // Nine of ten samples are guided, and 20 of 670 sights stand for what is known of no place.
    CHECK(seen.mean() > 0.8);
}

TEST_CASE("what a guide learns does not depend on the order of what it is told") {
    const Environment environment(rough_picture(width, height));
    std::vector<SkySight> sights = two_gaps(environment);
    for (int i = 0; i < 3000; ++i) {
        const Vec3 at(20 * uniform(5, i, 0), 3 * uniform(5, i, 1), 20 * uniform(5, i, 2));
        sights.push_back(
            {{at, {0, 1, 0}}, environment.sky(direction_from_equirectangular(uniform(5, i, 3), 0.1)).block});
    }
    const SkyGuide guide(environment, sights);
    std::reverse(sights.begin(), sights.end());
    std::rotate(sights.begin(), sights.begin() + 1000, sights.end());
    const SkyGuide other(environment, sights);
    for (int i = 0; i < 1000; ++i) {
        const Receiver receiver{{20 * uniform(6, i, 0), 0.5f, 20 * uniform(6, i, 1)}, {0, 1, 0}};
        const EnvironmentSample a = draw_guided(guide, receiver, 13, i), b = draw_guided(other, receiver, 13, i);
        REQUIRE(a.wi == b.wi);
        REQUIRE(a.pdf == b.pdf);
    }
}

TEST_CASE("between high walls guided samples give the same light with less than half of the noise") {
    Scene scene;
    Material stone = lambert(Rgb(0.4f));
    stone.double_sided = true;
    add_quad(scene, {-1.5, 0, 30}, {3, 0, 0}, {0, 0, -60}, stone);
    add_quad(scene, {-1.5, 0, 30}, {0, 0, -60}, {0, 12, 0}, stone);
    add_quad(scene, {1.5, 0, 30}, {0, 0, -60}, {0, 12, 0}, stone);
    Image<Rgb> overcast(128, 64);  // Moon and Spencer 1942: three times as bright at the zenith as at the horizon
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 128; ++x)
            overcast.at(x, y) = Rgb(float(1000 + 2000 * std::cos(std::numbers::pi * (y + 0.5) / 64)));
    const Environment environment(std::move(overcast));
    const View view = look_at({0, 1.5, 5}, {0.3, 0.6, -5}, 96, 64, 90);
    const RayScene ray_scene(scene);
    const Lights lights(scene, environment);
    Counters counters;
    const SkyGuide guide(environment, find_sky_sights(ray_scene, environment, view, nullptr, 1, counters));
    const PathTracer plain(scene, ray_scene, lights, {}), guided(scene, ray_scene, lights, {}, nullptr, &guide);

    RunningMean of_plain, of_guided;
    double noise_plain = 0, noise_guided = 0;
    for (int y = 0; y < view.height; y += 2)
        for (int x = 0; x < view.width; x += 2) {
            RunningMean a, b;
            for (uint32_t i = 0; i < 64; ++i) {
                const Ray ray = scene_ray(view, Bounds(), view_ray(view, {float(x), float(y)}, {})).near;
                const auto trace = [&](const PathTracer& tracer, uint64_t seed) {
                    return double(luminance(
                        tracer.trace(ray, {}, Sampler(seed, uint32_t(x), uint32_t(y), i), 0, counters).radiance));
                };
                a.add(trace(plain, 21)), b.add(trace(guided, 22));
            }
            of_plain.add(a.mean()), of_guided.add(b.mean());
            noise_plain += a.variance(), noise_guided += b.variance();
        }
    // Pixels differ more than their noise, so that the mean of differences is judged by the noise alone.
    const double pixels = double(view.width / 2) * (view.height / 2);
    const double error = std::sqrt((noise_plain + noise_guided) / 64) / pixels;
    CHECK(std::abs(of_plain.mean() - of_guided.mean()) < 5 * error);
    CHECK(error < 0.01 * of_plain.mean());
    CHECK(noise_guided < 0.5 * noise_plain);
    CHECK(counters[Feature::guided_sky] > 0);
}

TEST_CASE("a guide is made where the sky lights most, and for no other picture") {
    Scene dark, lit;
    lit.lights.push_back({.intensity = Rgb(100), .position = {0, 5, 0}});
    const auto is_worth = [&](const Environment& environment, bool has_lamps) {
        return is_worth_guiding(Lights(has_lamps ? lit : dark, environment));
    };
    const auto at = [](double elevation, double cover) {
        SkySettings settings;
        settings.sun_elevation = radians_from_degrees(elevation), settings.clouds.cover = cover;
        return make_sky(standard_sky_tables(), settings);
    };
    CHECK(is_worth(at(50, 1), true));
    CHECK(is_worth(at(-3, 0), true));
    CHECK_FALSE(is_worth(at(50, 0), false));  // the sun lights more
    CHECK_FALSE(is_worth(at(-30, 1), true));  // lamps do
    CHECK(is_worth(at(-30, 1), false));
    CHECK_FALSE(is_worth(Environment::uniform(Rgb(1)), false));
    Image<Rgb> with_sun(256, 128, Rgb(1));
    with_sun.at(44, 20) = Rgb(500000);  // the others together are 32767
    CHECK_FALSE(is_worth(Environment(with_sun), false));
    Image<Rgb> with_wide_sun(256, 128, Rgb(1));
    for (int y = 40; y < 52; ++y)
        for (int x = 100; x < 112; ++x) with_wide_sun.at(x, y) = Rgb(220);
    CHECK_FALSE(is_worth(Environment(with_wide_sun), false));

    Scene scene;
    add_quad(scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, lambert(Rgb(0.5f)));
    const View view = look_at({0, 2, 0}, {1, 0, 0}, 8, 8, 8);
    const auto guided = [&](const Environment& environment) {
        return render_picture(scene, environment, view, {.samples = 2}).report.counters[Feature::guided_sky];
    };
    CHECK(guided(at(50, 1)) > 0);
    CHECK(guided(at(50, 0)) == 0);
}
