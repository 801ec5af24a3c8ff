#include "shaders/microfacet.h"

#include "shaders/fresnel.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

using namespace pluvia;

namespace {

Vec3 direction(float mu, float phi = 0) {
    const float sine = std::sqrt((1 - mu) * (1 + mu));
    return {sine * std::cos(phi), sine * std::sin(phi), mu};
}

}  // namespace

TEST_CASE("Fresnel reflectance has its known values") {
    CHECK(fresnel_dielectric(1.0, 1.5).mean() == doctest::Approx(0.04).epsilon(1e-12).scale(0));
    CHECK(normal_reflectance(1.5f) == doctest::Approx(0.04).epsilon(1e-6).scale(0));
    CHECK(fresnel_dielectric(0.0, 1.5).mean() == 1.0);
    const double brewster = std::cos(std::atan(1.5));
    CHECK(fresnel_dielectric(brewster, 1.5).p == doctest::Approx(0).epsilon(1e-12));
    CHECK(fresnel_dielectric(brewster, 1.5).s ==
          doctest::Approx(0.1479289941).epsilon(1e-9).scale(0));  // (1.25/3.25)^2
    // The same from both sides of the interface, and total beyond the critical angle.
    const double cos_t = std::sqrt(1 - (1 - 0.5 * 0.5) / (1.5 * 1.5));
    CHECK(fresnel_dielectric(0.5, 1.5).s ==
          doctest::Approx(fresnel_dielectric(cos_t, 1 / 1.5).s).epsilon(1e-12).scale(0));
    CHECK(fresnel_dielectric(0.5, 1.5).p ==
          doctest::Approx(fresnel_dielectric(cos_t, 1 / 1.5).p).epsilon(1e-12).scale(0));
    CHECK(fresnel_dielectric(0.7, 1 / 1.5).mean() == 1.0);
    CHECK(fresnel_schlick(Rgb(0.2f), 0.5f, 1) == Rgb(0.2f));
    CHECK(fresnel_schlick(Rgb(0.2f), 0.5f, 0) == Rgb(0.5f));
}

TEST_CASE("refraction follows Snell's law and ends at the critical angle") {
    const Vec3 n = {0, 0, 1}, wo = direction(0.6f, 1);
    const auto wi = refract(wo, n, 1.5f);
    REQUIRE(wi);
    CHECK(length(*wi) == doctest::Approx(1).epsilon(1e-6));
    CHECK(wi->z == doctest::Approx(-std::sqrt(1 - 0.64 / 2.25)).epsilon(1e-6).scale(0));
    CHECK(wi->x == doctest::Approx(-wo.x / 1.5f).epsilon(1e-6).scale(0));
    CHECK(wi->y == doctest::Approx(-wo.y / 1.5f).epsilon(1e-6).scale(0));
    CHECK_FALSE(refract(direction(0.7f), n, 1 / 1.5f));
}

TEST_CASE("the GGX albedo table agrees with the closed form at alpha = 1") {
    // There D = 1/pi and masking_root = 1, so that E(mu) = 1 - mu log(1 + 1/mu) and 1 - E_avg = 4/3 log 2 - 1/3.
    const GgxAlbedoRow row(1);
    for (const float mu : {1.0f, 0.9f, 0.6f, 0.3f, 0.1f, 0.03f, 0.003f, 1e-4f}) {
        CAPTURE(mu);
        CHECK(std::abs(row.at(mu).lost - mu * std::log(1 + 1 / mu)) < 8e-4);  // the table's stated error
    }
    CHECK(average_ggx_albedo(1).lost == doctest::Approx(0.5908629).epsilon(1e-3));
}

TEST_CASE("the GGX albedo table agrees with samples at all roughness") {
    for (const float roughness : {min_roughness, 0.07f, 0.119f, 0.3f, 0.49f, 0.75f}) {
        const Ggx ggx(roughness * roughness);
        const GgxAlbedoRow row(roughness);
        for (const float mu : {0.999f, 0.5f, 0.1f, 0.02f, 1e-3f}) {
            const GgxView view(ggx, mu);
            const Vec3 wo = direction(mu);
            RunningMean lost, grazing;
            for (uint64_t i = 0; i < 40'000; ++i) {
                const Vec3 h = sample_visible_normal(ggx, wo, uniform_2d(11, i, 0));
                const float cos_h = dot(wo, h), mu_i = 2 * cos_h * h.z - mu;
                // G2 / G1: what a sample of visible normals returns.
                const float returned = mu_i > 0 ? visibility(ggx, view, mu_i) * mu_i * 2 * (mu + view.root) : 0;
                lost.add(1 - returned);
                grazing.add(returned * schlick_weight(cos_h));
            }
            CAPTURE(roughness);
            CAPTURE(mu);
            CAPTURE(lost.mean());
            CHECK(lost.agrees_with(row.at(mu).lost, 8e-4));  // the table's stated error
            CHECK(grazing.agrees_with(row.at(mu).grazing, 8e-4));
        }
    }
}
