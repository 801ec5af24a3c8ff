#include "renderer/rain/drop_size.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace pluvia;

namespace {

// Simpson's rule on the definition; 20000 steps leave an error far below 1e-11 for these integrands.
double integral(double intensity, double order, double d1, double d2) {
    const double beta = 4100 * std::pow(intensity, -0.21);
    const int steps = 20000;
    const double h = (d2 - d1) / steps;
    double sum = 0;
    for (int i = 0; i <= steps; ++i) {
        const double d = d1 + i * h;
        sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * std::pow(d, order) * std::exp(-beta * d);
    }
    return 8e6 * sum * h / 3;
}

}  // namespace

TEST_CASE("moments of the drop sizes equal the integrals they stand for") {
    const double intervals[][2] = {{0.1e-3, 6e-3}, {0.1e-3, 0.2e-3}, {1e-3, 1.01e-3}, {3.2e-3, 6e-3}, {5.9e-3, 6e-3}};
    for (double intensity : {0.001, 0.1, 1.0, 10.0, 100.0, 500.0, 1000.0})
        for (const auto& [d1, d2] : intervals) {
            CAPTURE(intensity);
            CAPTURE(d1);
            CAPTURE(d2);
            // Quadrature and incomplete gammas both round at 1e-16, magnified by the narrowest interval's 1 %.
            const auto agrees = [&](double value, double expected) {
                CAPTURE(value);
                CAPTURE(expected);
                return std::abs(value - expected) <= 1e-10 * expected;
            };
            CHECK(agrees(number_density(intensity, d1, d2), integral(intensity, 0, d1, d2)));
            CHECK(agrees(size_moment(intensity, 0, d1, d2), integral(intensity, 0, d1, d2)));
            CHECK(agrees(size_moment(intensity, 7, d1, d2), integral(intensity, 7, d1, d2)));
            CHECK(agrees(extinction(intensity, d1, d2), std::numbers::pi / 4 * integral(intensity, 2, d1, d2)));
            CHECK(agrees(rain_rate(intensity, d1, d2), std::numbers::pi / 6 * 130 * integral(intensity, 3.5, d1, d2)));
        }
}

TEST_CASE("a narrow interval of diameters loses no digits of number and extinction") {
    const double d1 = 1e-3, width = 1e-10, beta = size_slope(10), middle = d1 + width / 2;
    const double number = 8e6 * std::exp(-beta * middle) * width;  // constant over the interval to 1e-14
    // d1 + width is itself rounded: 2e-19 of 1e-10.
    CHECK(number_density(10, d1, d1 + width) == doctest::Approx(number).epsilon(1e-8).scale(0));
    const double disk = std::numbers::pi / 4 * middle * middle;
    CHECK(extinction(10, d1, d1 + width) == doctest::Approx(number * disk).epsilon(1e-8).scale(0));
}

TEST_CASE("drop numbers agree with the published distribution at 10 mm/h") {
    // beta = 4.1 * 10^-0.21 per mm, by hand: 2.528; the numbers have four digits.
    CHECK(size_slope(10) == doctest::Approx(2528).epsilon(2e-4));
    CHECK(number_density(10) == doctest::Approx(2458).epsilon(3e-4));
    CHECK(number_density(10, 1e-3) == doctest::Approx(253).epsilon(2e-3));
    CHECK(fall_speed(1e-3) == doctest::Approx(4.111).epsilon(1e-4));
    // Without truncation, sigma = pi N0 / (2 beta^3).
    const double sigma = std::numbers::pi * 8e6 / (2 * std::pow(size_slope(10), 3));
    CHECK(extinction(10, 0, 1) == doctest::Approx(sigma).epsilon(1e-12).scale(0));
}

TEST_CASE("the untruncated water flux is 1.260 I^0.945 mm/h") {
    for (double intensity : {0.1, 1.0, 10.0, 100.0, 500.0}) {
        CAPTURE(intensity);
        const double mm_per_h = rain_rate(intensity, 0, 1) / metres_per_second_from_mm_per_h(1);
        CHECK(mm_per_h ==
              doctest::Approx(1.260 * std::pow(intensity, 0.945)).epsilon(4e-4).scale(0));  // 1.260 has four digits
    }
}

TEST_CASE("parts of the size range add up to the whole") {
    for (double cut : {0.2e-3, 1e-3, 2.7e-3, 5e-3}) {
        CAPTURE(cut);
        CHECK(number_density(50, smallest_drop, cut) + number_density(50, cut) ==
              doctest::Approx(number_density(50)).epsilon(1e-13).scale(0));
        CHECK(extinction(50, smallest_drop, cut) + extinction(50, cut) ==
              doctest::Approx(extinction(50)).epsilon(1e-13).scale(0));
        CHECK(rain_rate(50, smallest_drop, cut) + rain_rate(50, cut) ==
              doctest::Approx(rain_rate(50)).epsilon(1e-12).scale(0));
    }
}

TEST_CASE("no rain has no drops, and vanishing rain stays finite") {
    for (double intensity : {0.0, -1.0}) {
        CHECK(number_density(intensity) == 0);
        CHECK(extinction(intensity) == 0);
        CHECK(rain_rate(intensity) == 0);
    }
    for (double intensity : {1e-300, 1e-6, 1e-3}) {
        CAPTURE(intensity);
        CHECK(std::isfinite(number_density(intensity)));
        CHECK(std::isfinite(extinction(intensity)));
        CHECK(std::isfinite(rain_rate(intensity)));
    }
    CHECK(number_density(10, 2e-3, 1e-3) == 0);
}

TEST_CASE("an intensity that is not a number or above 1000 mm/h is a usage error") {
    CHECK_NOTHROW(check_intensity(0));
    CHECK_NOTHROW(check_intensity(1000));
    CHECK_THROWS_AS(check_intensity(1000.1), Error);
    CHECK_THROWS_AS(check_intensity(std::numeric_limits<double>::quiet_NaN()), Error);
    CHECK_THROWS_AS(check_intensity(std::numeric_limits<double>::infinity()), Error);
}
