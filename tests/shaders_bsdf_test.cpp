#include "shaders/bsdf.h"

#include "renderer/core/sampling.h"
#include "tests/bsdf_checks.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <vector>

using namespace pluvia;

namespace {

const float roughnesses[] = {0, 0.05f, 0.1f, 0.2f, 0.35f, 0.6f, 0.8f, 1};
const float cosines[] = {1, 0.9f, 0.6f, 0.3f, 0.1f, 0.03f, 0.003f, 1e-4f};

std::vector<MetallicRoughness> materials() {
    std::vector<MetallicRoughness> list;
    for (const float roughness : roughnesses) {
        for (const float metallic : {0.0f, 0.3f, 1.0f}) {
            for (const Rgb color : {Rgb(1), Rgb(0.8f, 0.3f, 0.05f), Rgb(0)})
                list.push_back({.base_color = color, .metallic = metallic, .roughness = roughness});
            list.push_back({.base_color = Rgb(0.5f), .metallic = metallic, .roughness = roughness, .specular = 0});
            list.push_back({.metallic = metallic, .roughness = roughness, .specular = 0.5f, .ior = 2.4f});
        }
    }
    return list;
}

}  // namespace

TEST_CASE("a white surface reflects all light at any roughness and angle, metal, plastic or between") {
    for (const float roughness : roughnesses) {
        for (const float metallic : {0.0f, 0.5f, 1.0f}) {
            for (const float mu : cosines) {
                CAPTURE(roughness);
                CAPTURE(metallic);
                CAPTURE(mu);
                const MetallicRoughness white = {.metallic = metallic, .roughness = roughness};
                const RunningMean albedo = measure_albedo(white, direction(mu), 12).g;
                CAPTURE(albedo.mean());
                // The grid's error is far below the one of independent samples, which would be up to 2e-3.
                CHECK(std::abs(albedo.mean() - 1) < 1e-3);
            }
        }
    }
}

TEST_CASE("no surface reflects more light than it receives") {
    for (const MetallicRoughness& material : materials()) {
        for (const float mu : {1.0f, 0.5f, 0.1f, 0.01f}) {
            const Albedo albedo = measure_albedo(material, direction(mu, 0.7f), 13);
            CAPTURE(material.base_color.r);
            CAPTURE(material.metallic);
            CAPTURE(material.roughness);
            CAPTURE(material.specular);
            CAPTURE(mu);
            CAPTURE(albedo.r.mean());
            CHECK(albedo.r.at_most(1, 1e-3));  // the tables' error, which white surfaces show
            CHECK(albedo.g.at_most(1, 1e-3));
            CHECK(albedo.b.at_most(1, 1e-3));
        }
    }
}

TEST_CASE("a grey metal absorbs at each of its bounces between microfacets") {
    // At alpha = 1, where 1 - E_avg is known, bounce by bounce: of what is lost at first, F^2 E_avg leaves at the
    // second, F^3 (1 - E_avg) E_avg at the third, and so on, F the cosine-weighted mean of Schlick's reflectance.
    const double f0 = 0.5, average_lost = 0.5908629, f = f0 + (1 - f0) / 21;
    double later = 0, arriving = f;
    for (int bounce = 2; bounce < 60; ++bounce, arriving *= f * average_lost)
        later += arriving * f * (1 - average_lost);
    const GgxAlbedoRow row(1);
    for (const float mu : {1.0f, 0.5f, 0.1f}) {
        const GgxAlbedo first = row.at(mu);
        const double expected = f0 * (1 - first.lost - first.grazing) + first.grazing + later * first.lost;
        const Bsdf metal = MetallicRoughness{.base_color = Rgb(0.5f), .metallic = 1};
        CAPTURE(mu);
        CHECK(std::abs(measure_albedo(metal, direction(mu), 20).g.mean() - expected) < 1e-3);  // as for white
    }
}

TEST_CASE("without specular reflection the material is exactly Lambert's") {
    const Rgb color(0.8f, 0.4f, 0.2f);
    const Bsdf bsdf = MetallicRoughness{.base_color = color, .roughness = 0.3f, .specular = 0};
    for (const float mu : cosines) {
        const Vec3 wi = direction(mu, 2);
        const BsdfValue value = evaluate(bsdf, direction(0.3f), wi);
        CHECK(value.f_cos.r == doctest::Approx(color.r / pi * mu).epsilon(1e-6).scale(0));
        CHECK(value.pdf == doctest::Approx(mu / pi).epsilon(1e-6).scale(0));
    }
    RunningMean albedo = measure_albedo(bsdf, direction(0.3f), 14).r;
    CHECK(albedo.mean() == doctest::Approx(color.r).epsilon(1e-6).scale(0));
    CHECK(albedo.variance() < 1e-12);
}

TEST_CASE("black plastic at normal incidence mirrors four percent") {
    const Bsdf bsdf = MetallicRoughness{.base_color = Rgb(0), .roughness = 0.1f};
    CHECK(measure_albedo(bsdf, direction(1), 15).g.mean() == doctest::Approx(0.04).epsilon(2e-3).scale(0));
    // Almost smooth at 60 degrees: Schlick's 0.04 + 0.96 / 32.
    CHECK(measure_albedo(bsdf, direction(0.5f), 16).g.mean() == doctest::Approx(0.07).epsilon(5e-3).scale(0));
}

TEST_CASE("the metallic-roughness material is reciprocal") {
    for (const MetallicRoughness& material : materials()) {
        for (uint64_t i = 0; i < 200; ++i) {
            const Vec3 a = sample_cosine_hemisphere(uniform_2d(17, i, 0));
            const Vec3 b = sample_cosine_hemisphere(uniform_2d(17, i, 2));
            const Rgb ab = evaluate(Bsdf(material), a, b).f_cos / b.z, ba = evaluate(Bsdf(material), b, a).f_cos / a.z;
            CAPTURE(material.roughness);
            CAPTURE(material.metallic);
            // A few roundings of single precision, 6e-8 each; the sum is as large as its largest term.
            CHECK(std::abs(ab.r - ba.r) <= 2e-6f * std::max(ab.r, 1e-3f));
            CHECK(std::abs(ab.b - ba.b) <= 2e-6f * std::max(ab.b, 1e-3f));
        }
    }
}

TEST_CASE("samples of the metallic-roughness material follow its pdf") {
    const MetallicRoughness cases[] = {{.metallic = 1, .roughness = 0},
                                       {.metallic = 1, .roughness = 0.2f},
                                       {.metallic = 1, .roughness = 0.5f},
                                       {.metallic = 1, .roughness = 1},
                                       {.roughness = 0.1f},
                                       {.roughness = 0.6f},
                                       {.specular = 0},
                                       {.metallic = 0.5f, .roughness = 0.3f}};
    for (const MetallicRoughness& material : cases) {
        for (const float mu : {1.0f, 0.6f, 0.15f, 0.02f}) {
            const Vec3 wo = direction(mu, 0.4f);
            const PreparedBsdf bsdf = prepare(material, wo);
            const auto draw = [&](uint64_t i) -> std::optional<Vec3> {
                const auto s = sample(bsdf, uniform(18, i, 0), uniform_2d(18, i, 1));
                return s ? std::optional(s->wi) : std::nullopt;
            };
            const auto pdf = [&](Vec3 wi) { return double(evaluate(bsdf, wi).pdf); };
            const float roughness = std::max(min_roughness, material.roughness);
            const SphereGrid grid = {.axis = direction(mu, 0.4f + pi),  // the mirror direction
                                     .width = 0.5 * roughness * roughness,
                                     .rings = 40,
                                     .azimuths = 20};
            const ChiSquare result = test_directions(draw, pdf, 200'000, grid);
            CAPTURE(material.metallic);
            CAPTURE(material.roughness);
            CAPTURE(mu);
            CAPTURE(result.statistic);
            CAPTURE(result.degrees_of_freedom);
            CHECK(result.p_value > five_sigma_p_value);
        }
    }
}

TEST_CASE("a sample carries the pdf and the weight that evaluation gives") {
    for (const MetallicRoughness& material : materials()) {
        for (uint64_t i = 0; i < 100; ++i) {
            const PreparedBsdf bsdf = prepare(material, sample_cosine_hemisphere(uniform_2d(19, i, 0)));
            const auto s = sample(bsdf, uniform(19, i, 2), uniform_2d(19, i, 3));
            if (!s) continue;
            const BsdfValue value = evaluate(bsdf, s->wi);
            CHECK(s->pdf == value.pdf);
            CHECK(s->weight.g * s->pdf == doctest::Approx(value.f_cos.g).epsilon(1e-6).scale(0));
            CHECK_FALSE(s->delta);
            CHECK_FALSE(s->transmitted);
            CHECK(s->wi.z > 0);
            CHECK(length(s->wi) == doctest::Approx(1).epsilon(1e-6));
        }
    }
}

TEST_CASE("values and samples are finite at the edges of all parameters") {
    const float last = 1 - 0x1p-24f;
    for (const MetallicRoughness& material : materials()) {
        for (const float mu : {1.0f, 1.0000001f, 1e-3f, 1e-7f, 1e-20f, 1e-38f}) {
            const Vec3 wo = {std::sqrt(std::max(0.0f, 1 - mu * mu)), 0, mu};
            const PreparedBsdf bsdf = prepare(material, wo);
            CAPTURE(material.roughness);
            CAPTURE(material.metallic);
            CAPTURE(mu);
            for (const float nu : {1.0f, 1e-3f, 1e-20f}) {
                for (const float phi : {0.0f, pi}) {
                    const BsdfValue value = evaluate(bsdf, direction(nu, phi));
                    CHECK(is_finite(value.f_cos));
                    CHECK(std::isfinite(value.pdf));
                    CHECK(value.pdf >= 0);
                    CHECK(std::min({value.f_cos.r, value.f_cos.g, value.f_cos.b}) >= 0);
                }
            }
            for (const float lobe : {0.0f, 0.5f, last}) {
                for (const Vec2 u : {Vec2{0, 0}, Vec2{0.5f, 0.5f}, Vec2{last, last}, Vec2{0, last}, Vec2{last, 0}}) {
                    const auto s = sample(bsdf, lobe, u);
                    if (!s) continue;
                    CHECK(is_finite(s->wi));
                    CHECK(is_finite(s->weight));
                    CHECK(s->pdf > 0);
                }
            }
        }
    }
}

TEST_CASE("nothing is reflected from or to the back of a surface") {
    const Vec3 up = direction(0.5f), down = -up;
    for (const Bsdf& bsdf : {Bsdf(MetallicRoughness{}), Bsdf(MetallicRoughness{.specular = 0})}) {
        CHECK(is_black(evaluate(bsdf, down, up).f_cos));
        CHECK(is_black(evaluate(bsdf, up, down).f_cos));
        CHECK(evaluate(bsdf, up, down).pdf == 0);
        CHECK_FALSE(sample(bsdf, down, 0.3f, {0.5f, 0.5f}));
        CHECK_FALSE(is_delta(prepare(bsdf, up)));
    }
    CHECK_FALSE(sample(Pane{}, down, 0.3f, {0.5f, 0.5f}));
}

TEST_CASE("a clear pane keeps all light, mirrored or straight on") {
    for (const float mu : cosines) {
        const Vec3 wo = direction(mu, 1);
        const PreparedBsdf pane = prepare(Pane{}, wo);
        CHECK(is_delta(pane));
        CAPTURE(mu);
        double reflected = 0, transmitted = 0;
        constexpr int steps = 10000;
        for (int i = 0; i < steps; ++i) {
            const auto s = sample(pane, (float(i) + 0.5f) / steps, {});
            REQUIRE(s);
            CHECK(s->weight.g == doctest::Approx(1).epsilon(1e-6));
            CHECK(s->delta);
            CHECK(s->wi == (s->transmitted ? -wo : Vec3(-wo.x, -wo.y, wo.z)));
            (s->transmitted ? transmitted : reflected) += s->weight.g / steps;
        }
        CHECK(reflected + transmitted == doctest::Approx(1).epsilon(1e-6));
        CHECK(reflected == doctest::Approx(pane_reflectance(mu, 1.5f)).epsilon(1e-3).scale(1));
    }
    // Two faces of 4 %: 2R / (1 + R).
    CHECK(pane_reflectance(1, 1.5f) == doctest::Approx(0.08 / 1.04).epsilon(1e-6).scale(0));
    CHECK(is_black(evaluate(Pane{}, direction(0.5f), direction(0.5f, pi)).f_cos));
}

TEST_CASE("a pane's tint colours what passes, not what is mirrored") {
    const Rgb tint(0.9f, 0.5f, 0.1f);
    const float reflectance = pane_reflectance(0.4f, 1.5f);
    Rgb reflected, transmitted;
    constexpr int steps = 10000;
    for (int i = 0; i < steps; ++i) {
        const auto s = sample(Pane{.tint = tint}, direction(0.4f), (float(i) + 0.5f) / steps, {});
        REQUIRE(s);
        (s->transmitted ? transmitted : reflected) += s->weight / steps;
    }
    // A grid of 10000 lobes counts each to 1e-4.
    CHECK(std::abs(reflected.r - reflectance) < 2e-4);
    CHECK(std::abs(transmitted.r - 0.9f * (1 - reflectance)) < 2e-4);
    CHECK(std::abs(transmitted.b - 0.1f * (1 - reflectance)) < 2e-4);
    const auto black = sample(Pane{.tint = Rgb(0)}, direction(0.4f), 0.999f, {});
    REQUIRE(black);
    CHECK(black->weight.r == doctest::Approx(reflectance));
    CHECK_FALSE(black->transmitted);
    // A pane that neither mirrors nor passes.
    const auto nothing = sample(Pane{.tint = Rgb(0), .ior = 1}, direction(1), 0.5f, {});
    REQUIRE(nothing);
    CHECK(is_black(nothing->weight));
}
