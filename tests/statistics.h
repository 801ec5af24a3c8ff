// Statistics by which the tests judge random results: means with their errors, and samples against their pdf.
// Numbers are hashes of a seed that is fixed in the test, so a result never changes from run to run; a threshold of
// five sigma leaves one false alarm in 3.5 million tests when a seed or a model changes.
#pragma once

#include "renderer/core/random.h"
#include "renderer/core/vec.h"
#include "tools/validate/running_mean.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace pluvia {

/// Probability that a normal variable exceeds its mean by five standard deviations.
constexpr double five_sigma_p_value = 2.8665e-7;

/// Uniform in [0, 1): a pure function of its arguments.
inline float uniform(uint64_t seed, uint64_t index, uint64_t dimension) {
    return unit_float(hash_key(seed, index, dimension));
}
inline Vec2 uniform_2d(uint64_t seed, uint64_t index, uint64_t dimension) {
    return {uniform(seed, index, dimension), uniform(seed, index, dimension + 1)};
}

/// Upper regularised incomplete gamma function Q(a, x), a > 0, x >= 0.
double regularized_gamma_q(double a, double x);

struct ChiSquare {
    double statistic = 0;
    int degrees_of_freedom = 0;
    double p_value = 1;  // probability of a statistic at least as large if the expectation is right
};

/// Source: Pearson 1900.
double chi_square_p_value(double statistic, int degrees_of_freedom);

/// Counts against expected counts of the same total. Cells are merged in the order of their expectation until each
/// expects at least ten, below which the statistic does not follow the chi-square distribution.
ChiSquare chi_square_test(std::span<const double> observed, std::span<const double> expected);

/// Cells on the sphere around an axis: even in azimuth; in polar angle of even solid angle up to `width` radians and
/// of even ratios beyond, so that a lobe some times wider than `width` is resolved and the rest of the sphere covered.
struct SphereGrid {
    Vec3 axis = {0, 0, 1};  // unit
    double width = 100;     // far above pi: even in solid angle
    int rings = 20, azimuths = 32;
};

/// Directions from sample(0 .. count-1) against their pdf, 1/sr, which is integrated over each cell adaptively. Samples
/// that are empty count as one more cell, which expects what the pdf lacks to 1.
ChiSquare test_directions(const std::function<std::optional<Vec3>(uint64_t index)>& sample,
                          const std::function<double(Vec3)>& pdf, int count, const SphereGrid& grid = {});

}  // namespace pluvia
