#include "tools/validate/flip.h"

#include "renderer/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pluvia {
namespace {

// ---- colour spaces

using Triple = std::array<float, 3>;

// Rec.709 with D65, in the rational digits of the primaries, as both papers use it.
constexpr double xyz_from_rgb[3][3] = {{10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
                                       {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
                                       {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};

/// X / Xn, Y / Yn, Z / Zn from linear RGB and back. White is (1, 1, 1) in both.
struct WhiteXyz {
    float forward[3][3], backward[3][3];

    WhiteXyz() {
        double m[3][3];
        for (int r = 0; r < 3; ++r) {
            const double white = xyz_from_rgb[r][0] + xyz_from_rgb[r][1] + xyz_from_rgb[r][2];
            for (int c = 0; c < 3; ++c) forward[r][c] = float(m[r][c] = xyz_from_rgb[r][c] / white);
        }
        const auto minor = [&](int r, int c) {
            const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
        };
        const double determinant = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) backward[r][c] = float(minor(c, r) / determinant);
    }
};

Triple multiply(const float (&m)[3][3], Triple v) {
    Triple result;
    for (int r = 0; r < 3; ++r) result[r] = m[r][0] * v[0] + m[r][1] * v[1] + m[r][2] * v[2];
    return result;
}

const WhiteXyz& white_xyz() {
    static const WhiteXyz matrices;
    return matrices;
}

/// Lightness, red-green and blue-yellow from X / Xn, Y / Yn, Z / Zn, after a curve or none.
Triple opponent(Triple v) {
    return {116 * v[1] - 16, 500 * (v[0] - v[1]), 200 * (v[1] - v[2])};
}

/// YCxCz, L*a*b* without its cube root.
Triple ycxcz_from_rgb(Triple rgb) {
    return opponent(multiply(white_xyz().forward, rgb));
}
Triple rgb_from_ycxcz(Triple v) {
    const float y = (v[0] + 16) / 116;
    return multiply(white_xyz().backward, {y + v[1] / 500, y, y - v[2] / 200});
}

/// L*a*b* whose colour counts for less where it is dark (Hunt effect).
Triple hunt_lab_from_rgb(Triple rgb) {
    constexpr float delta = 6.0f / 29;
    Triple v = multiply(white_xyz().forward, rgb);
    for (float& c : v) c = c > delta * delta * delta ? std::cbrt(c) : c / (3 * delta * delta) + 4.0f / 29;
    Triple lab = opponent(v);
    lab[1] *= 0.01f * lab[0], lab[2] *= 0.01f * lab[0];
    return lab;
}

/// Distance for large differences of colour. Source: Abasi, Tehran and Fairchild 2020.
float hyab(Triple a, Triple b) {
    return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]);
}

// ---- filters; pixels beyond the border repeat it

using Plane = Image<float>;
using Kernel = std::vector<float>;  // odd number of taps

Plane filter_rows(const Plane& in, const Kernel& kernel) {
    Plane out(in.width, in.height);
    const int radius = int(kernel.size()) / 2;
    parallel_for(in.height, [&](int y) {
        std::vector<float> padded(size_t(in.width + 2 * radius));
        for (int x = 0; x < int(padded.size()); ++x)
            padded[size_t(x)] = in.at(std::clamp(x - radius, 0, in.width - 1), y);
        float* row = &out.at(0, y);
        for (size_t k = 0; k < kernel.size(); ++k)
            for (int x = 0; x < in.width; ++x) row[x] += kernel[k] * padded[size_t(x) + k];
    });
    return out;
}

Plane filter_columns(const Plane& in, const Kernel& kernel) {
    Plane out(in.width, in.height);
    const int radius = int(kernel.size()) / 2;
    parallel_for(in.height, [&](int y) {
        float* row = &out.at(0, y);
        for (int k = 0; k < int(kernel.size()); ++k) {
            const float* source = &in.at(0, std::clamp(y + k - radius, 0, in.height - 1));
            for (int x = 0; x < in.width; ++x) row[x] += kernel[size_t(k)] * source[x];
        }
    });
    return out;
}

double sum(const std::vector<double>& values) {
    double result = 0;
    for (const double v : values) result += v;
    return result;
}

Kernel scaled(const std::vector<double>& taps, double factor) {
    Kernel kernel;
    for (const double t : taps) kernel.push_back(float(t * factor));
    return kernel;
}

/// One Gaussian of a contrast sensitivity function, in the terms of the 2020 paper: a sqrt(pi / b) exp(-pi^2 r^2 / b),
/// r in degrees.
struct Sensitivity {
    double a, b;
};
constexpr Sensitivity achromatic{1, 0.0047}, red_green{1, 0.0053}, blue_yellow[2] = {{34.1, 0.04}, {13.5, 0.025}};

std::vector<double> sensitivity_taps(double b, double pixels_per_degree) {
    const double widest = std::sqrt(blue_yellow[0].b / (2 * std::numbers::pi * std::numbers::pi));
    const int radius = int(std::ceil(3 * widest * pixels_per_degree));
    std::vector<double> taps;
    for (int i = -radius; i <= radius; ++i)
        taps.push_back(std::exp(-std::pow(std::numbers::pi * i / pixels_per_degree, 2) / b));
    return taps;
}

Plane blur(const Plane& in, double b, double pixels_per_degree) {
    const auto taps = sensitivity_taps(b, pixels_per_degree);
    const Kernel kernel = scaled(taps, 1 / sum(taps));
    return filter_columns(filter_rows(in, kernel), kernel);
}

Plane blur_blue_yellow(const Plane& in, double pixels_per_degree) {
    Plane blurred[2];
    double weight[2];
    for (int i = 0; i < 2; ++i) {
        const auto [a, b] = blue_yellow[i];
        blurred[i] = blur(in, b, pixels_per_degree);
        weight[i] = a * std::sqrt(std::numbers::pi / b) * std::pow(sum(sensitivity_taps(b, pixels_per_degree)), 2);
    }
    const float share = float(weight[0] / (weight[0] + weight[1]));
    for (size_t i = 0; i < in.pixels.size(); ++i)
        blurred[0].pixels[i] = share * blurred[0].pixels[i] + (1 - share) * blurred[1].pixels[i];
    return blurred[0];
}

/// Detectors of edges and points: first and second derivative of a Gaussian as wide as the eye's (0.082 degrees from
/// peak to trough), with weights of either sign adding up to one.
struct Detector {
    Kernel across, edge, point;

    explicit Detector(double pixels_per_degree) {
        const double deviation = 0.5 * 0.082 * pixels_per_degree;
        const int radius = int(std::ceil(3 * deviation));
        std::vector<double> gaussian, first, second;
        for (int x = -radius; x <= radius; ++x) {
            const double g = std::exp(-0.5 * x * x / (deviation * deviation));
            gaussian.push_back(g);
            first.push_back(-x * g);
            second.push_back((x * x / (deviation * deviation) - 1) * g);
        }
        across = scaled(gaussian, 1 / sum(gaussian));
        edge = balanced(first);
        point = balanced(second);
    }

private:
    static Kernel balanced(std::vector<double> taps) {
        double positive = 0, negative = 0;
        for (const double t : taps) (t > 0 ? positive : negative) += t;
        // A Gaussian narrower than a pixel has nothing but its middle.
        for (double& t : taps) t = t == 0 ? 0 : t / (t > 0 ? positive : -negative);
        return scaled(taps, 1);
    }
};

// ---- one picture seen

struct Seen {
    std::array<Plane, 3> lab;  // after the eye's blur, Hunt-adjusted
    Plane edges, points;       // strength of features
};

/// Strength of a feature: length of its responses along both axes.
Plane strength(const Plane& lightness, const Kernel& along, const Kernel& across) {
    Plane x = filter_columns(filter_rows(lightness, along), across);
    const Plane y = filter_columns(filter_rows(lightness, across), along);
    for (size_t i = 0; i < x.pixels.size(); ++i) x.pixels[i] = std::hypot(x.pixels[i], y.pixels[i]);
    return x;
}

Seen see(const Image<Rgb>& picture, double pixels_per_degree) {
    Seen seen;
    for (Plane& plane : seen.lab) plane = Plane(picture.width, picture.height);
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        const Rgb p = picture.pixels[i];
        const Triple v = ycxcz_from_rgb({p.r, p.g, p.b});
        for (int c = 0; c < 3; ++c) seen.lab[c].pixels[i] = v[c];
    }
    Plane lightness = seen.lab[0];
    for (float& v : lightness.pixels) v = (v + 16) / 116;
    const Detector detector(pixels_per_degree);
    seen.edges = strength(lightness, detector.edge, detector.across);
    seen.points = strength(lightness, detector.point, detector.across);

    seen.lab[0] = blur(seen.lab[0], achromatic.b, pixels_per_degree);
    seen.lab[1] = blur(seen.lab[1], red_green.b, pixels_per_degree);
    seen.lab[2] = blur_blue_yellow(seen.lab[2], pixels_per_degree);
    parallel_for(picture.height, [&](int y) {
        for (int x = 0; x < picture.width; ++x) {
            Triple rgb = rgb_from_ycxcz({seen.lab[0].at(x, y), seen.lab[1].at(x, y), seen.lab[2].at(x, y)});
            for (float& c : rgb) c = std::clamp(c, 0.0f, 1.0f);
            const Triple lab = hunt_lab_from_rgb(rgb);
            for (int c = 0; c < 3; ++c) seen.lab[c].at(x, y) = lab[c];
        }
    });
    return seen;
}

constexpr float color_exponent = 0.7f, feature_exponent = 0.5f;

/// Colour difference to 0..1: the smaller 40 % of the range, where most differences lie, takes 95 % of the scale.
float color_difference(Triple a, Triple b) {
    static const float largest =
        std::pow(hyab(hunt_lab_from_rgb({0, 1, 0}), hunt_lab_from_rgb({0, 0, 1})), color_exponent);
    const float difference = std::pow(hyab(a, b), color_exponent), knee = 0.4f * largest;
    return difference < knee ? 0.95f / knee * difference : 0.95f + (difference - knee) / (largest - knee) * (1 - 0.95f);
}

// ---- exposures

// Tone curve (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5). Source: Narkowicz 2016, with its pre-exposure of 0.6.
constexpr double k0 = 0.36 * 2.51, k1 = 0.6 * 0.03, k3 = 0.36 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;

float tone_mapped(float value, float factor) {
    const double x = std::max(0.0, double(value) * factor);
    if (x > 1e100) return 1;
    return float(std::clamp((k0 * x * x + k1 * x) / (k3 * x * x + k4 * x + k5), 0.0, 1.0));
}

/// What is tone mapped to 0.85.
double bright_value() {
    constexpr double t = 0.85;
    const double p = (k1 - t * k4) / (k0 - t * k3) / 2, q = -t * k5 / (k0 - t * k3);
    return -p + std::sqrt(p * p - q);
}

Image<Rgb> exposed(const Image<Rgb>& picture, double exposure) {
    Image<Rgb> result(picture.width, picture.height);
    const float factor = float(std::exp2(exposure));
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        const Rgb p = picture.pixels[i];
        result.pixels[i] = {tone_mapped(p.r, factor), tone_mapped(p.g, factor), tone_mapped(p.b, factor)};
    }
    return result;
}

}  // namespace

Image<float> ldr_flip(const Image<Rgb>& a, const Image<Rgb>& b, double pixels_per_degree) {
    const Seen first = see(a, pixels_per_degree), second = see(b, pixels_per_degree);
    Image<float> error(a.width, a.height);
    for (size_t i = 0; i < error.pixels.size(); ++i) {
        const auto lab = [&](const Seen& seen) {
            return Triple{seen.lab[0].pixels[i], seen.lab[1].pixels[i], seen.lab[2].pixels[i]};
        };
        const float color = color_difference(lab(first), lab(second));
        const float feature = std::max(std::abs(first.edges.pixels[i] - second.edges.pixels[i]),
                                       std::abs(first.points.pixels[i] - second.points.pixels[i]));
        const float feature_difference = std::pow(feature / std::numbers::sqrt2_v<float>, feature_exponent);
        error.pixels[i] = std::pow(color, 1 - feature_difference);
    }
    return error;
}

FlipExposures flip_exposures(const Image<Rgb>& reference) {
    std::vector<double> luminances;
    for (const Rgb p : reference.pixels) luminances.push_back(std::max(0.0f, luminance(p)));
    const auto median = [](std::vector<double>& values) {
        const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        if (values.size() % 2 == 1) return *middle;
        return (*middle + *std::max_element(values.begin(), middle)) / 2;
    };
    const double brightest = luminances.empty() ? 0 : *std::max_element(luminances.begin(), luminances.end());
    if (brightest == 0) return {};
    double middle = median(luminances);
    if (middle == 0) {
        std::erase(luminances, 0.0);
        middle = median(luminances);
    }
    FlipExposures exposures;
    exposures.start = std::log2(bright_value() / brightest);
    exposures.stop = std::log2(bright_value() / middle);
    exposures.count = std::max(2, int(std::ceil(exposures.stop - exposures.start)));
    return exposures;
}

Image<float> hdr_flip(const Image<Rgb>& test, const Image<Rgb>& reference, double pixels_per_degree) {
    const FlipExposures exposures = flip_exposures(reference);
    Image<float> worst(test.width, test.height);
    // A black reference asks for no exposure; the picture is then seen as it is.
    for (int i = 0; i < std::max(1, exposures.count); ++i) {
        const double step = (exposures.stop - exposures.start) / std::max(1, exposures.count - 1);
        const double exposure = exposures.start + i * step;
        const Image<float> error = ldr_flip(exposed(test, exposure), exposed(reference, exposure), pixels_per_degree);
        for (size_t k = 0; k < worst.pixels.size(); ++k) worst.pixels[k] = std::max(worst.pixels[k], error.pixels[k]);
    }
    return worst;
}

}  // namespace pluvia
