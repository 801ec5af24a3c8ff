// Light from infinitely far: where a picture's texels lie, and which pictures are accepted.
// Its samples are tested in environment_sampling_test.cpp.
#include "shaders/environment.h"

#include "renderer/core/error.h"
#include "tests/environments.h"

#include <doctest/doctest.h>

#include <limits>
#include <numbers>

using namespace pluvia;

TEST_CASE("azimuths run from north = -Z clockwise over east = +X") {
    const auto near = [](Vec3d a, Vec3d b) { return length(a - b) < 1e-15; };
    CHECK(near(direction_from_azimuth(0, 0), {0, 0, -1}));
    CHECK(near(direction_from_azimuth(std::numbers::pi / 2, 0), {1, 0, 0}));
    CHECK(near(direction_from_azimuth(std::numbers::pi, 0), {0, 0, 1}));
    CHECK(near(direction_from_azimuth(1.0, std::numbers::pi / 2), {0, 1, 0}));
}

TEST_CASE("a direction meets the same texel as in Cycles") {
    // Texel positions seen by Cycles 3.4 in a picture of 64 x 32 texels that holds its own coordinates; the camera's
    // pixel was 0.03 texels wide.
    struct Seen {
        Vec3 direction;
        float x, y;
    };
    const Seen seen[] = {{{0.3f, 0.2f, -0.9f}, 19.243f, 13.895f},  {{0.9f, 0.1f, 0.2f}, 34.194f, 14.911f},
                         {{-0.2f, -0.6f, 0.8f}, 50.454f, 22.418f}, {{0.5f, 0.7f, 0.5f}, 39.953f, 8.063f},
                         {{-0.9f, 0.3f, -0.3f}, 3.242f, 12.891f},  {{0.2f, 0, -1}, 17.977f, 16.011f}};
    Image<Rgb> picture(64, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) picture.at(x, y) = {float(x) + 0.5f, float(y) + 0.5f, 0};
    const Environment environment(picture);
    for (const Seen& s : seen) {
        CAPTURE(s.x);
        const Rgb texel = environment.radiance(normalize(s.direction));
        CHECK(std::abs(texel.r - s.x) < 0.06f);
        CHECK(std::abs(texel.g - s.y) < 0.06f);
    }
}

TEST_CASE("the picture goes on smoothly where its left and right edge meet") {
    const Environment environment(rough_picture(16, 8));
    for (float y : {-0.9f, -0.3f, 0.2f, 0.7f}) {
        const float radius = std::sqrt(1 - y * y);
        const Rgb before = environment.radiance(normalize(Vec3(-radius, y, -1e-6f)));
        const Rgb behind = environment.radiance(normalize(Vec3(-radius, y, 1e-6f)));
        CHECK(std::abs(before.g - behind.g) < 1e-4f);  // slope below 16 per radian over 2e-6 radians, and rounding
    }
}

TEST_CASE("an environment without light is black and never sampled") {
    Environment dimmed(rough_picture(8, 4), {small_sun()});
    CHECK(!dimmed.is_black());
    dimmed.multiply(0);
    for (const Environment& environment :
         {Environment(), Environment(Image<Rgb>(8, 4)), Environment::uniform(Rgb(0)), dimmed}) {
        CHECK(environment.is_black());
        CHECK(is_black(environment.radiance({0, 1, 0})));
        CHECK(environment.pdf({0, 1, 0}) == 0);
        CHECK(environment.sample({0.5f, 0.5f}, 0.5f).pdf == 0);
        CHECK(is_black(environment.sample({0.5f, 0.5f}, 0.5f).radiance));
        CHECK(environment.horizontal_illuminance() == 0);
    }
    CHECK(!Environment(Image<Rgb>(8, 4), {small_sun()}).is_black());
}

TEST_CASE("brightness scales and directions stay") {
    Environment environment(rough_picture(33, 17), {small_sun()});
    const Environment before = environment;
    environment.multiply(float(50000 / environment.horizontal_illuminance()));
    CHECK(environment.horizontal_illuminance() == doctest::Approx(50000).epsilon(1e-6));
    const float factor = luminance(environment.mean_radiance()) / luminance(before.mean_radiance());
    for (int i = 0; i < 100; ++i) {
        const EnvironmentSample a = draw(environment, 61, i), b = draw(before, 61, i);
        CHECK(a.wi == b.wi);
        CHECK(a.pdf == b.pdf);
        CHECK(a.radiance.g == doctest::Approx(b.radiance.g * factor).epsilon(1e-5).scale(0));
    }
}

TEST_CASE("pictures are checked when they come in") {
    Image<Rgb> picture(4, 2, Rgb(1));
    CHECK_THROWS_AS(Environment(Image<Rgb>()), Error);
    picture.at(1, 1).g = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH_AS(Environment{picture}, doctest::Contains("(1, 1)"), Error);
    picture.at(1, 1).g = std::numeric_limits<float>::infinity();
    CHECK_THROWS_AS(Environment{picture}, Error);
    picture.at(1, 1).g = -1;  // as resampling leaves it
    CHECK(Environment(picture).radiance(direction_from_equirectangular(1.5 / 4, 1.5 / 2)).g < 1e-5f);
}

TEST_CASE("directions close to a pole and on the seam have finite radiance and pdf") {
    const Environment environment(rough_picture(33, 17), {small_sun()});
    for (const Vec3 d : {Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(-1, 0, 0.0f), Vec3(-1, 0, -0.0f), Vec3(1e-20f, 1, -1e-20f),
                         Vec3(-1, 1e-30f, 1e-30f)}) {
        CHECK(is_finite(environment.radiance(d)));
        CHECK(std::isfinite(environment.pdf(d)));
    }
}
