#include "shaders/raindrop.h"

#include "renderer/core/sampling.h"
#include "shaders/fresnel.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <numbers>
#include <numeric>

using namespace pluvia;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Share of light that a drop turns by an angle between two bounds, in degrees.
double share_between(double low, double high) {
    constexpr int steps = 20000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double theta = (low + (high - low) * (i + 0.5) / steps) * degree;
        sum += double(drop_phase(float(std::cos(theta)))) * std::sin(theta);
    }
    return sum * 2 * std::numbers::pi * (high - low) * degree / steps;
}

/// Share of light that enters and leaves again at once.
double mean_transmission(double incidence) {
    const Reflectance<double> r = fresnel_dielectric(std::cos(incidence), double(water_ior));
    return ((1 - r.s) * (1 - r.s) + (1 - r.p) * (1 - r.p)) / 2;
}

/// Phase function of light that is reflected outside: b = cos(theta / 2) makes b db / (sin(theta) dtheta) = 1/4.
double reflected_phase(double theta) {
    return fresnel_dielectric(std::sin(theta / 2), double(water_ior)).mean() / (4 * std::numbers::pi);
}
/// Phase function of light that passes straight through, theta < 82.79 degrees.
double transmitted_phase(double theta) {
    constexpr double n = water_ior;
    const double tan_i = n * std::sin(theta / 2) / (n * std::cos(theta / 2) - 1), i = std::atan(tan_i);
    const double b = std::sin(i), cos_t = std::sqrt(1 - b * b / (n * n));
    const double slope = 2 * (1 / std::cos(i) - 1 / (n * cos_t));
    return mean_transmission(i) * b / (std::numbers::pi * std::sin(theta) * slope);
}

}  // namespace

TEST_CASE("a drop absorbs no light, whichever way it is met") {
    for (int i = 0; i <= 1000; ++i) {
        const DropPaths paths = drop_paths(i * std::numbers::pi / 2000);
        const double sum = std::accumulate(paths.weight.begin(), paths.weight.end(), 0.0);
        CAPTURE(i);
        CHECK(sum == doctest::Approx(1).scale(0).epsilon(1e-12));
    }
}

TEST_CASE("the paths of a ray through a drop have the weights and turns of a hand calculation") {
    // Distance from the axis in radii; weights of outer reflection, passage and one inner reflection; turns in degrees.
    const double rows[][7] = {
        {0, .0204, .9597, .0196, 180, 0, 180},          {0.4, .0207, .9590, .0198, 132.8, 12.2, 157.3},
        {0.6, .0231, .9545, .0216, 106.3, 20.2, 146.7}, {0.8, .0391, .9248, .0333, 73.7, 32.5, 138.7},
        {0.95, .1572, .7187, .0987, 36.4, 52.7, 141.8}, {0.99, .4220, .3455, .1326, 16.2, 67.9, 151.9}};
    for (const auto& row : rows) {
        CAPTURE(row[0]);
        const DropPaths paths = drop_paths(std::asin(row[0]));
        for (int order = 0; order < 3; ++order) {
            CAPTURE(order);
            CHECK(std::abs(paths.weight[order] - row[1 + order]) < 0.6e-4);                            // as printed
            CHECK(std::abs(std::acos(std::cos(paths.turn[order])) / degree - row[4 + order]) < 0.06);  // as printed
        }
    }
}

TEST_CASE("the phase function of a drop integrates to one") {
    RunningMean mean;
    for (uint64_t i = 0; i < 500'000; ++i)
        mean.add(double(drop_phase(sample_sphere(uniform_2d(1, i, 0)).z)) / pdf_sphere);
    CAPTURE(mean.mean());
    CHECK(mean.agrees_with(1));
    // The grid of this sum is 111 times finer than the bins: it errs at their edges by less than 1e-4.
    CHECK(share_between(0, 180) == doctest::Approx(1).scale(0).epsilon(1e-4));
}

TEST_CASE("reflected and transmitted light follow their closed forms") {
    // Below 30 degrees and from 50 to 60 no more than 0.3 % comes from inner reflections.
    for (double theta = 1.0; theta < 60; theta += 0.5) {
        if (theta > 30 && theta < 50) continue;  // the third rainbow, at 42 degrees
        CAPTURE(theta);
        // The middle of a bin of 0.25 degrees.
        const double middle = (theta + 0.125) * degree, expected = reflected_phase(middle) + transmitted_phase(middle);
        CHECK(double(drop_phase(float(std::cos(middle)))) == doctest::Approx(expected).scale(0).epsilon(0.01));
    }
    // Next to the first rainbow, in Alexander's band, only 5 % are not reflected outside. Towards the second one light
    // of four and more inner reflections adds up to a quarter.
    for (double theta = 134.5; theta < 137.5; theta += 0.5) {
        CAPTURE(theta);
        const double middle = (theta + 0.125) * degree;
        CHECK(double(drop_phase(float(std::cos(middle)))) ==
              doctest::Approx(reflected_phase(middle)).scale(0).epsilon(0.05));
    }
    const double passage = water_ior / (2 * (water_ior - 1));
    const double forward = passage * passage * mean_transmission(0) / std::numbers::pi + reflected_phase(0);
    CHECK(double(drop_phase(1)) == doctest::Approx(forward).scale(0).epsilon(0.01));
}

TEST_CASE("a drop sends light where ray tracing found it") {
    // Bounds of the turn angle in degrees and the share between them. Tolerance: the table is rounded to 0.0001, and
    // the 0.0005 of light that is reflected inside six times or more goes one way here.
    const double rows[][3] = {{0, 10, .1124},   {10, 20, .2422},   {20, 30, .2336},   {30, 40, .1689},
                              {40, 50, .1036},  {50, 60, .0523},   {60, 70, .0205},   {70, 80, .0056},
                              {80, 130, .0163}, {130, 140, .0150}, {140, 150, .0194}, {150, 180, .0101}};
    for (const auto& row : rows) {
        CAPTURE(row[0]);
        CAPTURE(share_between(row[0], row[1]));
        CHECK(std::abs(share_between(row[0], row[1]) - row[2]) < 0.0006);
    }
}

TEST_CASE("the rainbow of a drop stands at 138 degrees") {
    double brightest = 0, angle = 0;
    for (double theta = 120; theta < 170; theta += 0.05) {
        const double phase = drop_phase(float(std::cos(theta * degree)));
        if (phase > brightest) brightest = phase, angle = theta;
    }
    CHECK(std::abs(angle - 137.92) < 0.3);  // Descartes' angle for this index; a bin is 0.25 degrees wide
    CHECK(brightest > 2 * drop_phase(float(std::cos(142 * degree))));
}

TEST_CASE("the mean cosine of a drop is 0.7685") {
    CHECK(std::abs(drop_asymmetry() - 0.7685) < 0.002);
    RunningMean mean;
    const Vec3 direction = normalize(Vec3(0.3f, -0.5f, 0.2f));
    for (uint64_t i = 0; i < 200'000; ++i) mean.add(dot(direction, sample_drop_phase(direction, uniform_2d(2, i, 0))));
    CHECK(mean.agrees_with(drop_asymmetry()));
}

TEST_CASE("directions drawn from a drop follow its phase function") {
    const Vec3 axes[] = {{0, 0, 1}, normalize(Vec3(-1, 2, -0.5f))};
    for (const Vec3 direction : axes) {
        const auto sample = [&](uint64_t i) {
            return std::optional(sample_drop_phase(direction, uniform_2d(3, i, 0)));
        };
        const auto pdf = [&](Vec3 w) { return double(drop_phase(dot(direction, w))); };
        // Rings as fine as the bins, whose steps would be overlooked within wider ones.
        const SphereGrid grid = {.axis = direction, .width = 0.5, .rings = 400, .azimuths = 4};
        const ChiSquare result = test_directions(sample, pdf, 400'000, grid);
        CAPTURE(result.statistic);
        CAPTURE(result.degrees_of_freedom);
        CHECK(result.p_value > five_sigma_p_value);
    }
}

TEST_CASE("directions at the ends of a drop's phase function are finite and of unit length") {
    const float last = 1 - 0x1p-24f;
    for (const Vec2 u : {Vec2{0, 0}, Vec2{last, last}, Vec2{0, last}, Vec2{last, 0}}) {
        const Vec3 w = sample_drop_phase({0, 1, 0}, u);
        CHECK(length(w) == doctest::Approx(1).scale(0).epsilon(1e-6));
        CHECK(drop_phase(w.y) > 0);
    }
    CHECK(drop_phase(1.0000002f) == drop_phase(1));  // dot products of unit vectors round past one
    CHECK(drop_phase(-1.0000002f) == drop_phase(-1));
}
