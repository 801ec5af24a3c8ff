// Anisotropic microfacets: light stays in balance whatever their widths and wherever they point.
#include "shaders/anisotropy.h"

#include "renderer/core/sampling.h"
#include "tests/bsdf_checks.h"

#include <doctest/doctest.h>

#include <vector>

using namespace pluvia;

namespace {

const float roughnesses[] = {0, 0.1f, 0.3f, 0.6f, 0.9f};
const float strengths[] = {0.15f, 0.5f, 0.8f, 1};

Vec2 turned(float angle) {
    return {std::cos(angle), std::sin(angle)};
}

std::vector<MetallicRoughness> materials(Rgb color) {
    std::vector<MetallicRoughness> list;
    for (const float roughness : roughnesses)
        for (const float strength : strengths)
            for (const float metallic : {0.0f, 1.0f})
                list.push_back({.base_color = color,
                                .metallic = metallic,
                                .roughness = roughness,
                                .anisotropy = {strength, turned(0.5f)}});
    return list;
}

}  // namespace

TEST_CASE("anisotropic microfacets cover the ground that they stand on, and slope as far as their widths say") {
    for (const float roughness : {0.2f, 0.5f, 1.0f})
        for (const float strength : {0.3f, 1.0f}) {
            const AnisotropicGgx ggx(roughness, {strength, turned(1)});
            const float across = roughness * roughness, along = across + (1 - across) * strength * strength;
            CHECK(ggx.alpha_along() == doctest::Approx(along).scale(0).epsilon(1e-6));
            // Seen from above, all of them are visible: D cos is the density of what is drawn.
            RunningMean ground;
            for (uint64_t i = 0; i < 20'000; ++i) {
                const Vec3 h = sample_cosine_hemisphere(uniform_2d(71, i, 0));
                ground.add(ggx.density(h * 3.0f) * pi);  // of any length
            }
            CAPTURE(roughness);
            CAPTURE(strength);
            if (roughness > 0.3f) CHECK(ground.agrees_with(1, 0));
            // (1 + tan^2 / alpha^2)^-2 / cos^4, Walter et al. 2007, equation 33, in each main direction.
            const float slope = 0.7f, c = 1 / std::sqrt(1 + slope * slope);
            const Vec3 main_axes[] = {{std::cos(1.0f), std::sin(1.0f), 0}, {-std::sin(1.0f), std::cos(1.0f), 0}};
            const float widths[] = {along, across};
            for (const int k : {0, 1}) {
                const Vec3 h = normalize(main_axes[k] * slope + Vec3(0, 0, 1));
                const float spread = 1 + slope * slope / (widths[k] * widths[k]);
                CHECK(ggx.density(h) == doctest::Approx(1 / (pi * along * across * spread * spread * c * c * c * c)));
            }
        }
}

TEST_CASE("with one width the anisotropic distribution is the isotropic one") {
    const Bsdf isotropic = MetallicRoughness{.base_color = Rgb(0.5f), .metallic = 0.5f, .roughness = 1};
    // The only roughness that no strength can stretch.
    const Bsdf stretched =
        MetallicRoughness{.base_color = Rgb(0.5f), .metallic = 0.5f, .roughness = 1, .anisotropy = {0.7f, turned(2)}};
    for (uint64_t i = 0; i < 200; ++i) {
        const Vec3 a = sample_cosine_hemisphere(uniform_2d(72, i, 0)),
                   b = sample_cosine_hemisphere(uniform_2d(72, i, 2));
        const BsdfValue x = evaluate(isotropic, a, b), y = evaluate(stretched, a, b);
        CHECK(x.f_cos.g == doctest::Approx(y.f_cos.g).scale(0).epsilon(0.02));  // the two tables of albedos
        CHECK(x.pdf == doctest::Approx(y.pdf).scale(0).epsilon(0.02));
    }
}

TEST_CASE("the anisotropic albedo table agrees with samples") {
    for (const float roughness : {min_roughness, 0.12f, 0.37f, 0.66f})
        for (const float strength : {0.1f, 0.45f, 0.9f, 1.0f})
            for (const float mu : {0.99f, 0.5f, 0.1f, 0.02f})
                for (const float phi : {0.1f, 0.8f, 1.35f, 1.57f}) {
                    const AnisotropicGgx ggx(roughness, {strength, {1, 0}});
                    const Vec3 wo = direction(mu, phi);
                    const float root = ggx.masking_root(wo);
                    RunningMean lost, grazing;
                    for (uint64_t i = 0; i < 20'000; ++i) {
                        const Vec3 h = ggx.sample_visible_normal(wo, uniform_2d(73, i, 0));
                        const Vec3 wi = h * (2 * dot(wo, h)) - wo;
                        const float returned =
                            wi.z > 0 ? wi.z * (mu + root) / (mu * ggx.masking_root(wi) + wi.z * root) : 0;  // G2 / G1
                        lost.add(1 - returned);
                        grazing.add(returned * schlick_weight(std::min(1.0f, dot(wo, h))));
                    }
                    CAPTURE(roughness);
                    CAPTURE(strength);
                    CAPTURE(mu);
                    CAPTURE(phi);
                    CAPTURE(lost.mean());
                    CAPTURE(grazing.mean());
                    const GgxAlbedo table = ggx.albedo(wo);
                    CHECK(lost.agrees_with(table.lost, 4e-3));  // the table's stated error
                    // Near the horizon Schlick's term is steep.
                    CHECK(grazing.agrees_with(table.grazing, mu > 0.05f ? 0.02 : 0.05));  // likewise
                }
}

TEST_CASE("a white anisotropic metal reflects all light, and no anisotropic surface more than it receives") {
    for (const MetallicRoughness& material : materials(Rgb(1)))
        for (const float mu : {1.0f, 0.6f, 0.2f, 0.05f})
            for (const float phi : {0.5f, 1.2f, 2.0f}) {
                const RunningMean albedo = measure_albedo(material, direction(mu, phi), 74).g;
                CAPTURE(material.roughness);
                CAPTURE(material.anisotropy.strength);
                CAPTURE(material.metallic);
                CAPTURE(mu);
                CAPTURE(phi);
                CAPTURE(albedo.mean());
                const double table = material.metallic == 1 ? 6e-3 : mu > 0.1f ? 0.015 : 0.05;
                CHECK(albedo.agrees_with(1, table));
            }
}

TEST_CASE("anisotropic materials are reciprocal") {
    for (const MetallicRoughness& material : materials(Rgb(0.7f, 0.4f, 0.1f)))
        for (uint64_t i = 0; i < 200; ++i) {
            const Vec3 a = sample_cosine_hemisphere(uniform_2d(75, i, 0));
            const Vec3 b = sample_cosine_hemisphere(uniform_2d(75, i, 2));
            const Rgb ab = evaluate(Bsdf(material), a, b).f_cos / b.z, ba = evaluate(Bsdf(material), b, a).f_cos / a.z;
            CAPTURE(material.roughness);
            CAPTURE(material.anisotropy.strength);
            // Roundings of single precision, 6e-8 each, times the ratio of the widths inside the distribution.
            CHECK(std::abs(ab.r - ba.r) <= 1e-5f * std::max(ab.r, 1e-3f));
            CHECK(std::abs(ab.b - ba.b) <= 1e-5f * std::max(ab.b, 1e-3f));
        }
}

TEST_CASE("samples of anisotropic materials follow their pdf") {
    const MetallicRoughness cases[] = {{.metallic = 1, .roughness = 0.3f, .anisotropy = {0.5f, turned(0.3f)}},
                                       {.metallic = 1, .roughness = 0.2f, .anisotropy = {1, turned(2)}},
                                       {.metallic = 0.5f, .roughness = 0.6f, .anisotropy = {0.8f, turned(1)}},
                                       {.roughness = 0.4f, .anisotropy = {0.6f, turned(0)}}};
    for (const MetallicRoughness& material : cases)
        for (const float mu : {1.0f, 0.6f, 0.15f}) {
            const float width = 0.5f * material.roughness * material.roughness;
            const ChiSquare result = test_samples(material, direction(mu, 0.4f), 76, direction(mu, 0.4f + pi), width);
            CAPTURE(material.roughness);
            CAPTURE(material.anisotropy.strength);
            CAPTURE(mu);
            CAPTURE(result.statistic);
            CAPTURE(result.degrees_of_freedom);
            CHECK(result.p_value > five_sigma_p_value);
        }
}

TEST_CASE("a sample of an anisotropic material carries the pdf and the weight that evaluation gives") {
    for (const MetallicRoughness& material : materials(Rgb(0.8f))) check_samples_agree_with_evaluation(material, 77);
}

TEST_CASE("anisotropic values and samples are finite at the edges of all parameters") {
    const float last = 1 - 0x1p-24f;
    for (const MetallicRoughness& material : materials(Rgb(0.8f)))
        for (const float mu : {1.0f, 1.0000001f, 1e-3f, 1e-7f, 1e-20f, 1e-38f})
            for (const float phi : {0.5f, 2.0708f, 0.0f}) {  // along, across and between
                const float sine = std::sqrt(std::max(0.0f, 1 - mu * mu));
                const PreparedBsdf bsdf = prepare(material, Vec3(sine * std::cos(phi), sine * std::sin(phi), mu));
                for (const float nu : {1.0f, 1e-3f, 1e-20f}) {
                    const BsdfValue value = evaluate(bsdf, direction(nu, phi + pi));
                    CHECK(is_finite(value.f_cos));
                    CHECK(value.pdf >= 0);
                    CHECK(std::min({value.f_cos.r, value.f_cos.g, value.f_cos.b}) >= 0);
                }
                for (const Vec2 u : {Vec2{0, 0}, Vec2{0.5f, 0.5f}, Vec2{last, last}, Vec2{0, last}}) {
                    const auto s = sample(bsdf, 0.3f, u);
                    if (!s) continue;
                    CHECK(is_finite(s->weight));
                    CHECK(s->pdf > 0);
                }
            }
}

TEST_CASE("a coat over anisotropic metal makes no light and takes the turn of its base along") {
    for (const float roughness : {0.1f, 0.4f})
        for (const float mu : {1.0f, 0.5f, 0.1f}) {
            Layered paint = {.base = {.metallic = 1, .roughness = roughness, .anisotropy = {0.7f, turned(0)}},
                             .sheen = {},
                             .coat = 1,
                             .coat_roughness = 0.1f};
            const RunningMean albedo = measure_albedo(paint, direction(mu, 0.7f), 78).g;
            CAPTURE(roughness);
            CAPTURE(mu);
            CHECK(albedo.at_most(1, 4e-3));
            CHECK(albedo.mean() > 0.9);
            const Vec3 wo = direction(mu, 0.7f), wi = direction(0.7f, 2);
            const float before = evaluate(Bsdf(paint), wo, wi).f_cos.g;
            paint.base.anisotropy.direction = turned(0.9f);
            CHECK(evaluate(Bsdf(paint), direction(mu, 1.6f), direction(0.7f, 2.9f)).f_cos.g ==
                  doctest::Approx(before).scale(0).epsilon(1e-4));
        }
}
