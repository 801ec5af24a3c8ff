// Differences between two colour pictures of the same size: a is judged, b is the reference.
// FLIP is in flip.h, what depends on display is told there and in metric_list.h.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/image.h"

#include <vector>

namespace pluvia {

/// Mean over pixels and channels of (a - b)^2.
double mean_squared_error(const Image<Rgb>& a, const Image<Rgb>& b);

constexpr double relative_epsilon = 0.01;
/// Per pixel the mean over channels of (a - b)^2 / (b^2 + relative_epsilon).
std::vector<double> relative_squared_errors(const Image<Rgb>& a, const Image<Rgb>& b);
double mean(const std::vector<double>& values);
/// Mean without the largest 0.1 % of the values (rounded down).
double trimmed_mean(std::vector<double> values);

/// 10 log10(1 / (MSE + 1e-8)) for values in 0..1, dB: 80 for equal pictures. Source: piqa, as RainImageEvaluation has
/// it.
double psnr(const Image<Rgb>& a, const Image<Rgb>& b);

constexpr int ssim_window = 11;
/// Structural similarity for values in 0..1: Gaussian window of 11 taps and sigma 1.5, only where it lies inside, K1 =
/// 0.01, K2 = 0.03, mean over positions and channels. NaN when a side is shorter than the window.
/// Source: Wang, Bovik, Sheikh and Simoncelli 2004.
double ssim(const Image<Rgb>& a, const Image<Rgb>& b);

/// (mean of a - mean of b) / mean of b over pixels and channels, and its confidence interval of 95 %.
struct Bias {
    double value = 0, low = 0, high = 0;
    double channel[3] = {0, 0, 0};  // the same for red, green and blue
};
/// Interval: 1.96 standard deviations of the pixels' differences over the root of their number, so noise that differs
/// from pixel to pixel is covered; differences that vary over the picture widen it. NaN where b is black.
Bias bias(const Image<Rgb>& a, const Image<Rgb>& b);

}  // namespace pluvia
