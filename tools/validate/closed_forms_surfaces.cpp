// Surfaces: nothing is lost or made in an even world, and what a plane reflects of it is the integral of its BSDF.
#include "shaders/bsdf.h"
#include "tools/validate/closed_forms.h"
#include "tools/validate/known_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

/// Share of even light that a surface reflects towards wo, by the midpoint rule in the half vector's plane: the grid is
/// even in slopes, atan-warped, so that narrow lobes and the hemisphere's rim are both resolved.
double quadrature_albedo(const PreparedBsdf& bsdf, Vec3 wo, double width) {
    // Directions as half vectors h = (x, y, 1) / sqrt(1 + x^2 + y^2), slopes x = width tan(u): wi = reflect(wo, h).
    constexpr int steps = 800;
    constexpr double pi = std::numbers::pi;
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const double u = ((i + 0.5) / steps - 0.5) * pi, v = ((k + 0.5) / steps - 0.5) * pi;
            const double x = width * std::tan(u), y = width * std::tan(v);
            const double squared = 1 + x * x + y * y;
            const Vec3d h = Vec3d(x, y, 1) / std::sqrt(squared);
            const double cosine = dot(h, Vec3d(wo));
            if (cosine <= 0) continue;
            const Vec3d wi = h * (2 * cosine) - Vec3d(wo);
            if (wi.z <= 0) continue;
            // d(wi) = 4 cosine d(h), d(h) = dx dy / squared^1.5, dx = width / cos^2(u) du.
            const double area =
                4 * cosine * std::pow(squared, -1.5) * width * width / std::pow(std::cos(u) * std::cos(v), 2);
            sum += evaluate(bsdf, Vec3(wi)).f_cos.g * area;
        }
    return sum * pi * pi / (double(steps) * steps);
}

}  // namespace

std::vector<ClosedFormResult> measure_furnaces(uint64_t seed) {
    std::vector<ClosedFormResult> results;
    const Environment world = Environment::uniform(Rgb(1));
    const View view = court_view(24, 12);
    const auto furnace = [&](const std::string& name, const Material& material, double tolerance) {
        results.push_back(
            rendered_result("white furnace, " + name, 1, tolerance,
                            estimate(make_court(material), world, view, {.samples = 64}, "background.G", 16, seed)));
    };
    const double rounding = 1e-5, tables = 1e-3;  // of sums; of the tables of multiple scattering
    const Material diffuse = lambert(Rgb(1));
    furnace("diffuse walls", diffuse, rounding);
    for (const float roughness : {0.2f, 0.5f}) {
        Material metal = diffuse, plastic = diffuse;
        metal.metallic = 1, metal.roughness = roughness;
        plastic.specular = 1, plastic.roughness = roughness;
        furnace(fmt::format("metal of roughness {}", roughness), metal, tables);
        furnace(fmt::format("plastic of roughness {}", roughness), plastic, tables);
    }
    Material pane = diffuse, veil = diffuse;
    pane.transmission = 1, pane.roughness = 0;
    veil.alpha_mode = AlphaMode::blend, veil.alpha = 0.5f;
    furnace("clear panes", pane, rounding);
    furnace("half transparent walls", veil, rounding);

    RenderSettings rainy{.samples = 32};
    rainy.rain.intensities_mm_per_h = {100};
    rainy.rain.min_width_pixels = 0.25;
    results.push_back(
        rendered_result("white furnace, diffuse walls behind rain of 100 mm/h", 1, rounding,
                        estimate(make_court(diffuse), world, court_view(48, 24), rainy, "rainy_100.G", 16, seed)));
    return results;
}

std::vector<ClosedFormResult> measure_albedos(uint64_t seed) {
    std::vector<ClosedFormResult> results;
    const Environment world = Environment::uniform(Rgb(1));
    struct Surface {
        const char* name;
        MetallicRoughness base;
        float coat = 0, coat_roughness = 0;
    };
    for (const Surface& s :
         {Surface{"dielectric coat on black", {.base_color = Rgb(0), .roughness = 0.4f}},
          {"dielectric coat on black, rough", {.base_color = Rgb(0), .roughness = 0.8f}},
          {"dielectric coat on grey", {.base_color = Rgb(0.5f), .roughness = 0.4f}},
          {"metal", {.base_color = Rgb(0.7f), .metallic = 1, .roughness = 0.5f}},
          {"clear coat on grey", {.base_color = Rgb(0.5f), .roughness = 0.6f}, 1, 0.3f},
          {"thin clear coat on metal", {.base_color = Rgb(0.7f), .metallic = 1, .roughness = 0.5f}, 0.5f, 0.4f}}) {
        Material material = lambert(s.base.base_color);
        material.metallic = s.base.metallic, material.roughness = s.base.roughness;
        material.specular = s.base.specular, material.ior = s.base.ior;
        material.clearcoat = s.coat, material.clearcoat_roughness = s.coat_roughness;
        const Bsdf bsdf = s.coat > 0 ? Bsdf(Layered{s.base, {}, s.coat, s.coat_roughness}) : s.base;
        const Scene scene = make_plane(material);
        for (const double degrees : {0.0, 60.0, 80.0}) {
            const double angle = degrees * std::numbers::pi / 180;
            const View view = look_at(Vec3d(std::sin(angle), std::cos(angle), 0) * 3, {0, 0, 0}, 4, 4, 1e7);
            const Vec3 wo(float(std::sin(angle)), 0, float(std::cos(angle)));
            const float roughness = s.coat > 0 ? std::min(s.coat_roughness, s.base.roughness) : s.base.roughness;
            const double expected = quadrature_albedo(prepare(bsdf, wo), wo, std::max(roughness * roughness, 0.3f));
            // 2e-4: the quadrature, whose half steps differ by less, and tables looked up for slightly other
            // directions.
            results.push_back(
                rendered_result(fmt::format("albedo of {}, {} degrees, against quadrature", s.name, degrees), expected,
                                2e-4, estimate(scene, world, view, {.samples = 512}, "background.G", 16, seed)));
        }
    }
    return results;
}

}  // namespace pluvia
