// Wet ground: light stays in balance, water lies where rain falls, and what is dry costs nothing.
#include "renderer/transport/wet_ground.h"

#include "renderer/core/sampling.h"
#include "renderer/rain/drop_size.h"
#include "renderer/scene/gltf.h"
#include "shaders/puddles.h"
#include "shaders/water_film.h"
#include "tests/bsdf_checks.h"
#include "tests/temporary_folder.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

namespace pluvia {
namespace {

const Environment white = Environment::uniform(Rgb(1));

std::vector<Bsdf> dry_surfaces(Rgb color) {
    return {MetallicRoughness{.base_color = color, .specular = 0},
            MetallicRoughness{.base_color = color, .roughness = 0.9f},
            MetallicRoughness{.base_color = color, .roughness = 0.2f},
            MetallicRoughness{.base_color = color, .metallic = 1, .roughness = 0.4f},
            MetallicRoughness{.base_color = color, .metallic = 0.5f, .roughness = 0.6f},
            Layered{.base = {.base_color = color, .roughness = 0.8f}, .sheen = {}, .coat = 1},
            Layered{.base = {.base_color = color, .roughness = 0.8f}, .sheen = {Rgb(0.8f), 0.5f}}};
}
const WaterCover covers[] = {{0.4f, 0, 0.5f}, {1, 0, 0}, {1, 0, -1}, {1, 0.5f, 0}, {1, 1, 0}};

RenderSettings wet(float wetness, float puddles, double ripples, int samples = 4) {
    RenderSettings settings;
    settings.samples = samples;
    settings.wet = {wetness, puddles, ripples};
    return settings;
}

}  // namespace

TEST_CASE("a matt surface is as dark below a film as the closed form says") {
    // Reflected near the normal besides the film's own 2 %: Lekner and Dorf's sum with p = 0.4746.
    const std::pair<float, double> known[] = {{0.1f, 0.054}, {0.2f, 0.114}, {0.3f, 0.180},
                                              {0.5f, 0.338}, {0.7f, 0.540}, {0.9f, 0.809}};
    for (const auto& [dry, expected] : known) {
        CHECK(0.9796 * double(wet_albedo(Rgb(dry)).g) == doctest::Approx(expected).epsilon(0.01).scale(0));
        const Bsdf film = under_water(MetallicRoughness{.base_color = Rgb(dry), .specular = 0}, {1, 1, 0});
        const double albedo = measure_albedo(film, direction(1), 51).g.mean();
        CHECK(albedo - 0.0204 == doctest::Approx(expected).epsilon(0.01).scale(0));
    }
}

TEST_CASE("water never makes light, and over white matt ground it loses none") {
    for (const WaterCover& water : covers)
        for (const float mu : {1.0f, 0.6f, 0.2f, 0.05f}) {
            CAPTURE(water.film);
            CAPTURE(water.pool);
            CAPTURE(mu);
            for (const Bsdf& dry : dry_surfaces(Rgb(1)))
                CHECK(measure_albedo(under_water(dry, water), direction(mu), 52).g.at_most(1, 1e-3));  // the tables
            const Bsdf matt = under_water(MetallicRoughness{.specular = 0}, water);
            CHECK(std::abs(measure_albedo(matt, direction(mu), 53).g.mean() - 1) < 2e-3);
        }
}

TEST_CASE("wet surfaces are reciprocal and their samples follow their pdf") {
    for (const WaterCover& water : covers)
        for (const Bsdf& dry : dry_surfaces(Rgb(0.6f))) {
            const Bsdf bsdf = under_water(dry, water);
            for (uint64_t i = 0; i < 100; ++i) {
                const Vec3 a = sample_cosine_hemisphere(uniform_2d(54, i, 0));
                const Vec3 b = sample_cosine_hemisphere(uniform_2d(54, i, 2));
                const float ab = evaluate(bsdf, a, b).f_cos.g / b.z, ba = evaluate(bsdf, b, a).f_cos.g / a.z;
                CHECK(std::abs(ab - ba) <= 1e-4f * std::max(ab, 1e-2f));
            }
            check_samples_agree_with_evaluation(bsdf, 55);
        }
    uint64_t seed = 56;
    for (const Bsdf& dry : dry_surfaces(Rgb(0.6f))) {
        const Vec3 wo = direction(0.5f, 1);
        const ChiSquare t = test_samples(under_water(dry, {1, 0, 0}), wo, seed++, direction(0.5f, 1 + pi), 0.1);
        CAPTURE(t.statistic);
        CAPTURE(t.degrees_of_freedom);
        CHECK(t.p_value > five_sigma_p_value);
    }
}

TEST_CASE("water stands on the share of level ground that is asked for, in hollows of metres") {
    for (const float share : {0.1f, 0.3f, 0.6f}) {
        RunningMean depth, pairs;
        for (uint64_t i = 0; i < 40'000; ++i) {
            const Vec3d p(double(uniform(57, i, 0)) * 900, 0.3, double(uniform(57, i, 1)) * 900);
            const float here = puddle_at(p, share).depth;
            depth.add(here);
            pairs.add(std::abs(here - puddle_at(p + Vec3d(0.05, 0, 0), share).depth));
        }
        CAPTURE(share);
        CAPTURE(depth.mean());
        CHECK(std::abs(depth.mean() - share) < 0.04);  // the noise is not quite normal
        CHECK(pairs.mean() < 0.1);                     // the next 5 cm are mostly alike
    }
    CHECK(puddle_at({1, 2, 3}, 0).depth == 0);
    CHECK(puddle_at({1, 2, 3}, 1).depth == 1);
}

TEST_CASE("as many rings start as drops fall, and they run on from frame to frame") {
    for (const double intensity : {10.0, 100.0})
        CHECK(Ripples(intensity, 1).rate() ==
              doctest::Approx(130 * size_moment(intensity, 0.5, 0.5e-3, largest_drop)).epsilon(1e-6).scale(0));
    CHECK(Ripples(0, 1).rate() == 0);
    CHECK(Ripples(0, 1).slope({1, 2, 3}, 4) == Vec2());
    // Steeper where it rains more; on average level; the same at the same time, little moved after 1/2000 s, and
    // another pattern after a second. The waves do not depend on when the sequence began.
    const auto mean_square = [](double intensity, double time, double later) {
        const Ripples ripples(intensity, 3);
        RunningMean square, level, change;
        for (uint64_t i = 0; i < 4000; ++i) {
            const Vec3d p(double(uniform(58, i, 0)) * 50, 0, double(uniform(58, i, 1)) * 50);
            const Vec2 a = ripples.slope(p, time), b = ripples.slope(p, time + later);
            square.add(a.x * a.x + a.y * a.y), level.add(a.x);
            change.add((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
        }
        CHECK(level.agrees_with(0));
        return std::pair(square.mean(), change.mean());
    };
    const auto [light, light_change] = mean_square(10, 7, 0.0005);
    const auto [heavy, heavy_change] = mean_square(100, 7, 0.0005);
    const auto [late, late_change] = mean_square(100, 7207, 1);
    CHECK(light > 0);
    CHECK(heavy > 2 * light);
    CHECK(heavy_change < 0.35 * heavy);
    CHECK(light_change < 0.35 * light);
    CHECK(late == doctest::Approx(heavy).epsilon(0.2).scale(0));
    CHECK(late_change == doctest::Approx(2 * late).epsilon(0.2).scale(0));
}

TEST_CASE("dry is the default, and a dry scene asks for no water") {
    const Scene scene = make_court(lambert(Rgb(0.5f)));
    const View view = court_view(32, 16);
    const Counters dry = render_picture(scene, white, view, {.samples = 2}).report.counters;
    for (const Feature f : {Feature::rain_shadow, Feature::wet_surface, Feature::puddle, Feature::ripples})
        CHECK(dry[f] == 0);
    const Counters film = render_picture(scene, white, view, wet(1, 0, 0)).report.counters;
    CHECK(film[Feature::rain_shadow] > 0);
    CHECK(film[Feature::wet_surface] > 0);
    CHECK(film[Feature::puddle] == 0);
    const Counters all = render_picture(scene, white, view, wet(1, 0.5f, 50)).report.counters;
    CHECK(all[Feature::puddle] > 0);
    CHECK(all[Feature::ripples] > 0);
}

TEST_CASE("a wet white court reflects all light of a uniform world") {
    const Scene scene = make_court(lambert(Rgb(1)));
    RenderSettings settings = wet(1, 0.3f, 50, 64);
    const Estimate e = estimate(scene, white, court_view(32, 16), settings, "background.G", 8);
    CAPTURE(e.mean);
    CAPTURE(e.standard_error);
    // Tilted water surfaces send part of their mirror image into the ground, which is lost as below any bent normal.
    CHECK(e.mean < 1 + 5 * e.standard_error + 1e-3);
    CHECK(e.mean > 0.97);
    settings.wet = {1, 0.3f, 0};
    const Estimate calm = estimate(scene, white, court_view(32, 16), settings, "background.G", 8);
    CAPTURE(calm.mean);
    CHECK(std::abs(calm.mean - 1) < 5 * calm.standard_error + 1e-3);  // the tables' error
}

TEST_CASE("wet ground is the same picture whatever it rains in front of it") {
    const Scene scene = make_court(lambert(Rgb(0.5f)));
    RenderSettings settings = wet(1, 0.5f, 50);
    const Picture clean = render_picture(scene, white, court_view(32, 16), settings);
    settings.rain.intensities_mm_per_h = {10, 100};
    const Picture rainy = render_picture(scene, white, court_view(32, 16), settings);
    CHECK(clean.plane("background.G") == rainy.plane("background.G"));
    const Picture dry = render_picture(scene, white, court_view(32, 16), {.samples = 4});
    CHECK(dry.mean("background.G") > 1.1 * clean.mean("background.G"));  // wet ground is darker
}

TEST_CASE("ground below a roof and materials that opt out stay dry") {
    Material ground = lambert(Rgb(0.5f));
    const auto picture = [&](bool roof, bool wettable) {
        ground.wet = wettable;
        Scene scene = make_plane(ground);
        // High enough to hide nothing from the camera, which looks at the ground below its middle.
        if (roof) add_quad(scene, {-52, 10, 52}, {104, 0, 0}, {0, 0, -104}, lambert(Rgb(0.5f)));
        return render_picture(scene, white, look_at({0, 3, 6}, {0, 0, 0}, 16, 8, 40), wet(1, 1, 0, 16));
    };
    CHECK(picture(false, true).report.counters[Feature::puddle] > 0);
    const Counters sheltered = picture(true, true).report.counters, opted_out = picture(false, false).report.counters;
    CHECK(sheltered[Feature::puddle] == 0);
    CHECK(opted_out[Feature::wet_surface] == 0);
    CHECK(opted_out[Feature::rain_shadow] == 0);
}

TEST_CASE("a puddle mirrors what stands behind it") {
    // Camera 2 m above water that lies around it; a lit wall 20 m off. Schlick's reflectance at the mirror's angle.
    Scene scene = make_plane(lambert(Rgb(0)));
    add_quad(scene, {-50, 0, -20}, {100, 0, 0}, {0, 20, 0}, emitter(Rgb(100)));
    const View view = look_at({0, 2, 0}, {0, 0, -10}, 2, 2, 4000);
    const Estimate e = estimate(scene, Environment(), view, wet(1, 1, 0, 256), "background.G", 8);
    const float cosine = 2 / std::sqrt(104.0f), f0 = normal_reflectance(water_ior);
    CAPTURE(e.mean);
    CAPTURE(e.standard_error);
    CHECK(std::abs(e.mean - 100 * (f0 + (1 - f0) * schlick_weight(cosine))) < 5 * e.standard_error + 0.2);
}

TEST_CASE("a file keeps which materials stay dry") {
    const TemporaryFolder folder;
    Scene scene = make_plane(lambert(Rgb(0.5f)));
    Material dry = lambert(Rgb(0.2f)), dry_lamp = emitter(Rgb(1));
    dry.wet = dry_lamp.wet = false, dry_lamp.lamp = true;
    add_quad(scene, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, dry);
    add_quad(scene, {0, 2, 0}, {1, 0, 0}, {0, 0, -1}, dry_lamp);
    save_glb(scene, folder / "dry.glb");
    const Scene read = load_gltf(folder / "dry.glb");
    REQUIRE(read.materials.size() >= 3);
    CHECK(read.materials[0].wet);
    CHECK(!read.materials[1].wet);
    CHECK(!read.materials[2].wet);
    CHECK(read.materials[2].lamp);
}

TEST_CASE("what is wet and what is dry follows the wind that made it so, where one is given") {
    // A wall shelters the ground behind it from rain that comes slanting over it.
    Scene scene = make_plane(lambert(Rgb(0.3f)));
    add_quad(scene, {0, 0, -50}, {0, 0, 100}, {0, 6, 0}, lambert(Rgb(0.3f)));
    const View view = look_at({4, 3, 6}, {1, 0, 0}, 32, 16, 20);
    const auto shot = [&](Vec3d wind, std::optional<Vec3d> wet_wind) {
        RenderSettings settings{.samples = 4, .wet = {.wetness = 1}, .wet_wind = wet_wind};
        settings.rain.wind = wind;
        return render_picture(scene, Environment::uniform(Rgb(1)), view, settings);
    };
    const Picture west = shot({20, 0, 0}, {}), calm = shot({0, 0, 0}, {});
    CHECK(!(west == calm));
    CHECK(shot({20, 0, 0}, Vec3d(0, 0, 0)) == calm);
    CHECK(shot({0, 0, 0}, Vec3d(20, 0, 0)) == west);
}

}  // namespace pluvia
