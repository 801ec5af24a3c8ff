// Only what a scene requires is modelled: the counter of every other feature stays at zero.
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

namespace pluvia {
namespace {

Counters count(const Scene& scene, const Environment& environment, const RenderSettings& settings,
               View view = court_view(32, 16)) {
    return render_picture(scene, environment, view, settings).report.counters;
}

Scene plain() {
    return make_court(lambert(Rgb(0.5f)));
}

int add_texture(Scene& scene, Rgba8 texel) {
    scene.images.push_back(Image<Rgba8>(2, 2, texel));
    scene.textures.push_back({.image = int(scene.images.size()) - 1});
    return int(scene.textures.size()) - 1;
}

}  // namespace

TEST_CASE("a plain scene calls no feature that it lacks") {
    const Counters c = count(plain(), Environment::uniform(Rgb(1)), {.samples = 2});
    for (const Feature feature : {Feature::texture,
                                  Feature::normal_map,
                                  Feature::vertex_color,
                                  Feature::alpha,
                                  Feature::emissive_surface,
                                  Feature::pane,
                                  Feature::frosted_pane,
                                  Feature::glass,
                                  Feature::volume,
                                  Feature::clearcoat,
                                  Feature::sheen,
                                  Feature::anisotropy,
                                  Feature::unlit,
                                  Feature::local_light,
                                  Feature::lens,
                                  Feature::streak_test,
                                  Feature::streak_hit,
                                  Feature::streak_path,
                                  Feature::paper_streak,
                                  Feature::medium_point,
                                  Feature::medium_path,
                                  Feature::medium_lamp,
                                  Feature::label,
                                  Feature::matte}) {
        CAPTURE(feature_names[size_t(feature)]);
        CHECK(c[feature] == 0);
    }
    CHECK(c[Feature::camera_path] == 32 * 16 * 2);
    CHECK(c[Feature::environment] > 0);
    CHECK(c[Feature::distant_light] > 0);
    CHECK(c.invalid_samples == 0);
}

TEST_CASE("without an environment nothing asks for one") {
    Scene scene = plain();
    scene.lights.push_back({.name = "lamp", .intensity = Rgb(10), .position = {0, 3, 0}});
    const Counters c = count(scene, Environment(), {.samples = 2});
    CHECK(c[Feature::environment] == 0);
    CHECK(c[Feature::distant_light] == 0);
    CHECK(c[Feature::local_light] > 0);
}

TEST_CASE("each feature is called once a scene has it") {
    const Environment world = Environment::uniform(Rgb(1));
    const auto check = [&](Feature feature, auto change) {
        Scene scene = plain();
        change(scene);
        CAPTURE(feature_names[size_t(feature)]);
        CHECK(count(scene, world, {.samples = 2})[feature] > 0);
    };
    check(Feature::texture, [](Scene& s) {
        const int t = add_texture(s, {200, 100, 50, 255});
        for (Material& m : s.materials) m.base_color_texture = t;
    });
    check(Feature::normal_map, [](Scene& s) {
        const int t = add_texture(s, {128, 128, 255, 255});
        for (Material& m : s.materials) m.normal_texture = t;
    });
    check(Feature::vertex_color, [](Scene& s) {
        for (Mesh& m : s.meshes) m.colors.assign(m.positions.size(), Rgb(0.5f));
    });
    check(Feature::alpha, [](Scene& s) {
        for (Material& m : s.materials) m.alpha_mode = AlphaMode::blend, m.alpha = 0.5f;
    });
    check(Feature::emissive_surface, [](Scene& s) { s.materials[0].emission = Rgb(1); });
    check(Feature::local_light, [](Scene& s) { s.materials[0].emission = Rgb(1); });
    check(Feature::pane, [](Scene& s) {
        for (Material& m : s.materials) m.transmission = 1, m.metallic = m.roughness = 0;
    });
    check(Feature::frosted_pane, [](Scene& s) {
        for (Material& m : s.materials) m.transmission = 1, m.metallic = 0, m.roughness = 0.5f;
    });
    for (const Feature feature : {Feature::glass, Feature::volume})
        check(feature, [](Scene& s) {
            for (Material& m : s.materials) m.transmission = m.thickness = 1, m.metallic = 0;
        });
    check(Feature::clearcoat, [](Scene& s) { s.materials[0].clearcoat = 1; });
    check(Feature::sheen, [](Scene& s) { s.materials[0].sheen_color = Rgb(1); });
    check(Feature::anisotropy, [](Scene& s) {
        for (Material& m : s.materials) m.anisotropy = 0.5f;
        for (Mesh& m : s.meshes) m.uvs.assign({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), m.uvs.resize(m.positions.size());
    });
    check(Feature::unlit, [](Scene& s) { s.materials[0].unlit = true; });
    View view = court_view(32, 16);
    view.lens_radius = 0.01;
    CHECK(count(plain(), world, {.samples = 2}, view)[Feature::lens] > 0);
    RenderSettings rain;
    rain.samples = 2;
    rain.rain.intensities_mm_per_h = {100};
    rain.rain.min_width_pixels = 0.25;
    const Counters wet = count(plain(), world, rain);
    CHECK(wet[Feature::streak_test] > 0);
    CHECK(wet[Feature::streak_hit] > 0);
    CHECK(wet[Feature::streak_path] > 0);
    CHECK(wet[Feature::medium_point] > 0);
    CHECK(wet[Feature::medium_path] > 0);
    CHECK(wet[Feature::medium_lamp] == 0);
    Scene lit = plain();
    lit.lights.push_back({.name = "lamp", .intensity = Rgb(10), .position = {0, 3, 0}});
    CHECK(count(lit, world, rain)[Feature::medium_lamp] > 0);
    CHECK(wet[Feature::paper_streak] == 0);
    rain.streaks.composition = Composition::paper;
    const Counters paper = count(plain(), world, rain);
    CHECK(paper[Feature::paper_streak] > 0);
    CHECK(paper[Feature::medium_point] == 0);
}

}  // namespace pluvia
