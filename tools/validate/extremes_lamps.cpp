// Lamps from the faintest to the brightest, closest and largest.
#include "tools/validate/extremes.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/running_mean.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi, albedo = 0.5;

RunningMean ground_light(const Scene& scene, const View& view, int samples, bool full) {
    return sound_means(scene, Environment(), view, {.samples = samples}, "background.G", full ? 64 : 8);
}

}  // namespace

std::vector<ExtremeResult> measure_lamp_extremes(bool full) {
    std::vector<ExtremeResult> results;
    const View point = look_at({4, 1.5, 3}, {0, 0, 0}, 4, 4, 1e7);
    for (const double candela : {1e-6, 1e9}) {
        Scene scene = make_plane(lambert(Rgb(float(albedo))));
        scene.lights = {{.name = "lamp", .intensity = Rgb(float(candela)), .position = {0, 2, 0}}};
        const double expected = albedo / pi_d * candela / 4;
        results.push_back(mean_result(fmt::format("lamp of {:g} cd, 2 m above: albedo I / (pi h^2)", candela), expected,
                                      ground_light(scene, point, 4, full), 2e-5 * expected));
    }
    // A faint lamp is not lost beside a bright one that stands 1 km away behind a wall: chance picks between them.
    {
        Scene scene = make_plane(lambert(Rgb(float(albedo))));
        scene.lights = {{.name = "faint", .intensity = Rgb(1), .position = {0, 2, 0}},
                        {.name = "bright", .intensity = Rgb(1e9f), .position = {0, 2, -1000}}};
        add_quad(scene, {-100, -100, -40}, {200, 0, 0}, {0, 200, 0}, lambert(Rgb(0)));
        const double expected = albedo / pi_d / 4;
        results.push_back(mean_result("lamp of 1 cd beside one of 1e9 cd behind a wall", expected,
                                      ground_light(scene, point, 16384, full), 2e-5 * expected));
    }
    {
        Scene scene = make_plane(lambert(Rgb(float(albedo))));
        scene.lights = {{.name = "lamp", .intensity = Rgb(1), .position = {0, 1e-3, 0}}};
        // The camera sees 0.1 micrometres, from the side.
        const double expected = albedo / pi_d / 1e-6;
        results.push_back(mean_result("lamp of 1 cd, 1 mm from a wall: albedo I / (pi h^2)", expected,
                                      ground_light(scene, look_at({0.04, 0.015, 0.03}, {0, 0, 0}, 4, 4, 1e6), 4, full),
                                      // 3e-4: paths start 1e-7 to 1e-6 m off the wall.
                                      3e-3 * expected));
    }
    {
        Scene scene = make_plane(lambert(Rgb(float(albedo))));
        Material glow = emitter(Rgb(1e9f));
        glow.double_sided = true;
        add_quad(scene, {-5e-7f, 1, -5e-7f}, {1e-6f, 0, 0}, {0, 0, 1e-6f}, glow);
        const double expected = albedo / pi_d * 1e9 * 1e-12;
        results.push_back(mean_result("two triangles of 5e-13 m2 and 1e9 cd/m2, 1 m above: albedo L A / (pi d^2)",
                                      expected, ground_light(scene, point, 16, full), 1e-4 * expected));
    }
    {
        Scene scene;
        add_quad(scene, {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}, lambert(Rgb(float(albedo))));
        Material glow = emitter(Rgb(3));
        glow.double_sided = true;
        add_quad(scene, {-7000, 10, 7000}, {14000, 0, 0}, {0, 0, -14000}, glow);
        // A square of half side a at height h: 4 a / sqrt(a^2 + h^2) atan(a / sqrt(a^2 + h^2)) / pi of the hemisphere.
        const double a = 7000, root = std::sqrt(a * a + 100);
        const double expected = albedo * 3 * 4 / pi_d * (a / root) * std::atan(a / root);
        results.push_back(mean_result("two triangles of 1e8 m2, 10 m above: form factor of a square", expected,
                                      ground_light(scene, point, 1024, full), 1e-4 * expected));
    }
    {
        // Denormal numbers are not rounded to 0.
        Scene scene;
        add_quad(scene, {-10, -10, -1}, {20, 0, 0}, {0, 20, 0}, emitter(Rgb(1e-40f)));
        results.push_back(relative_result(
            "card of 1e-40 cd/m2", double(1e-40f),
            sound_mean(render_picture(scene, Environment(), look_at({0, 0, 0}, {0, 0, -1}, 4, 4, 8), {.samples = 16}),
                       "background.G"),
            1e-5));
    }
    return results;
}

}  // namespace pluvia
