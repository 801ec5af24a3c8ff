// Clear coat and sheen over the metallic-roughness material.
#include "shaders/layered.h"

#include "renderer/core/sampling.h"
#include "tests/bsdf_checks.h"

#include <doctest/doctest.h>

#include <vector>

using namespace pluvia;

namespace {

const float cosines[] = {1, 0.9f, 0.6f, 0.3f, 0.1f, 0.02f};
const Vec3 tilted = normalize(Vec3(0.2f, -0.1f, 1));

std::vector<Layered> materials() {
    std::vector<Layered> list;
    for (const float metallic : {0.0f, 0.5f, 1.0f})
        for (const float roughness : {0.1f, 0.4f, 1.0f})
            for (const float coat_roughness : {0.0f, 0.3f, 1.0f}) {
                const MetallicRoughness base = {.metallic = metallic, .roughness = roughness};
                list.push_back({.base = base, .sheen = {}, .coat = 1, .coat_roughness = coat_roughness});
                list.push_back(
                    {.base = base, .sheen = {}, .coat = 1, .coat_roughness = coat_roughness, .coat_normal = tilted});
                list.push_back({.base = base, .sheen = {Rgb(0.9f, 1, 0.3f), coat_roughness}});
                list.push_back({.base = base, .sheen = {Rgb(1), 0.5f}, .coat = 0.7f, .coat_roughness = coat_roughness});
            }
    return list;
}

}  // namespace

TEST_CASE("layers never make light") {
    for (const Layered& material : materials())
        for (const float mu : cosines) {
            const Albedo albedo = measure_albedo(material, direction(mu, 0.7f), 41);
            CAPTURE(material.base.metallic);
            CAPTURE(material.base.roughness);
            CAPTURE(material.coat);
            CAPTURE(material.coat_roughness);
            CAPTURE(material.sheen.roughness);
            CAPTURE(mu);
            CAPTURE(albedo.g.mean());
            CHECK(albedo.g.at_most(1, 1e-3));  // the tables' error
        }
}

TEST_CASE("a clear coat over a white diffuse base keeps all light") {
    for (const float coat_roughness : {0.0f, 0.3f, 0.6f, 1.0f})
        for (const float coat : {0.5f, 1.0f})
            for (const float mu : cosines) {
                const Layered paint = {
                    .base = {.specular = 0}, .sheen = {}, .coat = coat, .coat_roughness = coat_roughness};
                const double albedo = measure_albedo(paint, direction(mu), 42).g.mean();
                CAPTURE(coat_roughness);
                CAPTURE(mu);
                CAPTURE(albedo);
                CHECK(std::abs(albedo - 1) < 2e-3);  // the tables' error, and the samples'
            }
}

TEST_CASE("a clear coat over white plastic or metal loses a few percent at most") {
    for (const float metallic : {0.0f, 1.0f})
        for (const float roughness : {0.0f, 0.3f, 0.6f})
            for (const float mu : {1.0f, 0.6f, 0.3f}) {
                const Layered paint = {.base = {.metallic = metallic, .roughness = roughness}, .sheen = {}, .coat = 1};
                const double albedo = measure_albedo(paint, direction(mu), 43).g.mean();
                CAPTURE(metallic);
                CAPTURE(roughness);
                CAPTURE(mu);
                CAPTURE(albedo);
                CHECK(albedo > 0.93);
                // What lies in one direction is reflected in one direction: nothing is lost there.
                if (roughness == 0) CHECK(albedo > 0.998);
            }
}

TEST_CASE("a smooth coat over black mirrors four percent, and its strength scales that") {
    for (const float coat : {1.0f, 0.5f}) {
        const Layered paint = {.base = {.base_color = Rgb(0), .specular = 0}, .sheen = {}, .coat = coat};
        CHECK(measure_albedo(paint, direction(1), 44).g.mean() == doctest::Approx(0.04 * coat).epsilon(5e-3).scale(0));
    }
}

TEST_CASE("sheen over black reflects its colour times the tabulated albedo") {
    for (const float roughness : {0.2f, 0.5f, 1.0f})
        for (const float mu : {1.0f, 0.5f, 0.15f}) {
            const Layered cloth = {.base = {.base_color = Rgb(0), .specular = 0},
                                   .sheen = {Rgb(1, 0.5f, 0), roughness}};
            const Albedo albedo = measure_albedo(cloth, direction(mu), 45);
            CAPTURE(roughness);
            CAPTURE(mu);
            const double table = sheen_albedo(mu, roughness);
            CHECK(albedo.r.agrees_with(table, 5e-3));  // the interpolation of the table
            CHECK(albedo.g.agrees_with(table / 2, 5e-3));
            CHECK(albedo.b.mean() == 0);
        }
}

TEST_CASE("layers of no strength leave the base as it is") {
    const MetallicRoughness base = {.base_color = Rgb(0.5f), .metallic = 0.5f, .roughness = 0.4f};
    for (uint64_t i = 0; i < 100; ++i) {
        const Vec3 a = sample_cosine_hemisphere(uniform_2d(46, i, 0)),
                   b = sample_cosine_hemisphere(uniform_2d(46, i, 2));
        const BsdfValue plain = evaluate(Bsdf(base), a, b),
                        layered = evaluate(Bsdf(Layered{.base = base, .sheen = {}}), a, b);
        CHECK(layered.f_cos.g == doctest::Approx(plain.f_cos.g).epsilon(1e-6).scale(0));
        CHECK(layered.pdf == doctest::Approx(plain.pdf).epsilon(1e-6).scale(0));
    }
}

TEST_CASE("layered materials are reciprocal") {
    for (const Layered& material : materials())
        for (uint64_t i = 0; i < 100; ++i) {
            const Vec3 a = sample_cosine_hemisphere(uniform_2d(47, i, 0));
            const Vec3 b = sample_cosine_hemisphere(uniform_2d(47, i, 2));
            // Under a tilted coat the coat's own cosine stands beside the base's.
            if (material.coat_normal != Vec3(0, 0, 1)) continue;
            const float ab = evaluate(Bsdf(material), a, b).f_cos.g / b.z,
                        ba = evaluate(Bsdf(material), b, a).f_cos.g / a.z;
            CHECK(std::abs(ab - ba) <= 1e-5f * std::max(ab, 1e-2f));
        }
}

TEST_CASE("samples of layered materials follow their pdf") {
    const Layered cases[] = {
        {.base = {.metallic = 1, .roughness = 0.4f}, .sheen = {}, .coat = 1, .coat_roughness = 0.1f},
        {.base = {.roughness = 0.5f}, .sheen = {}, .coat = 1, .coat_roughness = 0.3f, .coat_normal = tilted},
        {.base = {.roughness = 0.8f}, .sheen = {Rgb(0.8f), 0.4f}},
        {.base = {.metallic = 1, .roughness = 1}, .sheen = {Rgb(1), 1}, .coat = 0.5f}};
    for (const Layered& material : cases)
        for (const float mu : {1.0f, 0.6f, 0.15f}) {
            const float roughness = std::max(
                min_roughness, std::min(material.base.roughness, material.coat > 0 ? material.coat_roughness : 1));
            const ChiSquare result =
                test_samples(material, direction(mu, 0.4f), 48, direction(mu, 0.4f + pi), 0.5 * roughness * roughness);
            CAPTURE(mu);
            CAPTURE(result.statistic);
            CAPTURE(result.degrees_of_freedom);
            CHECK(result.p_value > five_sigma_p_value);
        }
}

TEST_CASE("a sample of a layered material carries the pdf and the weight that evaluation gives") {
    for (const Layered& material : materials()) check_samples_agree_with_evaluation(material, 49);
}
