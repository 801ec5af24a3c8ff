// FLIP against colours whose difference is known and against sums written out for single pixels.
#include "tests/statistics.h"
#include "tools/validate/flip.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>

namespace pluvia {
namespace {

using std::numbers::pi;
using Vector = std::array<double, 3>;

Vector xyz(Vector rgb) {  // IEC 61966-2-1, over the white point
    return {(0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2]) / 0.9505,
            0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2],
            (0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2]) / 1.089};
}
Vector opponent(Vector v) {
    return {116 * v[1] - 16, 500 * (v[0] - v[1]), 200 * (v[1] - v[2])};
}
Vector rgb(Vector ycc) {  // the inverse matrix of the standard
    const double y = (ycc[0] + 16) / 116, X = 0.9505 * (y + ycc[1] / 500), Z = 1.089 * (y - ycc[2] / 200);
    const auto clip = [](double v) { return std::clamp(v, 0.0, 1.0); };
    return {clip(3.2406 * X - 1.5372 * y - 0.4986 * Z), clip(-0.9689 * X + 1.8758 * y + 0.0415 * Z),
            clip(0.0557 * X - 0.2040 * y + 1.0570 * Z)};
}
Vector hunt_lab(Vector linear) {
    Vector v = xyz(linear);
    for (double& c : v) c = c > 216.0 / 24389 ? std::cbrt(c) : (24389.0 / 27 * c + 16) / 116;
    Vector lab = opponent(v);
    lab[1] *= lab[0] / 100, lab[2] *= lab[0] / 100;
    return lab;
}
double scaled_difference(Vector a, Vector b) {
    const auto distance = [](Vector p, Vector q) {
        return std::pow(std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]), 0.7);
    };
    const double largest = distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), d = distance(a, b) / largest;
    return d < 0.4 ? d / 0.4 * 0.95 : 0.95 + (d - 0.4) / 0.6 * 0.05;
}

/// The metric at one pixel as the paper states it: filters are sums over the plane, not separated into axes.
double flip_at(const Image<Rgb>& a, const Image<Rgb>& b, int x, int y, double ppd) {
    const auto ycc = [&](const Image<Rgb>& p, int u, int v) {
        const Rgb c = p.at(std::clamp(u, 0, p.width - 1), std::clamp(v, 0, p.height - 1));
        return opponent(xyz({c.r, c.g, c.b}));
    };
    const auto weighted = [&](const Image<Rgb>& p, int channel, int radius,
                              const std::function<double(int, int)>& weight) {
        double value = 0, positive = 0, negative = 0, negative_value = 0;
        for (int v = -radius; v <= radius; ++v)
            for (int u = -radius; u <= radius; ++u) {
                const double w = weight(u, v), c = ycc(p, x + u, y + v)[channel];
                (w > 0 ? positive : negative) += std::abs(w);
                (w > 0 ? value : negative_value) += std::abs(w) * c;
            }
        return value / positive - (negative > 0 ? negative_value / negative : 0);
    };
    const int blur_radius = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd));
    const auto seen = [&](const Image<Rgb>& p) {
        const double terms[3][2][2] = {{{1, 0.0047}, {0, 1}}, {{1, 0.0053}, {0, 1}}, {{34.1, 0.04}, {13.5, 0.025}}};
        Vector result;
        for (int c = 0; c < 3; ++c)
            result[c] = weighted(p, c, blur_radius, [&](int u, int v) {
                const double r2 = (u * u + v * v) / (ppd * ppd);
                double w = 0;
                for (const auto& [s, t] : terms[c]) w += s * std::sqrt(pi / t) * std::exp(-pi * pi * r2 / t);
                return w;
            });
        return hunt_lab(rgb(result));
    };
    const double sigma = 0.082 * ppd / 2;
    const int feature_radius = int(std::ceil(3 * sigma));
    const auto feature = [&](const Image<Rgb>& p, bool is_edge) {
        double squares = 0;
        for (const bool horizontal : {true, false})
            squares += std::pow(weighted(p, 0, feature_radius,
                                         [&](int u, int v) {
                                             const double t = horizontal ? u : v;
                                             return (is_edge ? -t : t * t / (sigma * sigma) - 1) *
                                                    std::exp(-(u * u + v * v) / (2 * sigma * sigma));
                                         }) /
                                    116,
                                2);
        return std::sqrt(squares);
    };
    const double feature_difference =
        std::max(std::abs(feature(a, true) - feature(b, true)), std::abs(feature(a, false) - feature(b, false)));
    return std::pow(scaled_difference(seen(a), seen(b)), 1 - std::sqrt(feature_difference / std::sqrt(2)));
}

Image<Rgb> noise(int width, int height, uint64_t seed) {
    Image<Rgb> image(width, height);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {uniform(seed, i, 0), uniform(seed, i, 1), uniform(seed, i, 2)};
    return image;
}

double mean(const Image<float>& image) {
    double sum = 0;
    for (const float v : image.pixels) sum += v;
    return sum / double(image.pixels.size());
}

}  // namespace

TEST_CASE("FLIP of equal pictures is exactly zero, and it is symmetric") {
    const Image<Rgb> a = noise(31, 17, 1), b = noise(31, 17, 2);
    for (const float v : ldr_flip(a, a).pixels) CHECK(v == 0);
    for (const float v : hdr_flip(a, a).pixels) CHECK(v == 0);
    CHECK(ldr_flip(a, b).pixels == ldr_flip(b, a).pixels);
    CHECK(mean(ldr_flip(a, b)) > 0.1);
}

TEST_CASE("FLIP of even colours follows from their CIELAB values") {
    const auto flip = [](Rgb a, Rgb b) { return mean(ldr_flip(Image<Rgb>(9, 9, a), Image<Rgb>(9, 9, b))); };
    CHECK(flip({0, 1, 0}, {0, 0, 1}) == doctest::Approx(1).epsilon(1e-5));  // the largest there is
    // L*a*b* of sRGB primaries as printed in tables: green 87.73, -86.18, 83.18; blue 32.30, 79.19, -107.86; red 53.24,
    // 80.09, 67.20. White and black differ by 100 in L* alone.
    const double green_blue =
        std::pow(87.73 - 32.30 + std::hypot(.8773 * -86.18 - .3230 * 79.19, .8773 * 83.18 + .3230 * 107.86), 0.7);
    const auto expected = [&](double distance) {
        const double d = std::pow(distance, 0.7) / green_blue;
        return d < 0.4 ? d / 0.4 * 0.95 : 0.95 + (d - 0.4) / 0.6 * 0.05;
    };
    CHECK(flip(Rgb(0), Rgb(1)) == doctest::Approx(expected(100)).epsilon(1e-4).scale(0));
    CHECK(flip({1, 0, 0}, {0, 1, 0}) ==
          doctest::Approx(
              expected(87.73 - 53.24 + std::hypot(.5324 * 80.09 + .8773 * 86.18, .5324 * 67.20 - .8773 * 83.18)))
              .epsilon(1e-4)
              .scale(0));
    CHECK(flip(Rgb(0.18f), Rgb(0.2f)) ==
          doctest::Approx(expected(51.837 - 49.496)).epsilon(1e-3).scale(0));  // small ones
}

TEST_CASE("FLIP of noise, edges and points is what the paper's sums over the plane give") {
    Image<Rgb> a = noise(40, 36, 3), b = noise(40, 36, 4);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < 20; ++x) {
            a.at(x, y) = Rgb(x < 10 ? 0.2f : 0.8f);              // an edge that b lacks
            b.at(x, y) = Rgb(x == 5 && y == 12 ? 1.0f : 0.25f);  // a point that a lacks
        }
    for (const double ppd : {flip_pixels_per_degree, 30.0}) {
        const Image<float> map = ldr_flip(a, b, ppd);
        for (const auto& [x, y] : {std::pair{5, 12}, {10, 20}, {0, 0}, {39, 35}, {30, 18}, {18, 3}}) {
            CAPTURE(x);
            CAPTURE(y);
            // 1e-3: the standard's matrices have four digits.
            CHECK(map.at(x, y) == doctest::Approx(flip_at(a, b, x, y, ppd)).epsilon(1e-3).scale(0));
        }
    }
}

TEST_CASE("exposures run from the brightest pixel to the median, a whole stop or less apart") {
    // The tone curve gives 0.85 for x with (0.9036 x^2 + 0.018 x) / (0.8748 x^2 + 0.354 x + 0.14) = 0.85.
    const double p = (0.018 - 0.85 * 0.354) / (0.9036 - 0.85 * 0.8748), q = -0.85 * 0.14 / (0.9036 - 0.85 * 0.8748);
    const double bright = -p / 2 + std::sqrt(p * p / 4 - q);
    Image<Rgb> reference(3, 1);
    // The authors' program names its result for their own pair of pictures m12.5423_to_p0.9427.14.
    reference.pixels = {Rgb(float(bright * std::exp2(12.5423))), Rgb(float(bright * std::exp2(-0.9427))), Rgb(0)};
    const FlipExposures e = flip_exposures(reference);
    CHECK(e.start == doctest::Approx(-12.5423).epsilon(1e-5));
    CHECK(e.stop == doctest::Approx(0.9427).epsilon(1e-5));
    CHECK(e.count == 14);
    CHECK(flip_exposures(Image<Rgb>(4, 4, Rgb(2))).count == 2);
    CHECK(flip_exposures(Image<Rgb>(4, 4, Rgb(0))).count == 0);
}

TEST_CASE("HDR-FLIP does not depend on the unit of light and sees differences in the dark that a screen hides") {
    Image<Rgb> reference(32, 16, Rgb(0.001f));
    for (int x = 0; x < 32; ++x) reference.at(x, 0) = Rgb(1);
    Image<Rgb> test = reference;
    for (int x = 0; x < 32; ++x) test.at(x, 12) = Rgb(0.002f);
    const Image<float> map = hdr_flip(test, reference);
    CHECK(map.at(16, 12) > 0.2);
    CHECK(ldr_flip(test, reference).at(16, 12) < 0.05);
    for (Rgb& p : test.pixels) p *= 1024;
    for (Rgb& p : reference.pixels) p *= 1024;
    const Image<float> scaled = hdr_flip(test, reference);
    for (size_t i = 0; i < map.pixels.size(); ++i)
        CHECK(scaled.pixels[i] == doctest::Approx(map.pixels[i]).epsilon(1e-4).scale(1));
    for (const float v : hdr_flip(test, Image<Rgb>(32, 16)).pixels) CHECK(std::isfinite(v));
}

}  // namespace pluvia
