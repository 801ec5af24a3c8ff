// What only decides over noise changes no mean: light samples and both roulettes of a path.
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

namespace pluvia {

TEST_CASE("light samples and roulette change the mean of no picture") {
    Scene scene = make_court(lambert(Rgb(0.8f)));
    for (int i = 0; i < 20; ++i)
        add_sphere(scene, Vec3(-2 + 0.2f * float(i), 0.3f + 0.1f * float(i % 5), -3 + 0.3f * float(i % 7)), 0.05f, 8,
                   emitter(Rgb(float(10 + 20 * (i % 4)))));
    const Environment world = Environment::uniform(Rgb(0.5f));
    const View view = look_at({0, 1, 0}, {0, 0, -3}, 16, 16, 12);
    const auto mean_with = [&](uint64_t seed, auto set) {
        RenderSettings settings;
        settings.samples = 128, settings.seed = seed;
        set(settings.path);
        return estimate(scene, world, view, settings, "background.G", 16);
    };
    const Estimate usual = mean_with(1, [](PathSettings&) {});
    CHECK(usual.standard_error < 3e-3 * usual.mean);
    uint64_t seed = 2;
    const auto check_same = [&](const char* what, auto set) {
        const Estimate other = mean_with(1000 * seed++, set);
        CAPTURE(what);
        CAPTURE(usual.mean);
        CAPTURE(other.mean);
        CAPTURE(other.standard_error);
        CHECK(std::abs(other.mean - usual.mean) < 5 * std::hypot(usual.standard_error, other.standard_error));
        CHECK(other.standard_error < 5e-3 * usual.mean);
    };
    for (const int n : {1, 2, 3, most_light_samples})
        check_same("light samples", [=](PathSettings& p) { p.light_samples = n; });
    for (const float c : {0.05f, 1.0f}) check_same("path roulette", [=](PathSettings& p) { p.path_roulette = c; });
    for (const float c : {0.0f, 1.0f}) check_same("shadow roulette", [=](PathSettings& p) { p.shadow_roulette = c; });
}

}  // namespace pluvia
