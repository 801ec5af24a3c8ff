// Glass: what passes panes and bodies, straight from what is seen behind and from lamps to what they light.
#include "shaders/pane.h"
#include "tools/validate/closed_forms.h"
#include "tools/validate/known_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double albedo = 0.5, tint = 0.8;

Material clear_glass() {
    Material glass = lambert(Rgb(1));
    glass.transmission = 1, glass.roughness = 0;
    return glass;
}

/// Ground under a tinted sheet at a height of 1 m.
Scene ground_under_pane() {
    Scene scene = make_plane(lambert(Rgb(float(albedo))));
    Material glass = clear_glass();
    glass.base_color = Rgb(float(tint));
    add_quad(scene, {-60, 1, 60}, {120, 0, 0}, {0, 0, -120}, glass);
    return scene;
}

double passed(double cosine) {
    return tint * (1 - pane_reflectance(float(cosine), 1.5f));
}

/// Light that the ground below the sheet sends on when it arrives straight: what ground and sheet send to each other
/// is left out by the limit of one bounce.
ClosedFormResult under_pane(const std::string& light, double expected, const Scene& scene,
                            const Environment& environment, int samples, uint64_t seed) {
    RenderSettings settings{.samples = samples};
    settings.path.max_bounces = 1;
    const View view = look_at({0.6, 0.5, 0.3}, {0, 0, 0}, 4, 4, 1e7);
    // 1e-4: the quadrature and Fresnel's terms in single precision.
    return rendered_result(light + " through a tinted pane onto the ground", expected, 1e-4,
                           estimate(scene, environment, view, settings, "background.G", 16, seed));
}

/// Irradiance of the origin by a square of 1 cd/m2 that faces down, its sides 2 m, through the pane.
double square_through_pane(double height) {
    constexpr int steps = 400;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const double x = 2 * (i + 0.5) / steps - 1, z = 2 * (k + 0.5) / steps - 1;
            const double squared = x * x + z * z + height * height, cosine = height / std::sqrt(squared);
            sum += passed(cosine) * cosine * cosine / squared;
        }
    return sum * 4 / (steps * steps);
}

}  // namespace

std::vector<ClosedFormResult> measure_panes(uint64_t seed) {
    std::vector<ClosedFormResult> results;
    const Material glass = clear_glass();
    for (const double degrees : {0.0, 60.0}) {
        Scene scene;
        add_quad(scene, {-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, glass);
        add_quad(scene, {-40, -40, -1}, {80, 0, 0}, {0, 80, 0}, emitter(Rgb(1)));
        const double i = degrees * std::numbers::pi / 180, t = std::asin(std::sin(i) / 1.5);
        const View view = look_at({2 * std::sin(i), 0, 2 * std::cos(i)}, {0, 0, 0}, 2, 2, 1e6);
        // Fresnel's reflectances of each polarisation.
        const double s = i == 0 ? 0.04 : std::pow(std::sin(i - t) / std::sin(i + t), 2);
        const double p = i == 0 ? 0.04 : std::pow(std::tan(i - t) / std::tan(i + t), 2);
        // Two faces reflect between each other. Source: Stokes 1862.
        const double expected = ((1 - s) / (1 + s) + (1 - p) / (1 + p)) / 2;
        results.push_back(
            rendered_result(fmt::format("light through a clear pane, {} degrees: Stokes' sum", degrees), expected, 1e-5,
                            estimate(scene, Environment(), view, {.samples = 512}, "background.G", 16, seed)));
    }

    Scene scene = ground_under_pane();
    scene.lights = {{.name = "lamp", .kind = PunctualLight::Kind::point, .intensity = Rgb(80), .position = {3, 2, 1}}};
    const double cosine = 2 / std::sqrt(14.0);
    results.push_back(under_pane("point light of 80 cd", albedo / std::numbers::pi * 80 * cosine / 14 * passed(cosine),
                                 scene, Environment(), 4, seed));
    scene = ground_under_pane();
    add_quad(scene, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, emitter(Rgb(7)));
    results.push_back(under_pane("square light of 2 m and 7 cd/m2",
                                 albedo / std::numbers::pi * 7 * square_through_pane(2), scene, Environment(), 1024,
                                 seed));
    Disc sun;
    sun.direction = normalize(Vec3(1, 1, 0)), sun.angular_radius = 0.005f, sun.strips = {Rgb(400000)};
    results.push_back(
        under_pane("sun disc", albedo * 400000 * std::pow(std::sin(0.005), 2) * std::sqrt(0.5) * passed(std::sqrt(0.5)),
                   ground_under_pane(), Environment(Image<Rgb>(4, 2, Rgb(0)), {sun}), 256, seed));
    return results;
}

std::vector<ClosedFormResult> measure_bodies(uint64_t seed) {
    std::vector<ClosedFormResult> results;
    for (const float ior : {1.0f, 1.5f})
        for (const double degrees : {0.0, 60.0}) {
            if (ior != 1 && degrees != 0) continue;  // reflections inside would have to be summed by polarisation
            Material body = clear_glass();
            body.thickness = 1, body.ior = ior;
            body.attenuation_color = Rgb(0.3f, 0.6f, 0.9f), body.attenuation_distance = 0.5f;
            Scene scene;
            add_box(scene, {-20, -20, -0.5f}, {20, 20, 0}, body);
            add_quad(scene, {-40, -40, -1}, {80, 0, 0}, {0, 80, 0}, emitter(Rgb(1)));
            const double angle = degrees * std::numbers::pi / 180;
            const View view = look_at({2 * std::sin(angle), 0, 2 * std::cos(angle)}, {0, 0, 0}, 2, 2, 1e6);
            const double r = std::pow((ior - 1) / (ior + 1), 2), a = std::pow(0.6, 1 / std::cos(angle));
            results.push_back(rendered_result(
                fmt::format("light through half a metre of index {} that halves it about, {} degrees: Beer-Lambert{}",
                            ior, degrees, ior == 1 ? "" : " with all reflections"),
                // 1e-4: paths start some 1e-5 m off each face, so that the way inside is that much too short.
                (1 - r) * (1 - r) * a / (1 - r * r * a * a), 1e-4,
                estimate(scene, Environment(), view, {.samples = 1024}, "background.G", 16, seed)));
        }
    return results;
}

}  // namespace pluvia
