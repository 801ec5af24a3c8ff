// Samples of light from infinitely far: that they follow their pdf and find all the light.
#include "shaders/sky.h"
#include "tests/environments.h"
#include "tests/skies.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <numbers>
#include <vector>

using namespace pluvia;

namespace {

constexpr double pi_d = std::numbers::pi;

Image<Rgb> one_bright_texel(int width, int height, int x, int y) {
    Image<Rgb> picture(width, height);
    picture.at(x, y) = {300, 200, 100};
    return picture;
}

/// Solid angle of a texel in row y.
double texel_solid_angle(int width, int height, int y) {
    return 2 * pi_d / width * (std::cos(pi_d * y / height) - std::cos(pi_d * (y + 1) / height));
}

bool in_disc(const Disc& sun, Vec3 direction) {
    return length(cross(direction, sun.direction)) < std::sin(sun.angular_radius) && dot(direction, sun.direction) > 0;
}

/// p-value of samples of one environment, counted per texel and in the disc, against the integral of the pdf of another
/// over each. The pdf of a picture is constant within a texel, so that its integral is exact.
double p_value_of_samples(const Environment& sampled, const Environment& environment, int width, int height,
                          uint64_t seed, int count) {
    const bool has_sun = !environment.discs().empty();
    const Disc sun = has_sun ? environment.discs()[0] : Disc();
    std::vector<double> expected(size_t(width) * height + 1), found(expected.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec3 centre = direction_from_equirectangular((x + 0.5) / width, (y + 0.5) / height);
            REQUIRE(!(has_sun && in_disc(sun, centre)));
            expected[size_t(y) * width + x] = double(environment.pdf(centre)) * texel_solid_angle(width, height, y);
        }
    if (has_sun) {
        // What the picture's own strategy sends into the disc counts there, and not in the texel around it.
        const double in_sun = double(environment.pdf(sun.direction)) * sun.solid_angle();
        const Vec2 uv = equirectangular_from_direction(sun.direction);
        double& texel = expected[size_t(uv.y * float(height)) * width + size_t(uv.x * float(width))];
        texel -= texel * sun.solid_angle() / texel_solid_angle(width, height, int(uv.y * float(height)));
        expected.back() = in_sun;
    }
    for (int i = 0; i < count; ++i) {
        const EnvironmentSample s = draw(sampled, seed, i);
        const Vec2 uv = equirectangular_from_direction(s.wi);
        const int x = std::min(int(uv.x * float(width)), width - 1);
        const int y = std::min(int(uv.y * float(height)), height - 1);
        ++found[has_sun && in_disc(sun, s.wi) ? found.size() - 1 : size_t(y) * width + x];
    }
    for (double& e : expected) e *= count;
    const ChiSquare test = chi_square_test(found, expected);
    REQUIRE(test.degrees_of_freedom > 0);
    return test.p_value;
}
bool samples_follow_pdf(const Environment& environment, int width, int height, uint64_t seed, int count) {
    return p_value_of_samples(environment, environment, width, height, seed, count) > five_sigma_p_value;
}

}  // namespace

TEST_CASE("samples of a picture follow their pdf") {
    SUBCASE("one bright texel") {
        CHECK(samples_follow_pdf(Environment(one_bright_texel(32, 16, 5, 6)), 32, 16, 1, 200000));
    }
    SUBCASE("a bright texel at the zenith and on the edge") {
        CHECK(samples_follow_pdf(Environment(one_bright_texel(32, 16, 31, 0)), 32, 16, 2, 200000));
    }
    SUBCASE("steps and zeros") {
        CHECK(samples_follow_pdf(Environment(rough_picture(33, 17)), 33, 17, 3, 400000));
    }
    SUBCASE("steps, zeros and a sun") {
        CHECK(samples_follow_pdf(Environment(rough_picture(33, 17), {small_sun()}), 33, 17, 4, 400000));
    }
    SUBCASE("a single texel") {
        CHECK(samples_follow_pdf(Environment(Image<Rgb>(1, 1, Rgb(2)), {small_sun()}), 1, 1, 5, 200000));
    }
}

TEST_CASE("samples of a clear sky with sun and moon follow their pdf") {
    SkySettings settings;
    settings.sun_elevation = 0.06;
    settings.moon = Moon{.elevation = 0.3, .azimuth = 4, .phase_angle = 1};
    const Environment environment = make_sky(standard_sky_tables(), settings);
    REQUIRE(environment.discs().size() == 2);
    // Cells of 32 x 32 texels, and the discs, which are larger than a texel and left out of the cells around them.
    constexpr int width = 1024, height = 512, columns = 32, rows = 16, points = 3;
    const auto cell_of = [&](Vec3 direction, double u, double v) {
        for (size_t i = 0; i < 2; ++i)
            if (in_disc(environment.discs()[i], direction)) return columns * rows + int(i);
        return std::min(int(v * rows), rows - 1) * columns + std::min(int(u * columns), columns - 1);
    };
    std::vector<double> expected(columns * rows + 2), found(expected.size());
    double total = 0;
    for (int y = 0; y < height * points; ++y)
        for (int x = 0; x < width * points; ++x) {
            const double u = (x + 0.5) / (width * points), v = (y + 0.5) / (height * points);
            const Vec3 direction = direction_from_equirectangular(u, v);
            const int cell = cell_of(direction, u, v);
            if (cell < columns * rows)
                expected[size_t(cell)] +=
                    double(environment.pdf(direction)) * texel_solid_angle(width * points, height * points, y);
        }
    for (size_t i = 0; i < 2; ++i) {
        const Disc& disc = environment.discs()[i];
        const ShadingBasis basis(disc.direction);
        for (int k = 0; k < 1000; ++k)
            expected[columns * rows + i] +=
                double(environment.pdf(basis.to_world(sample_cone(
                    {unit_float(hash_key(71, k)), unit_float(hash_key(72, k))}, 0.999f * disc.one_minus_cos())))) *
                disc.solid_angle() / 1000;
    }
    for (const double e : expected) total += e;
    CHECK(total == doctest::Approx(1).epsilon(1e-4));
    const int count = 2000000;
    for (int i = 0; i < count; ++i) {
        const EnvironmentSample s = draw(environment, 6, i);
        const Vec2 uv = equirectangular_from_direction(s.wi);
        ++found[size_t(cell_of(s.wi, uv.x, uv.y))];
    }
    for (double& e : expected) e *= count / total;
    CHECK(chi_square_test(found, expected).p_value > five_sigma_p_value);
}

TEST_CASE("samples of a uniform environment are uniform") {
    CHECK(samples_follow_pdf(Environment::uniform({1, 2, 3}), 32, 16, 7, 400000));
}

TEST_CASE("samples that do not follow the pdf are found out") {
    // Guards the tests above: the pdf of a picture in which one texel of 561 is brighter.
    Image<Rgb> picture = rough_picture(33, 17);
    const Environment sampled(picture);
    picture.at(10, 8) += Rgb(100);
    CHECK(p_value_of_samples(sampled, Environment(picture), 33, 17, 3, 400000) < five_sigma_p_value);
}

TEST_CASE("the pdf integrates to one") {
    const auto integral = [](const Environment& environment, int width, int height) {
        double sum = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                sum += double(environment.pdf(direction_from_equirectangular((x + 0.5) / width, (y + 0.5) / height))) *
                       texel_solid_angle(width, height, y);
        return sum;
    };
    CHECK(integral(Environment::uniform(Rgb(1)), 8, 4) == doctest::Approx(1).epsilon(1e-6));
    CHECK(integral(Environment(one_bright_texel(32, 16, 5, 6)), 32, 16) == doctest::Approx(1).epsilon(1e-6));
    CHECK(integral(Environment(rough_picture(33, 17)), 33, 17) == doctest::Approx(1).epsilon(1e-6));
    // The disc lies between texel centres; it adds its part beyond the density of the picture around it.
    const Environment environment(rough_picture(33, 17), {small_sun()});
    const Disc& sun = environment.discs()[0];
    const Vec3 beside = normalize(sun.direction + Vec3(0, 1.5f * sun.angular_radius, 0));
    const double disc = (double(environment.pdf(sun.direction)) - environment.pdf(beside)) * sun.solid_angle();
    CHECK(integral(environment, 33, 17) + disc == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("sampling finds the light that quadrature finds") {
    // Mean radiance and illuminance from above, by the midpoint rule with several points per texel.
    SkySettings settings;
    settings.sun_elevation = 0.3;
    const auto check = [](const Environment& environment, int width, int height, int points, uint64_t seed) {
        const Disc sun = environment.discs().empty() ? Disc() : environment.discs()[0];
        double mean = luminance(sun.mean_radiance()) * double(sun.solid_angle()) / (4 * pi_d);
        double illuminance = environment.disc_illuminance();
        const int rows = height * points, columns = width * points;
        for (int y = 0; y < rows; ++y) {
            const double solid_angle = texel_solid_angle(columns, rows, y);
            for (int x = 0; x < columns; ++x) {
                const Vec3 direction = direction_from_equirectangular((x + 0.5) / columns, (y + 0.5) / rows);
                const Rgb disc = sun.radiance(direction);
                const double sky = luminance(environment.radiance(direction) - disc);
                mean += sky * solid_angle / (4 * pi_d);
                illuminance += sky * solid_angle * std::max(0.0f, direction.y);
            }
        }
        const int count = 400000;
        RunningMean total, from_above;
        for (int i = 0; i < count; ++i) {
            const EnvironmentSample s = draw(environment, seed, i);
            REQUIRE(s.pdf > 0);
            const double weight = luminance(s.radiance) / s.pdf;
            total.add(weight / (4 * pi_d));
            from_above.add(weight * std::max(0.0f, s.wi.y));
        }
        CAPTURE(mean);
        CAPTURE(total.mean());
        CAPTURE(illuminance);
        CAPTURE(from_above.mean());
        // 1e-4: error of the quadrature, and of the rim of the disc in single precision.
        CHECK(total.agrees_with(mean, 1e-4 * mean));
        CHECK(from_above.agrees_with(illuminance, 1e-4 * illuminance));
        // The members take the interpolant as constant within a texel, which shows in coarse pictures.
        CHECK(luminance(environment.mean_radiance()) ==
              doctest::Approx(mean).epsilon(width > 100 ? 1e-4 : 0.01).scale(0));
        CHECK(environment.horizontal_illuminance() ==
              doctest::Approx(illuminance).epsilon(width > 100 ? 1e-3 : 0.03).scale(0));
    };
    check(make_sky(standard_sky_tables(), settings), 1024, 512, 2, 11);
    check(Environment(rough_picture(33, 17), {small_sun()}), 33, 17, 16, 12);
    check(Environment(one_bright_texel(32, 16, 5, 6)), 32, 16, 16, 13);
    check(Environment::uniform({1, 2, 3}), 32, 16, 4, 14);
}

TEST_CASE("a sample carries the radiance and pdf of its direction") {
    const Environment environment(rough_picture(33, 17), {small_sun()});
    int in_another_cell = 0;
    for (int i = 0; i < 10000; ++i) {
        const EnvironmentSample s = draw(environment, 21, i);
        const Rgb seen = environment.radiance(s.wi), difference = s.radiance - seen;
        // A direction is known to 1e-7 of a turn: that is 3e-6 texels, which differ by up to 1000 in red.
        CHECK(std::abs(luminance(difference)) <= 3e-3f);
        in_another_cell += s.pdf != environment.pdf(s.wi);
        CHECK(std::abs(length(s.wi) - 1) < 1e-6f);
    }
    CHECK(in_another_cell <= 1);  // rounding moves one point of 1e5 across a border
}

TEST_CASE("no light of a picture has zero pdf") {
    const Environment environment(one_bright_texel(32, 16, 31, 15));
    int lit = 0;
    for (int i = 0; i < 100000; ++i) {
        const Vec3 direction = sample_sphere({unit_float(hash_key(31, i)), unit_float(hash_key(32, i))});
        if (is_black(environment.radiance(direction))) continue;
        ++lit;
        CHECK(environment.pdf(direction) > 0);
    }
    CHECK(lit > 100);
}

TEST_CASE("no sample of a picture weighs more than sixteen times the mean") {
    // In the outer corner of a bright texel's diagonal neighbour the interpolant is 1/4 of the texel's light, its mean
    // over that neighbour 1/64: that is the worst case, and it bounds the noise.
    const Environment environment(one_bright_texel(64, 32, 20, 16));
    const double mean = 4 * pi_d * luminance(environment.mean_radiance());
    for (int i = 0; i < 100000; ++i) {
        const EnvironmentSample s = draw(environment, 41, i);
        CHECK(luminance(s.radiance) / s.pdf <= 16.2 * mean);  // 1 % for the spread of solid angle and rounding
    }
}

TEST_CASE("the sun's disc contains the directions sampled in it") {
    const Environment environment(Image<Rgb>(4, 2), {small_sun()});
    int outside = 0;
    const int count = 100000;
    for (int i = 0; i < count; ++i) outside += is_black(draw(environment, 51, i).radiance);
    CHECK(outside < count * 1e-4);  // 5e-5 of the disc's area lies within single precision of its rim
}
