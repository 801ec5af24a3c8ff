// Light through glass: bodies that refract, and thin frosted sheets.
#include "shaders/glass.h"

#include "renderer/core/sampling.h"
#include "shaders/frosted_pane.h"
#include "tests/bsdf_checks.h"

#include <doctest/doctest.h>

using namespace pluvia;

namespace {

const float cosines[] = {1, 0.9f, 0.6f, 0.3f, 0.1f, 0.02f};
const float indices[] = {1.5f, 1 / 1.5f, 1.33f, 1 / 2.4f};

Vec3 turned_over(Vec3 v) {
    return {v.x, v.y, -v.z};
}

}  // namespace

TEST_CASE("clear glass keeps all light at any roughness, index and angle") {
    for (const float eta : indices)
        for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f})
            for (const float mu : cosines) {
                const RunningMean albedo =
                    measure_albedo(Glass{.roughness = roughness, .eta = eta}, direction(mu), 51).g;
                CAPTURE(eta);
                CAPTURE(roughness);
                CAPTURE(mu);
                CAPTURE(albedo.mean());
                // The table's error; inside diamond near the critical angle its columns are far apart.
                CHECK(albedo.agrees_with(1, eta < 0.5f ? 6e-3 : 1e-3));
            }
}

TEST_CASE("smooth glass mirrors by Fresnel and bends by Snell") {
    const Vec3 wo = direction(0.6f, 1);
    double reflected = 0;
    constexpr int steps = 10000;
    for (int i = 0; i < steps; ++i) {
        const auto s = sample(Glass{.tint = Rgb(0.5f)}, wo, (float(i) + 0.5f) / steps, {});
        REQUIRE(s);
        CHECK(s->delta);
        CHECK(s->weight.g == (s->transmitted ? 0.5f : 1.0f));
        if (s->transmitted) CHECK(s->wi.z == doctest::Approx(-std::sqrt(1 - 0.64 / 2.25)).epsilon(1e-6).scale(0));
        reflected += !s->transmitted;
    }
    CHECK(std::abs(reflected / steps - fresnel_dielectric(0.6, 1.5).mean()) < 2e-4);
    CHECK(is_delta(prepare(Glass{}, wo)));
    // Beyond the critical angle nothing leaves.
    for (int i = 0; i < 100; ++i) {
        const auto s = sample(Glass{.eta = 1 / 1.5f}, direction(0.7f), (float(i) + 0.5f) / 100, {});
        REQUIRE(s);
        CHECK_FALSE(s->transmitted);
    }
}

TEST_CASE("glass is reciprocal with the square of its index, each side seen from the other") {
    for (const float eta : indices)
        for (const float roughness : {0.2f, 0.5f, 1.0f}) {
            const Bsdf here = Glass{.roughness = roughness, .eta = eta},
                       there = Glass{.roughness = roughness, .eta = 1 / eta};
            for (uint64_t i = 0; i < 200; ++i) {
                const Vec3 a = sample_cosine_hemisphere(uniform_2d(52, i, 0));
                const Vec3 b = sample_cosine_hemisphere(uniform_2d(52, i, 2));
                const float ab = evaluate(here, a, b).f_cos.g / b.z, ba = evaluate(here, b, a).f_cos.g / a.z;
                CHECK(std::abs(ab - ba) <= 1e-4f * std::max(ab, 1e-2f));
                const float through = evaluate(here, a, turned_over(b)).f_cos.g / b.z;
                const float back = evaluate(there, b, turned_over(a)).f_cos.g / a.z;
                CAPTURE(eta);
                CAPTURE(roughness);
                // The half vector of refraction loses some digits where the index is near 1 or light is grazing.
                CHECK(std::abs(through - eta * eta * back) <= 1e-3f * std::max(through, 1e-2f));
            }
        }
}

TEST_CASE("samples of rough glass follow their pdf") {
    for (const float eta : {1.5f, 1 / 1.5f})
        for (const float roughness : {0.2f, 0.5f, 1.0f})
            for (const float mu : {1.0f, 0.6f, 0.15f}) {
                const Vec3 wo = direction(mu, 0.4f);
                const auto refracted = refract(wo, {0, 0, 1}, eta);
                const Vec3 axis = refracted ? *refracted : direction(mu, 0.4f + pi);
                const ChiSquare result =
                    test_samples(Glass{.roughness = roughness, .eta = eta}, wo, 53, axis, 0.3 * roughness * roughness);
                CAPTURE(eta);
                CAPTURE(roughness);
                CAPTURE(mu);
                CAPTURE(result.statistic);
                CAPTURE(result.degrees_of_freedom);
                CHECK(result.p_value > five_sigma_p_value);
            }
}

TEST_CASE("a clear frosted sheet keeps all light and is reciprocal through and back") {
    for (const float roughness : {0.1f, 0.4f, 1.0f}) {
        const Bsdf sheet = FrostedPane{.roughness = roughness};
        for (const float mu : cosines) {
            const RunningMean albedo = measure_albedo(sheet, direction(mu), 54).g;
            CAPTURE(roughness);
            CAPTURE(mu);
            CAPTURE(albedo.mean());
            CHECK(albedo.agrees_with(1, 1e-3));  // the table's error
        }
        for (uint64_t i = 0; i < 200; ++i) {
            const Vec3 a = sample_cosine_hemisphere(uniform_2d(55, i, 0));
            const Vec3 b = sample_cosine_hemisphere(uniform_2d(55, i, 2));
            const float ab = evaluate(sheet, a, b).f_cos.g / b.z, ba = evaluate(sheet, b, a).f_cos.g / a.z;
            CHECK(std::abs(ab - ba) <= 1e-4f * std::max(ab, 1e-2f));
            const float through = evaluate(sheet, a, turned_over(b)).f_cos.g / b.z;
            const float back = evaluate(sheet, b, turned_over(a)).f_cos.g / a.z;
            CHECK(std::abs(through - back) <= 1e-4f * std::max(through, 1e-2f));
        }
    }
}

TEST_CASE("samples of a frosted sheet follow its pdf, and as much passes as through a clear one") {
    for (const float roughness : {0.2f, 0.6f, 1.0f})
        for (const float mu : {1.0f, 0.6f, 0.15f}) {
            const Vec3 wo = direction(mu, 0.4f);
            const ChiSquare result =
                test_samples(FrostedPane{.roughness = roughness}, wo, 56, -wo, 0.3 * roughness * roughness);
            CAPTURE(roughness);
            CAPTURE(mu);
            CAPTURE(result.statistic);
            CAPTURE(result.degrees_of_freedom);
            CHECK(result.p_value > five_sigma_p_value);
        }
    const Rgb passed = [] {
        const PreparedBsdf sheet = prepare(FrostedPane{.tint = Rgb(1, 0.5f, 0), .roughness = 0.1f}, direction(0.8f));
        Rgb sum;
        for (uint64_t i = 0; i < 100'000; ++i)
            if (const auto s = sample(sheet, uniform(57, i, 0), uniform_2d(57, i, 1)); s && s->transmitted)
                sum += s->weight / 100'000;
        return sum;
    }();
    const float clear = 1 - pane_reflectance(0.8f, 1.5f);
    CHECK(passed.r ==
          doctest::Approx(clear).epsilon(0.01).scale(0));  // 5 sigma of the count and the slope of the reflectance
    CHECK(passed.g == doctest::Approx(clear / 2).epsilon(0.01).scale(0));
    CHECK(passed.b == 0);
}

TEST_CASE("samples of glass carry the pdf and the weight that evaluation gives, also at the edges") {
    const float last = 1 - 0x1p-24f;
    for (const float roughness : {0.1f, 0.5f, 1.0f})
        for (const Bsdf& bsdf :
             {Bsdf(Glass{.roughness = roughness}), Bsdf(Glass{.roughness = roughness, .eta = 1 / 1.5f}),
              Bsdf(Glass{.roughness = roughness, .eta = 1}), Bsdf(FrostedPane{.roughness = roughness})}) {
            if (!is_delta(prepare(bsdf, {0, 0, 1}))) check_samples_agree_with_evaluation(bsdf, 58);
            for (const float mu : {1.0f, 1.0000001f, 1e-3f, 1e-7f, 1e-20f}) {
                const PreparedBsdf seen = prepare(bsdf, Vec3(std::sqrt(std::max(0.0f, 1 - mu * mu)), 0, mu));
                for (const float lobe : {0.0f, 0.5f, last})
                    for (const Vec2 u :
                         {Vec2{0, 0}, Vec2{0.5f, 0.5f}, Vec2{last, last}, Vec2{0, last}, Vec2{last, 0}}) {
                        const auto s = sample(seen, lobe, u);
                        if (!s) continue;
                        CHECK(is_finite(s->wi));
                        CHECK(is_finite(s->weight));
                    }
                for (const float nu : {1.0f, -1.0f, 0.5f, -0.5f, 1e-7f, -1e-7f}) {
                    const BsdfValue value = evaluate(seen, direction(nu, 1));
                    CHECK(is_finite(value.f_cos));
                    CHECK(std::isfinite(value.pdf));
                }
            }
        }
}
