#include "tests/bsdf_checks.h"

#include "renderer/core/sampling.h"

#include <doctest/doctest.h>

namespace pluvia {

Vec3 direction(float mu, float phi) {
    const float sine = std::sqrt((1 - mu) * (1 + mu));
    return {sine * std::cos(phi), sine * std::sin(phi), mu};
}

Albedo measure_albedo(const Bsdf& bsdf, Vec3 wo, uint64_t seed) {
    constexpr int lobes = 32, steps = 40;
    const PreparedBsdf prepared = prepare(bsdf, wo);
    Albedo albedo;
    uint64_t index = 0;
    for (int k = 0; k < lobes; ++k) {
        for (int i = 0; i < steps; ++i) {
            for (int j = 0; j < steps; ++j, ++index) {
                const Vec2 jitter = uniform_2d(seed, index, 0);
                const Vec2 u = {(float(i) + jitter.x) / steps, (float(j) + jitter.y) / steps};
                const auto s = sample(prepared, (float(k) + uniform(seed, index, 2)) / lobes, u);
                const Rgb weight = s ? s->weight : Rgb();
                albedo.r.add(weight.r);
                albedo.g.add(weight.g);
                albedo.b.add(weight.b);
            }
        }
    }
    return albedo;
}

ChiSquare test_samples(const Bsdf& bsdf, Vec3 wo, uint64_t seed, Vec3 axis, double width) {
    const PreparedBsdf prepared = prepare(bsdf, wo);
    const auto draw = [&](uint64_t i) -> std::optional<Vec3> {
        const auto s = sample(prepared, uniform(seed, i, 0), uniform_2d(seed, i, 1));
        return s ? std::optional(s->wi) : std::nullopt;
    };
    const auto pdf = [&](Vec3 wi) { return double(evaluate(prepared, wi).pdf); };
    return test_directions(draw, pdf, 200'000, {.axis = axis, .width = width, .rings = 40, .azimuths = 20});
}

void check_samples_agree_with_evaluation(const Bsdf& bsdf, uint64_t seed) {
    for (uint64_t i = 0; i < 100; ++i) {
        const PreparedBsdf prepared = prepare(bsdf, sample_cosine_hemisphere(uniform_2d(seed, i, 0)));
        const auto s = sample(prepared, uniform(seed, i, 2), uniform_2d(seed, i, 3));
        if (!s) continue;
        const BsdfValue value = evaluate(prepared, s->wi);
        CHECK(s->pdf == value.pdf);
        CHECK(s->weight.g * s->pdf == doctest::Approx(value.f_cos.g).epsilon(1e-6).scale(0));
        CHECK_FALSE(s->delta);
        CHECK(s->transmitted == (s->wi.z < 0));
        CHECK(length(s->wi) == doctest::Approx(1).epsilon(1e-6));
    }
}

}  // namespace pluvia
