// FLIP: how much two pictures differ to somebody who flips between them, 0 (not at all) to 1, per pixel.
// Sources: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference Evaluator for
// Alternating Images"; Andersson, Nilsson, Shirley and Akenine-Moller 2021, "Visualizing Errors in Rendered High
// Dynamic Range Images".
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/image.h"

#include <numbers>

namespace pluvia {

/// A screen 0.7 m wide with 3840 pixels, seen from 0.7 m.
constexpr double flip_pixels_per_degree = 3840 * std::numbers::pi / 180;

/// a, b: linear Rec.709 as a screen shows it, 0..1; symmetric. pixels_per_degree: of the visual angle, above 0.
Image<float> ldr_flip(const Image<Rgb>& a, const Image<Rgb>& b, double pixels_per_degree = flip_pixels_per_degree);

/// Exposures of hdr_flip, in powers of two.
struct FlipExposures {
    double start = 0, stop = 0;
    int count = 0;  // evenly from start to stop; 0: the reference is black, so there is none to choose
};
/// From where the brightest pixel of the reference is tone mapped to 0.85, to where the median pixel is; as many as
/// whole stops lie between them, rounded up, and at least 2. Where the median is black, from the median of the others.
FlipExposures flip_exposures(const Image<Rgb>& reference);

/// The largest ldr_flip of the two under the tone curve of ACES (Narkowicz 2015) at the exposures of the reference.
/// test, reference: scene-linear; what is negative counts as 0.
Image<float> hdr_flip(const Image<Rgb>& test, const Image<Rgb>& reference,
                      double pixels_per_degree = flip_pixels_per_degree);

}  // namespace pluvia
