// How many samples per pixel a picture needs for an error: found by a pilot on some of its pixels, whose samples are
// none of the picture's. So the choice biases nothing, and the picture is that of --spp with the count.
#pragma once

#include "renderer/transport/render.h"

namespace pluvia {

constexpr int most_samples = 1 << 24;

/// What two independent estimates of a pixel say of the truth by which their error is divided. Its square is expected
/// of their product; that of their mean is larger where they are noisy, and most where a rare bright sample is what
/// makes the error: in a narrow lane by day the error of 128 samples came out a third too small. But it is no less than
/// 0.6 of that mean: else few samples, of which one half missed what is rare, tell of many times the error. With both
/// the lane's errors of 16 to 512 samples come out 9 % too small to 9 % too large.
Rgb truth_of_halves(Rgb a, Rgb b);

/// error: square root of the trimmed relMSE (tools/validate/color_metrics.h) against infinitely many samples, of the
/// background and, where it rains, of the rainy picture of the highest intensity, whichever is larger. intensities: of
/// the layers; picture_size: pixels of the picture; seed: of the picture. 1 to most_samples.
int samples_for_error(double error, const PixelRenderer& render_pixels, const std::vector<double>& intensities,
                      int64_t picture_size, uint64_t seed);

}  // namespace pluvia
