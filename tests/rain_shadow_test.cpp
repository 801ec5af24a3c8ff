// Shelter from rain: the map of what stands above, and what it keeps dry.
#include "renderer/transport/rain_shadow.h"

#include "renderer/transport/dry_parts.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

namespace pluvia {
namespace {

const Environment grey = Environment::uniform(Rgb(1));

/// A roof of 10 x 10 m, 4 m above ground.
Scene roofed_yard(const Material& roof = lambert(Rgb(0.5f))) {
    Scene scene = make_plane(lambert(Rgb(0.5f)));
    add_quad(scene, {-5, 4, 5}, {10, 0, 0}, {0, 0, -10}, roof);
    return scene;
}

/// All of the rain is medium, and the black world shows what light it turns to the camera.
RenderSettings only_medium(int samples) {
    RenderSettings settings;
    settings.samples = samples;
    settings.rain.intensities_mm_per_h = {100};
    settings.rain.min_width_pixels = 100;
    return settings;
}

}  // namespace

TEST_CASE("the rain shadow agrees with exact rays but for a cell beside an edge") {
    const Scene scene = [] {
        Scene s = roofed_yard();
        add_sphere(s, {9, 5, 0}, 3, 48, lambert(Rgb(0.5f)));
        add_box(s, {-15, 0, -9}, {-9, 6, -2}, lambert(Rgb(0.5f)));
        return s;
    }();
    const RayScene rays(scene);
    for (const Vec3d wind : {Vec3d(0, 0, 0), Vec3d(3, 0, -5)}) {
        const RainShadow shadow(scene, rays, wind);
        CHECK(shadow.cell_size() < 0.051f);
        CHECK(double(shadow.fall().x / -shadow.fall().y) == doctest::Approx(wind.x / 5.455).epsilon(1e-3).scale(1e-20));
        Counters counters;
        int sheltered = 0, wrong_beside = 0, wrong_elsewhere = 0, asked = 0;
        for (uint64_t i = 0; i < 20'000; ++i) {
            const Vec3 p(-16 + 30 * uniform(7, i, 0), 0.2f + 9 * uniform(7, i, 1), -10 + 20 * uniform(7, i, 2));
            const auto covered = [&](Vec3 at) { return rays.occluded({at, -shadow.fall()}, {}, counters); };
            const bool exact = covered(p);
            ++asked, sheltered += exact;
            if (std::abs(shadow.exposure(p, counters) - (exact ? 0 : 1)) < 1e-6f) continue;
            bool beside = false;
            for (int k = 0; k < 16; ++k) {
                const float r = k < 8 ? 0.055f : 0.11f, phi = float(k) * pi / 4;
                beside = beside || covered(p + Vec3(r * std::cos(phi), 0, r * std::sin(phi))) != exact;
            }
            ++(beside ? wrong_beside : wrong_elsewhere);
        }
        CAPTURE(asked);
        CAPTURE(sheltered);
        CAPTURE(wrong_beside);
        CHECK(sheltered > asked / 10);
        CHECK(sheltered < asked / 2);
        // Points within rounding of a face: a height that a ray finds from above is known to 1e-6 m.
        CHECK(wrong_elsewhere <= 2);
        CHECK(wrong_beside < asked / 50);
    }
}

TEST_CASE("leaves shelter by their mask and blended surfaces by their share") {
    for (const bool masked : {false, true}) {
        Material leaf = lambert(Rgb(0.5f));
        Scene scene = roofed_yard();
        if (masked) {
            // Three of sixteen texels are opaque, each far wider than a cell.
            Image<Rgba8> image(4, 4, Rgba8{255, 255, 255, 0});
            for (const int i : {1, 6, 11}) image.pixels[size_t(i)].a = 255;
            scene.images.push_back(image);
            scene.textures.push_back({.image = 0, .nearest = true});
            leaf.base_color_texture = 0, leaf.alpha_mode = AlphaMode::mask;
        } else {
            leaf.alpha_mode = AlphaMode::blend, leaf.alpha = 3.0f / 16;
        }
        scene.materials[size_t(scene.meshes[1].material)] = leaf;
        const RayScene rays(scene);
        const RainShadow shadow(scene, rays, {});
        Counters counters;
        RunningMean open;
        for (uint64_t i = 0; i < 40'000; ++i)
            open.add(shadow.exposure({-4.8f + 9.6f * uniform(8, i, 0), 1, -4.8f + 9.6f * uniform(8, i, 1)}, counters));
        CAPTURE(masked);
        CAPTURE(open.mean());
        // The inner 9.6 of 10 m hold a little more or less of a texel than a sixteenth.
        CHECK(open.mean() == doctest::Approx(13.0 / 16).scale(0).epsilon(0.02));
    }
}

TEST_CASE("dry parts of a ray are those below the roof, from wherever it starts") {
    const Scene scene = roofed_yard();
    const RayScene rays(scene);
    const RainShadow shadow(scene, rays, {});
    Counters counters;
    DryParts parts(shadow, {{-20, 2, 0.1f}, {1, 0, 0}});
    CHECK(parts.up_to(10, counters).empty());
    const auto before = parts.up_to(18, counters);
    REQUIRE(before.size() == 1);
    CHECK(before[0].begin == doctest::Approx(15).scale(0).epsilon(0.02));
    const auto all = parts.up_to(1e9f, counters);
    REQUIRE(all.size() == 1);
    CHECK(all[0].end == doctest::Approx(25).scale(0).epsilon(0.03));
    CHECK(counters[Feature::rain_shadow] > 0);
    DryParts above(shadow, {{-20, 5, 0.1f}, {1, 0, 0}});
    CHECK(above.up_to(1e9f, counters).empty());
    // Rays that end at the ground: those beside them go on where they end.
    DryParts open_ground(shadow, {{0, 1, -20}, normalize(Vec3(0, -0.05f, -1)), 20});
    CHECK(open_ground.up_to(25, counters).empty());
    DryParts roofed_ground(shadow, {{0, 1, 20}, normalize(Vec3(0, -0.05f, -1)), 20});
    const auto to_ground = roofed_ground.up_to(24, counters);
    REQUIRE(to_ground.size() == 1);
    CHECK(to_ground[0].begin == doctest::Approx(15).scale(0).epsilon(0.02));
    CHECK(to_ground[0].end > 24);
    CHECK(roofed_ground.serves(24));
    CHECK(!roofed_ground.serves(40));
}

TEST_CASE("where a roof shelters the whole view there is neither a streak nor fine rain") {
    Scene scene = make_plane(lambert(Rgb(0.5f)));
    add_quad(scene, {-50, 30, 50}, {100, 0, 0}, {0, 0, -100}, lambert(Rgb(0.5f)));
    add_quad(scene, {-50, 0, -40}, {100, 0, 0}, {0, 30, 0}, lambert(Rgb(0.5f)));
    View view = look_at({0, 2, 40}, {0, 6, -40}, 64, 32, 60);
    for (const double width : {0.25, 100.0}) {
        RenderSettings settings = only_medium(4);
        settings.rain.min_width_pixels = width;
        const Picture p = render_picture(scene, grey, view, settings);
        CHECK(p.mean("rain_100.A") == 0);
        CHECK(p.mean("inscatter_100.G") == 0);
        for (const float t : p.plane("transmittance_100.G")) CHECK(t == 1);
        CHECK(p.report.counters[Feature::medium_path] == 0);
    }
}

TEST_CASE("a roof takes from a ray the rain of its own length and leaves open ways alone") {
    // Looking at a far wall, to the left below a roof of 40 m, to the right in the open.
    Scene open = make_plane(lambert(Rgb(0.5f)));
    add_quad(open, {-50, 0, -45}, {100, 0, 0}, {0, 30, 0}, emitter(Rgb(1)));
    Scene roofed = open;
    add_quad(roofed, {-50, 20, 20}, {48, 0, 0}, {0, 0, -40}, lambert(Rgb(0.5f)));
    const View view = look_at({0, 8, 45}, {0, 8, -45}, 64, 32, 60);
    const RenderSettings settings = only_medium(4);
    const Picture a = render_picture(open, grey, view, settings), b = render_picture(roofed, grey, view, settings);
    // Pixel 8 of row 16 looks 21 degrees to the left, below the roof where it is more than 2 m off the axis.
    const size_t left = 16 * 64 + 8, right = 16 * 64 + 56;
    const double tan_left = (32 - 8.5) / 60, way = std::sqrt(1 + tan_left * tan_left);
    const double from = std::max(25.0, 2 / tan_left), to = std::min(65.0, 50 / tan_left);
    const double extinction = -std::log(double(a.plane("transmittance_100.G")[right])) / (90 * way);
    const double saved = std::log(double(b.plane("transmittance_100.G")[left] / a.plane("transmittance_100.G")[left]));
    CAPTURE(extinction);
    CAPTURE(saved);
    CHECK(saved == doctest::Approx(extinction * (to - from) * way).scale(0).epsilon(0.04));  // steps of 3 % of the way
    CHECK(b.plane("transmittance_100.G")[right] == a.plane("transmittance_100.G")[right]);
    CHECK(b.plane("background.G")[right] > 0);
}

TEST_CASE("partly sheltered rain is invisible in a uniform world") {
    // A roof that shines as the world does, and ground as white as it.
    Scene scene = make_plane(lambert(Rgb(1)));
    Material shining = emitter(Rgb(1));
    shining.double_sided = true;
    add_quad(scene, {-30, 6, -5}, {60, 0, 0}, {0, 0, -25}, shining);
    const View view = look_at({0, 2, 0}, {0, 2.5, -10}, 32, 16, 30);
    RenderSettings settings = only_medium(64);
    const Estimate e = estimate(scene, grey, view, settings, "rainy_100.G", 16);
    CAPTURE(e.mean);
    CAPTURE(e.standard_error);
    CHECK(std::abs(e.mean - 1) < 5 * e.standard_error + 1e-4);
    CHECK(e.standard_error < 2e-3);
    const Picture p = render_picture(scene, grey, view, settings);
    CHECK(p.mean("inscatter_100.G") > 0);
    CHECK(p.report.counters[Feature::rain_shadow] > 0);
}

}  // namespace pluvia
