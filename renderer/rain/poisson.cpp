#include "renderer/rain/poisson.h"

#include "renderer/core/random.h"

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

// ln k! for k >= 10 by Stirling's series, to 1e-14; std::lgamma writes a global variable.
double log_factorial(double k) {
    const double n = k + 1, inverse = 1 / n, square = inverse * inverse;
    const double series =
        inverse * (1.0 / 12 - square * (1.0 / 360 - square * (1.0 / 1260 - square * (1.0 / 1680 - square / 1188))));
    return (n - 0.5) * std::log(n) - n + 0.5 * std::log(2 * std::numbers::pi) + series;
}

constexpr double least_rejected_mean = 10;  // below it counts are searched for from zero

int64_t search_from_zero(double mean, double chance_of_none, double u) {
    double probability = chance_of_none;
    int64_t count = 0;
    // The bound only matters where u lies within rounding of 1: no count beyond it has a probability above 2^-53.
    while (u >= probability && count < 60) {
        u -= probability;
        ++count;
        probability *= mean / double(count);
    }
    return count;
}

double log_probability(double k, double mean) {
    if (k < 10) {
        double factorial = 1;
        for (int n = 2; n <= int(k); ++n) factorial *= n;
        return k * std::log(mean) - mean - std::log(factorial);
    }
    return k * std::log(mean) - mean - log_factorial(k);
}

}  // namespace

int64_t sample_poisson(double mean, uint64_t key) {
    if (mean < least_rejected_mean) return search_from_zero(mean, std::exp(-mean), unit_double(hash_key(key)));

    const double b = 0.931 + 2.53 * std::sqrt(mean);
    const double a = -0.059 + 0.02483 * b;
    const double log_inverse_alpha = std::log(1.1239 + 1.1328 / (b - 3.4));
    const double squeeze = 0.9277 - 3.6224 / (b - 2);
    for (uint64_t attempt = 0;; ++attempt) {
        const double u = unit_double(hash_key(key, 2 * attempt)) - 0.5;
        const double v = unit_double(hash_key(key, 2 * attempt + 1));
        const double us = 0.5 - std::abs(u);
        if (us <= 0) continue;
        const double k = std::floor((2 * a / us + b) * u + mean + 0.43);
        if (us >= 0.07 && v <= squeeze) return int64_t(k);
        if (k < 0 || (us < 0.013 && v > us)) continue;
        if (std::log(v) + log_inverse_alpha - std::log(a / (us * us) + b) <= log_probability(k, mean))
            return int64_t(k);
    }
}

PoissonCounts::PoissonCounts(double mean) : mean_(mean), chance_of_none_(std::exp(-mean)) {}

int64_t PoissonCounts::sample(uint64_t key) const {
    if (mean_ >= least_rejected_mean) return sample_poisson(mean_, key);
    return search_from_zero(mean_, chance_of_none_, unit_double(hash_key(key)));
}

}  // namespace pluvia
