#include "renderer/rain/drop_size.h"

#include "renderer/core/error.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

namespace pluvia {
namespace {

constexpr double kessler_speed = 130;  // m^0.5 / s

// Integral of t^(a-1) e^-t from 0 to x by its series, whose terms are all positive; for x < a + 1, where it is short.
// Source: Abramowitz and Stegun 1964, 6.5.29.
double lower_gamma_series(double a, double x) {
    double term = 1 / a, sum = term;
    for (int n = 1; term > sum * 1e-17; ++n) sum += term *= x / (a + n);
    return sum * std::exp(a * std::log(x) - x);
}

// Integral of t^(a-1) e^-t from x to infinity by its continued fraction; for x >= a + 1.
// Source: Abramowitz and Stegun 1964, 6.5.31, evaluated forwards by the algorithm of Lentz 1976.
double upper_gamma_fraction(double a, double x) {
    double b = x + 1 - a, c = std::numeric_limits<double>::infinity(), d = 1 / b, fraction = d;
    for (int n = 1; n < 1000; ++n) {
        const double an = n * (a - n);
        b += 2;
        d = 1 / (an * d + b);
        c = b + an / c;
        fraction *= c * d;
        if (std::abs(c * d - 1) < 1e-16) break;
    }
    return fraction * std::exp(a * std::log(x) - x);
}

// Integral of t^(a-1) e^-t from x1 to x2.
double gamma_between(double a, double x1, double x2) {
    const double turn = a + 1;
    if (x1 >= turn) return upper_gamma_fraction(a, x1) - upper_gamma_fraction(a, x2);
    const double below = x1 > 0 ? lower_gamma_series(a, x1) : 0;
    if (x2 < turn) return lower_gamma_series(a, x2) - below;
    return std::tgamma(a) - below - upper_gamma_fraction(a, x2);
}

}  // namespace

void check_intensity(double intensity_mm_per_h) {
    if (intensity_mm_per_h <= highest_intensity_mm_per_h) return;  // false for NaN
    std::ostringstream what;
    what << "not a valid intensity (got " << intensity_mm_per_h << ", expected 0 to " << highest_intensity_mm_per_h
         << " mm/h)";
    throw usage_error("rain", what.str());
}

double size_slope(double intensity_mm_per_h) {
    if (intensity_mm_per_h <= 0) return std::numeric_limits<double>::infinity();
    return 4100 * std::pow(intensity_mm_per_h, -0.21);
}

double fall_speed(double diameter) {
    return kessler_speed * std::sqrt(diameter);
}

double size_moment(double intensity_mm_per_h, double order, double d1, double d2) {
    if (intensity_mm_per_h <= 0 || d2 <= d1) return 0;
    const double beta = size_slope(intensity_mm_per_h);
    return marshall_palmer_n0 * gamma_between(order + 1, beta * d1, beta * d2) / std::pow(beta, order + 1);
}

double number_density(double intensity_mm_per_h, double d1, double d2) {
    if (intensity_mm_per_h <= 0 || d2 <= d1) return 0;
    const double beta = size_slope(intensity_mm_per_h);
    return marshall_palmer_n0 / beta * std::exp(-beta * d1) * -std::expm1(-beta * (d2 - d1));
}

double extinction(double intensity_mm_per_h, double d1, double d2) {
    if (intensity_mm_per_h <= 0 || d2 <= d1) return 0;
    const double beta = size_slope(intensity_mm_per_h), x1 = beta * d1, width = beta * (d2 - d1);
    // With t = x1 + s all parts of (x1 + s)^2 e^-(x1 + s) are positive: narrow intervals lose no digits.
    const double second_moment =
        x1 * x1 * -std::expm1(-width) + 2 * x1 * gamma_between(2, 0, width) + gamma_between(3, 0, width);
    return std::numbers::pi / 4 * marshall_palmer_n0 / (beta * beta * beta) * std::exp(-x1) * second_moment;
}

double rain_rate(double intensity_mm_per_h, double d1, double d2) {
    return std::numbers::pi / 6 * kessler_speed * size_moment(intensity_mm_per_h, 3.5, d1, d2);
}

}  // namespace pluvia
