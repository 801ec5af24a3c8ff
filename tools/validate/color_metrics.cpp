#include "tools/validate/color_metrics.h"

#include "renderer/core/parallel.h"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pluvia {
namespace {

using Channels = std::array<double, 3>;

Channels channels(Rgb c) {
    return {double(c.r), double(c.g), double(c.b)};
}

using Window = std::array<double, ssim_window>;

Window gaussian_window() {
    Window window;
    for (int i = 0; i < ssim_window; ++i) window[i] = std::exp(-0.5 * std::pow((i - ssim_window / 2) / 1.5, 2));
    const double sum = std::accumulate(window.begin(), window.end(), 0.0);
    for (double& w : window) w /= sum;
    return window;
}

/// Window means along a row of a, b, a^2, b^2 and ab.
struct Moments {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    void add(double weight, const Moments& m) {
        a += weight * m.a, b += weight * m.b, aa += weight * m.aa, bb += weight * m.bb, ab += weight * m.ab;
    }
};

double similarity(const Moments& m) {
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    const double variance_a = m.aa - m.a * m.a, variance_b = m.bb - m.b * m.b, covariance = m.ab - m.a * m.b;
    return (2 * m.a * m.b + c1) * (2 * covariance + c2) /
           ((m.a * m.a + m.b * m.b + c1) * (variance_a + variance_b + c2));
}

}  // namespace

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double mean_squared_error(const Image<Rgb>& a, const Image<Rgb>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const Channels x = channels(a.pixels[i]), y = channels(b.pixels[i]);
        for (int c = 0; c < 3; ++c) sum += (x[c] - y[c]) * (x[c] - y[c]);
    }
    return sum / (3 * double(a.pixels.size()));
}

std::vector<double> relative_squared_errors(const Image<Rgb>& a, const Image<Rgb>& b) {
    std::vector<double> errors(a.pixels.size());
    for (size_t i = 0; i < errors.size(); ++i) {
        const Channels x = channels(a.pixels[i]), y = channels(b.pixels[i]);
        for (int c = 0; c < 3; ++c) errors[i] += (x[c] - y[c]) * (x[c] - y[c]) / (y[c] * y[c] + relative_epsilon) / 3;
    }
    return errors;
}

double trimmed_mean(std::vector<double> values) {
    const size_t kept = values.size() - values.size() / 1000;
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(kept) - 1, values.end());
    values.resize(kept);
    return mean(values);
}

double psnr(const Image<Rgb>& a, const Image<Rgb>& b) {
    return 10 * std::log10(1 / (mean_squared_error(a, b) + 1e-8));
}

double ssim(const Image<Rgb>& a, const Image<Rgb>& b) {
    const int width = a.width - ssim_window + 1, height = a.height - ssim_window + 1;
    if (width < 1 || height < 1) return std::numeric_limits<double>::quiet_NaN();
    static const Window window = gaussian_window();
    std::vector<double> row_sums(size_t(height), 0.0);
    parallel_for(height, [&](int y) {
        std::vector<Moments> column(size_t(a.width));
        for (int c = 0; c < 3; ++c) {
            std::fill(column.begin(), column.end(), Moments());
            for (int k = 0; k < ssim_window; ++k)
                for (int x = 0; x < a.width; ++x) {
                    const double u = channels(a.at(x, y + k))[c], v = channels(b.at(x, y + k))[c];
                    column[size_t(x)].add(window[k], {u, v, u * u, v * v, u * v});
                }
            for (int x = 0; x < width; ++x) {
                Moments m;
                for (int k = 0; k < ssim_window; ++k) m.add(window[k], column[size_t(x + k)]);
                row_sums[size_t(y)] += similarity(m);
            }
        }
    });
    return mean(row_sums) / (3.0 * width);
}

Bias bias(const Image<Rgb>& a, const Image<Rgb>& b) {
    const double count = double(a.pixels.size());
    Channels difference = {}, reference = {};
    double squares = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const Channels x = channels(a.pixels[i]), y = channels(b.pixels[i]);
        double pixel = 0;
        for (int c = 0; c < 3; ++c) {
            difference[c] += x[c] - y[c];
            reference[c] += y[c];
            pixel += (x[c] - y[c]) / 3;
        }
        squares += pixel * pixel;
    }
    const double sum = difference[0] + difference[1] + difference[2];
    const double reference_mean = (reference[0] + reference[1] + reference[2]) / (3 * count);
    const double mean_difference = sum / (3 * count);
    const double variance = std::max(0.0, squares / count - mean_difference * mean_difference);
    Bias result;
    result.value = mean_difference / reference_mean;
    const double half_width = 1.96 * std::sqrt(variance / std::max(count - 1, 1.0)) / std::abs(reference_mean);
    result.low = result.value - half_width, result.high = result.value + half_width;
    for (int c = 0; c < 3; ++c) result.channel[c] = difference[c] / reference[c];
    return result;
}

}  // namespace pluvia
