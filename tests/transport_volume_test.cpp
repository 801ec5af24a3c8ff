// Light through bodies of glass and thin sheets, as paths carry it.
#include "shaders/bsdf.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

namespace pluvia {
namespace {

constexpr double tiny_pixel = 1e7;  // focal length in pixels: the picture is one direction
const Environment white = Environment::uniform(Rgb(1));

Material glass(float roughness = 0, float ior = 1.5f) {
    Material m;
    m.metallic = 0, m.roughness = roughness, m.ior = ior;
    m.transmission = 1, m.thickness = 1;
    return m;
}

void check_radiance(const Scene& scene, const Environment& environment, const View& view, double expected) {
    RenderSettings settings;
    settings.samples = 1024;
    const Estimate e = estimate(scene, environment, view, settings, "background.G", 16);
    CAPTURE(e.mean);
    CAPTURE(e.standard_error);
    CAPTURE(expected);
    CHECK(std::abs(e.mean - expected) < 5 * e.standard_error + 1e-5 * expected);  // rounding
    CHECK(e.standard_error < 5e-3 * expected);  // else the test could not see an error
}

}  // namespace

TEST_CASE("in a uniform world clear bodies are invisible, in each other and around others") {
    const auto scenes = [] {
        std::vector<Scene> list(5);
        add_sphere(list[0], {0, 0, 0}, 1, 32, glass());
        add_sphere(list[1], {0, 0, 0}, 1, 32, glass(0.5f));
        add_sphere(list[2], {0, 0, 0}, 1, 32, glass());
        add_sphere(list[2], {0, 0, 0}, 0.6f, 32, glass(0, 1.33f));
        add_box(list[3], {-1, -1, -1}, {1, 1, 1}, glass());
        add_box(list[3], {-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}, lambert(Rgb(1)));
        Material frosted = glass(0.4f);
        frosted.thickness = 0;
        add_box(list[4], {-1, -1, -1}, {1, 1, 1}, frosted);
        return list;
    }();
    for (size_t i = 0; i < scenes.size(); ++i) {
        CAPTURE(i);
        RenderSettings settings;
        settings.samples = 64;
        const Estimate e =
            estimate(scenes[i], white, look_at({1, 1.5, 3}, {0, 0, 0}, 24, 16, 40), settings, "background.G", 16);
        CAPTURE(e.mean);
        CAPTURE(e.standard_error);
        CHECK(std::abs(e.mean - 1) < 5 * e.standard_error + 1e-3);  // the tables of rough surfaces
        CHECK(e.standard_error < 5e-3);
    }
}

TEST_CASE("a slab that absorbs is as bright as all its reflections between two faces add up to") {
    Material green = glass();
    green.attenuation_color = Rgb(0.3f, 0.6f, 0.9f), green.attenuation_distance = 0.5f;
    Scene scene;
    add_box(scene, {-9, -9, -1}, {9, 9, 0}, green);
    // Along the normal, one metre: R + (1-R)^2 a (1 + R a) / (1 - R^2 a^2), what comes back and what passes.
    const double r = 0.04, a = 0.6 * 0.6;
    const double expected = r + (1 - r) * (1 - r) * (a + r * a * a) / (1 - r * r * a * a);
    check_radiance(scene, white, look_at({0, 0, 5}, {0, 0, 0}, 4, 4, tiny_pixel), expected);
    // Seen from inside: one way out through half of it, and mirrored.
    const double h = std::sqrt(a), inside = (1 - r) * h * (1 + r * a) / (1 - r * r * a * a);
    check_radiance(scene, white, look_at({0, 0, -0.5}, {0, 0, 0}, 4, 4, tiny_pixel), inside);
}

TEST_CASE("a lamp inside of glass shows its radiance divided by the square of the index") {
    Scene scene;
    add_box(scene, {-9, -9, -1}, {9, 9, 0}, glass());
    add_quad(scene, {-5, -5, -0.5f}, {10, 0, 0}, {0, 10, 0}, emitter(Rgb(9)));
    check_radiance(scene, Environment(), look_at({0, 0, 5}, {0, 0, 0}, 4, 4, tiny_pixel), 0.96 * 9 / 2.25);
}

TEST_CASE("glass absorbs light on its way to what lies inside") {
    Material body = glass(0, 1);  // bends nothing, so that light samples see through its face only by paths
    body.attenuation_color = Rgb(0.5f), body.attenuation_distance = 1;
    Scene scene;
    add_box(scene, {-50, -50, -1}, {50, 50, 0}, body);
    add_quad(scene, {-40, -40, -0.75f}, {80, 0, 0}, {0, 80, 0}, lambert(Rgb(0.8f)));
    scene.lights.push_back({.name = "lamp", .intensity = Rgb(10), .position = {0, 0, -0.5}});
    // The lamp is in the body, 0.25 m above the plate, which is seen from 0.75 m below the face.
    const double expected = 0.8 / 3.14159265 * 10 / (0.25 * 0.25) * std::pow(0.5, 0.25) * std::pow(0.5, 0.75);
    RenderSettings settings;
    settings.samples = 64;
    settings.path.max_bounces = 2;  // face, plate; more would add what the plate sends to itself, which is nothing
    const Estimate e =
        estimate(scene, Environment(), look_at({0, 0, 5}, {0, 0, 0}, 4, 4, tiny_pixel), settings, "background.G", 4);
    CAPTURE(e.mean);
    CHECK(e.mean == doctest::Approx(expected).epsilon(1e-4).scale(0));
}

TEST_CASE("a lamp behind a frosted sheet lights it by the sheet's own scattering") {
    Material frosted = glass(0.5f);
    frosted.thickness = 0;
    Scene scene;
    add_quad(scene, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, frosted);
    scene.lights.push_back({.name = "lamp", .intensity = Rgb(10), .position = {0.5, 0, -2}});
    const Vec3 wi = normalize(Vec3(0.5f, 0, -2));
    const double f_cos = evaluate(Bsdf(FrostedPane{.roughness = 0.5f}), {0, 0, 1}, wi).f_cos.g;
    RenderSettings settings;
    settings.samples = 16;
    const Estimate e =
        estimate(scene, Environment(), look_at({0, 0, 5}, {0, 0, 0}, 4, 4, tiny_pixel), settings, "background.G", 4);
    CHECK(e.mean == doctest::Approx(f_cos * 10 / 4.25).epsilon(1e-4).scale(0));
    CHECK(e.mean > 0.1);
}

TEST_CASE("an unlit surface shows its colour at the luminance that stands for white, whatever lights it") {
    Material sign = lambert(Rgb(0.5f, 0.25f, 1));
    sign.unlit = true;
    Scene scene;
    add_quad(scene, {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, sign);
    scene.unlit_luminance = 300;
    for (const Environment& environment : {Environment(), white}) {
        const Picture picture =
            render_picture(scene, environment, look_at({0, 0, 5}, {0, 0, 0}, 4, 4, 40), {.samples = 4});
        CHECK(picture.mean("background.R") == doctest::Approx(150));
        CHECK(picture.mean("background.G") == doctest::Approx(75));
    }
}

}  // namespace pluvia
