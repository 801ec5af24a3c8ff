// Each kind of light over a Lambert plane, in its own unit.
#include "tools/validate/closed_forms.h"
#include "tools/validate/known_scenes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace pluvia {
namespace {

constexpr double albedo = 0.5;
constexpr double rounding = 2e-5;  // of positions and directions in single precision

/// One point of the ground, seen by a slanting ray below all lights.
const View& point_view() {
    static const View view = look_at({4, 1.5, 3}, {0, 0, 0}, 4, 4, 1e7);
    return view;
}

ClosedFormResult ground(const std::string& quantity, double expected, const Scene& scene,
                        const Environment& environment, int samples, uint64_t seed, double tolerance = rounding) {
    return rendered_result(quantity, expected, tolerance,
                           estimate(scene, environment, point_view(), {.samples = samples}, "background.G", 16, seed));
}

Scene ground_scene() {
    return make_plane(lambert(Rgb(float(albedo))));
}

/// Irradiance at the origin of a plane that faces n from a polygon of radiance 1 that lies above it wholly.
/// Source: Lambert 1760, Photometria; Arvo 1995.
double polygon_irradiance(std::span<const Vec3d> corners, Vec3d n) {
    double sum = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = normalize(corners[i]), b = normalize(corners[(i + 1) % corners.size()]);
        sum += std::acos(dot(a, b)) * dot(normalize(cross(a, b)), n);
    }
    return std::abs(sum) / 2;
}

/// A ball of few facets, those at its rim seen at an angle of 0.01 rad: they bring 0.35 % of its light.
ClosedFormResult edge_on_facets(uint64_t seed) {
    constexpr int segments = 64;
    constexpr double height = 2, pi_d = std::numbers::pi;
    Scene scene = ground_scene();
    add_sphere(scene, {0, float(height), 0}, 1, segments, emitter(Rgb(10)));
    // Its outline is the ring of corners that is seen farthest from the axis.
    std::vector<Vec3d> outline;
    double widest = 0;
    for (int ring = 0; ring <= segments / 2; ++ring) {
        const double polar = 2 * pi_d * ring / segments, x = std::sin(polar), y = height + std::cos(polar);
        if (x / y <= widest) continue;
        widest = x / y;
        outline.clear();
        for (int k = 0; k < segments; ++k)
            outline.push_back({x * std::cos(2 * pi_d * k / segments), y, x * std::sin(2 * pi_d * k / segments)});
    }
    return ground("ball of 64 x 32 facets, 2 m above: Lambert's formula of its outline",
                  albedo / pi_d * 10 * polygon_irradiance(outline, {0, 1, 0}), scene, Environment(), 1024, seed);
}

}  // namespace

std::vector<ClosedFormResult> measure_punctual_lights(uint64_t seed) {
    std::vector<ClosedFormResult> results;
    Scene scene = ground_scene();
    scene.lights = {{.name = "lamp", .kind = PunctualLight::Kind::point, .intensity = Rgb(80), .position = {0, 2, 0}}};
    results.push_back(ground("point light of 80 cd, 2 m above: albedo I / (pi h^2)", albedo / std::numbers::pi * 80 / 4,
                             scene, Environment(), 4, seed));
    scene.lights[0].position = {3, 2, 1};
    results.push_back(ground("the same to the side: albedo I cos / (pi d^2)",
                             albedo / std::numbers::pi * 80 * (2 / std::sqrt(14.0)) / 14, scene, Environment(), 4,
                             seed));

    PunctualLight spot{.name = "spot", .kind = PunctualLight::Kind::spot, .intensity = Rgb(100), .position = {0, 2, 0}};
    spot.inner_cone_angle = 0.3f, spot.outer_cone_angle = 0.5f;
    for (const double angle : {0.0, 0.2, 0.4, 0.45}) {  // between axis and the point that is seen
        spot.direction = {float(std::sin(angle)), -float(std::cos(angle)), 0};
        scene.lights = {spot};
        // KHR_lights_punctual: the square of a linear ramp of the cosine.
        const double ramp = (std::cos(angle) - std::cos(0.5)) / (std::cos(0.3) - std::cos(0.5));
        const double share = std::pow(std::clamp(ramp, 0.0, 1.0), 2);
        // The ramp magnifies the rounding of a cosine by 1 / 0.08, and so does its square twice.
        results.push_back(ground(fmt::format("spot light of 100 cd, 2 m above, {} rad off its axis", angle),
                                 share * albedo / std::numbers::pi * 100 / 4, scene, Environment(), 4, seed, 1e-4));
    }

    PunctualLight sun{.name = "sun", .kind = PunctualLight::Kind::directional, .intensity = Rgb(1000)};
    sun.direction = {float(std::sin(std::numbers::pi / 3)), -0.5f, 0};
    scene.lights = {sun};
    results.push_back(ground("directional light of 1000 lx, 60 degrees from the normal: albedo E cos / pi",
                             albedo * 500 / std::numbers::pi, scene, Environment(), 4, seed));
    return results;
}

std::vector<ClosedFormResult> measure_area_lights(uint64_t seed) {
    std::vector<ClosedFormResult> results;
    for (const double height : {3.0, 8.0}) {
        Scene scene = ground_scene();
        const int segments = 256;
        add_sphere(scene, {0, float(height), 0}, 1, segments, emitter(Rgb(10)));
        // E = pi L (r / d)^2. Seen from below, the polyhedron's outline is a polygon of so many corners, whose area is
        // a little less than the circle's.
        const double outline = std::sin(2 * std::numbers::pi / segments) * segments / (2 * std::numbers::pi);
        results.push_back(ground(
            fmt::format("sphere light of radius 1 m and 10 cd/m2, centre {} m above: albedo L (r / d)^2", height),
            albedo * 10 / (height * height) * outline, scene, Environment(), 1024, seed));
    }
    results.push_back(edge_on_facets(seed));
    struct Rectangle {
        const char* name;
        Vec3 corner, u, v;
    };
    for (const Rectangle& r : {Rectangle{"2 m x 2 m, 2 m above", {-1, 2, -1}, {2, 0, 0}, {0, 0, 2}},
                               {"1 m x 3 m, tilted, to the side", {1, 1, -1}, {0.6f, 0.8f, 0}, {0, 0, 3}}}) {
        Scene scene = ground_scene();
        Material lamp = emitter(Rgb(7));
        lamp.double_sided = true;
        add_quad(scene, r.corner, r.u, r.v, lamp);
        const std::array corners = {Vec3d(r.corner), Vec3d(r.corner + r.u), Vec3d(r.corner + r.u + r.v),
                                    Vec3d(r.corner + r.v)};
        results.push_back(ground(fmt::format("rectangle light of 7 cd/m2, {}: Lambert's formula", r.name),
                                 albedo / std::numbers::pi * 7 * polygon_irradiance(corners, {0, 1, 0}), scene,
                                 Environment(), 1024, seed));
    }
    return results;
}

std::vector<ClosedFormResult> measure_environments(uint64_t seed) {
    std::vector<ClosedFormResult> results;
    results.push_back(ground("even environment of 3 cd/m2: albedo L", albedo * 3, ground_scene(),
                             Environment::uniform(Rgb(3)), 64, seed));

    Image<Rgb> picture(64, 32, Rgb(0));
    picture.at(20, 6) = Rgb(5000);
    const Environment texel(picture);
    // Illuminance by the midpoint rule, much finer than a texel: between texels the picture is interpolated.
    constexpr int rows = 1000, columns = 2000;
    double lux = 0;
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < columns; ++k) {
            const double elevation = (i + 0.5) / rows * std::numbers::pi / 2;
            const Vec3d d = direction_from_azimuth((k + 0.5) / columns * 2 * std::numbers::pi, elevation);
            lux += texel.radiance(Vec3(d)).g * std::sin(elevation) * std::cos(elevation);
        }
    lux *= (std::numbers::pi / 2 / rows) * (2 * std::numbers::pi / columns);
    results.push_back(ground("environment with one bright texel, against quadrature", albedo * lux / std::numbers::pi,
                             ground_scene(), texel, 1024, seed, 1e-4));

    Disc sun;
    sun.direction = normalize(Vec3(1, 1, 0)), sun.angular_radius = 0.1f, sun.strips = {Rgb(400)};
    // E = pi L sin^2(radius) cos(angle to the normal), as for a sphere.
    results.push_back(ground("sun disc of 0.1 rad and 400 cd/m2 at 45 degrees: albedo L sin^2 cos",
                             albedo * 400 * std::pow(std::sin(0.1), 2) * std::sqrt(0.5), ground_scene(),
                             Environment(Image<Rgb>(4, 2, Rgb(0)), {sun}), 256, seed));
    return results;
}

}  // namespace pluvia
