// What every BSDF must keep to, measured: used by the tests of the models.
#pragma once

#include "shaders/bsdf.h"
#include "tests/statistics.h"

namespace pluvia {

/// Unit vector with cosine mu to +z, or below for negative mu.
Vec3 direction(float mu, float phi = 0);

/// Directional albedo, per channel, from the weights of samples on a jittered grid of the three random numbers.
struct Albedo {
    RunningMean r, g, b;
};
Albedo measure_albedo(const Bsdf& bsdf, Vec3 wo, uint64_t seed);

/// Samples against their pdf, in cells around `axis`; width: of the lobe there, radians.
ChiSquare test_samples(const Bsdf& bsdf, Vec3 wo, uint64_t seed, Vec3 axis, double width);

/// A sample carries the pdf and weight that evaluation gives, and is on the side that it says.
void check_samples_agree_with_evaluation(const Bsdf& bsdf, uint64_t seed);

}  // namespace pluvia
