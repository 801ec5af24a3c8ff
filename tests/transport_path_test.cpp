// Paths against closed forms: each light over a Lambert plane, in its own unit.
#include "renderer/core/transform.h"
#include "shaders/bsdf.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <numbers>

namespace pluvia {
namespace {

constexpr double albedo = 0.5;
constexpr double tiny_pixel = 1e7;  // focal length in pixels: the picture is one point of the ground

/// A large plane through the origin, seen at the origin by a slanting ray below all lights.
Scene plane_scene() {
    Scene scene;
    add_quad(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, lambert(Rgb(albedo)));
    return scene;
}
const View point_view = look_at({4, 1.5, 3}, {0, 0, 0}, 4, 4, tiny_pixel);

}  // namespace

TEST_CASE("a spot light does not shine outside its outer cone") {
    Scene scene = plane_scene();
    PunctualLight spot{.name = "spot", .kind = PunctualLight::Kind::spot, .intensity = Rgb(100), .position = {0, 2, 0}};
    spot.inner_cone_angle = 0.3f, spot.outer_cone_angle = 0.5f;
    spot.direction = {float(std::sin(0.6)), -float(std::cos(0.6)), 0};
    scene.lights = {spot};
    CHECK(render_picture(scene, Environment(), point_view, {.samples = 4}).mean("background.G") == 0);
}

TEST_CASE("sixty small lamps give the sum of what each of them gives") {
    Scene scene = plane_scene();
    double expected = 0;
    for (int i = 0; i < 60; ++i) {
        const Vec3 at(-15 + float(i % 10) * 3, 2 + float(i % 3), -9 + float(i / 10) * 3);
        add_sphere(scene, at, 0.05f, 16, emitter(Rgb(300)));
        // Far against its size a polyhedron shines like its mean silhouette, a quarter of its surface (Cauchy).
        const Mesh& mesh = scene.meshes.back();
        double area = 0;
        for (const auto& t : mesh.triangles)
            area += 0.5 * length(cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                       mesh.positions[t[2]] - mesh.positions[t[0]]));
        const double d2 = dot(at, at);
        expected += albedo / std::numbers::pi * 300 * (area / 4) * (at.y / std::sqrt(d2)) / d2;
    }
    RenderSettings settings;
    settings.samples = 1024;
    const Estimate e = estimate(scene, Environment(), point_view, settings, "background.G", 16);
    // 0.3 %: the silhouette of a 16-gon sphere varies that much about its mean with direction; 60 lamps average it.
    CHECK(std::abs(e.mean - expected) < 5 * e.standard_error + 3e-3 * expected);
}

TEST_CASE("bounces cut a path after that many scattering events") {
    const Scene scene = make_court(lambert(Rgb(1)));
    const Environment world = Environment::uniform(Rgb(1));
    const View view = look_at({0, 1, 0}, {0, 0, -3}, 8, 8, 8);
    RenderSettings settings;
    settings.samples = 64;
    double last = -1;
    for (const int bounces : {0, 1, 2, 8}) {
        settings.path.max_bounces = bounces;
        const double mean = render_picture(scene, world, view, settings).mean("background.G");
        CAPTURE(bounces);
        CHECK(mean > last);
        CHECK(mean < 1);
        last = mean;
    }
    // Without any bounce only light itself is seen.
    settings.path.max_bounces = 0;
    const View at_wall = look_at({0, 1, 0}, {0, 0.5, -8}, 2, 2, 100);
    CHECK(render_picture(scene, world, at_wall, settings).mean("background.G") == 0);
}

TEST_CASE("in a closed room whose walls glow each bounce adds its term of the geometric series") {
    Scene scene;
    Material wall = lambert(Rgb(0.8f));
    wall.emission = Rgb(1), wall.double_sided = true;
    add_box(scene, {-1, -1, -1}, {1, 1, 1}, wall);
    const View view = look_at({0.3, -0.2, 0.1}, {1, 0.4, -0.6}, 8, 8, 8);
    RenderSettings settings;
    settings.samples = 256;
    for (const int bounces : {0, 1, 2, 3, 1000}) {
        settings.path.max_bounces = bounces;
        const double expected = (1 - std::pow(0.8, bounces + 1)) / (1 - 0.8);
        const Estimate e = estimate(scene, Environment(), view, settings, "background.G", 16);
        CAPTURE(bounces);
        CAPTURE(e.mean);
        CAPTURE(e.standard_error);
        CHECK(std::abs(e.mean - expected) < 5 * e.standard_error + 2e-5 * expected);  // 2e-5: single precision
        CHECK(e.standard_error < 2e-3 * expected);
    }
}

// Small lamps are found by light samples, large ones by the surface's own, and both together must give the integral.
TEST_CASE("a lamp of any size has the radiance of the integral over its surface in a floor of any gloss") {
    const View view = look_at({-1.5, 1.2, 0}, {0, 0, 0}, 4, 4, tiny_pixel);
    const ShadingBasis basis(Vec3(0, 1, 0));
    for (const float roughness : {0.15f, 0.3f, 0.7f}) {
        for (const float half_width : {0.05f, 0.4f, 3.0f}) {
            Scene scene;
            const MetallicRoughness metal{
                .base_color = Rgb(0.9f), .metallic = 1, .roughness = roughness, .specular = 0};
            Material floor = lambert(metal.base_color);
            floor.metallic = metal.metallic, floor.roughness = metal.roughness;
            add_quad(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, floor);
            const Vec3 centre(1.3f, 1.1f, 0), normal = -normalize(Vec3(1, 1, 0));
            const Vec3 half_u(0, 0, half_width),
                half_v = cross(normal, half_u / half_width) * std::min(half_width, 0.9f);
            add_quad(scene, centre - half_u - half_v, half_u * 2, half_v * 2, emitter(Rgb(5)));

            const PreparedBsdf bsdf = prepare(Bsdf(metal), basis.to_local(Vec3(view.back)));
            const int steps = 700;  // midpoints: within 1e-4 of the integral for the narrowest lobe
            double expected = 0;
            for (int i = 0; i < steps; ++i)
                for (int j = 0; j < steps; ++j) {
                    const Vec3 p = centre + half_u * (2 * (float(i) + 0.5f) / steps - 1) +
                                   half_v * (2 * (float(j) + 0.5f) / steps - 1);
                    const float distance_squared = length_squared(p);
                    const Vec3 wi = p / std::sqrt(distance_squared);
                    expected +=
                        evaluate(bsdf, basis.to_local(wi)).f_cos.g * std::abs(dot(wi, normal)) / distance_squared;
                }
            expected *= 5 * 4 * double(length(half_u)) * double(length(half_v)) / (double(steps) * steps);

            RenderSettings settings;
            settings.samples = 512;
            settings.path.max_bounces = 1;
            const Estimate e = estimate(scene, Environment(), view, settings, "background.G", 16);
            CAPTURE(roughness);
            CAPTURE(half_width);
            CAPTURE(e.mean);
            CAPTURE(e.standard_error);
            CAPTURE(expected);
            // 1e-3: the quadrature, and tables of the metal that are looked up for slightly different directions.
            CHECK(std::abs(e.mean - expected) < 5 * e.standard_error + 1e-3 * expected);
            CHECK(e.standard_error < 3e-3 * expected);
        }
    }
}

TEST_CASE("only the front of a lamp shines unless it is double-sided, also where its node is mirrored") {
    const View from_below = look_at({0.3, 0.4, 0.2}, {0.1, 2, 0.1}, 2, 2, 100);
    for (const bool faces_down : {true, false})
        for (const bool double_sided : {true, false})
            for (const bool mirrored : {true, false}) {
                Scene scene = plane_scene();
                Material material = emitter(Rgb(7));
                material.double_sided = double_sided;
                const Vec3 x(2, 0, 0), z(0, 0, 2);
                const int lamp = add_quad(scene, {-1, 2, -1}, faces_down ? x : z, faces_down ? z : x, material);
                if (mirrored) scene.instances[lamp].scene_from_object = scale({-1, 1, 1});
                const bool shines = faces_down || double_sided;
                CAPTURE(faces_down);
                CAPTURE(double_sided);
                CAPTURE(mirrored);
                CHECK(render_picture(scene, Environment(), from_below, {.samples = 4}).mean("background.G") ==
                      (shines ? 7.0 : 0.0));
                const double floor =
                    render_picture(scene, Environment(), point_view, {.samples = 256}).mean("background.G");
                // The square of the test above; 2 % is far above the noise and far below a lost strategy.
                if (shines)
                    CHECK(std::abs(floor - 0.5 * 7 * 0.2394) < 0.02 * 0.5 * 7 * 0.2394);
                else
                    CHECK(floor == 0);
            }
}

}  // namespace pluvia
