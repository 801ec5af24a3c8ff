// Poisson-distributed counts as a pure function of a key. Used by drop_population.h for the number of drops in a cell.
#pragma once

#include <cstdint>

namespace pluvia {

/// Number of events where mean (0 to 1e9) are expected; exact to the 53 bits of the uniform numbers drawn from key.
/// Sources: inversion by sequential search below a mean of 10; above it Hoermann 1993, "The transformed rejection
/// method for generating Poisson random variables", algorithm PTRS.
int64_t sample_poisson(double mean, uint64_t key);

/// The same numbers, quicker where many keys share a mean.
class PoissonCounts {
public:
    explicit PoissonCounts(double mean = 0);

    int64_t sample(uint64_t key) const;

private:
    double mean_, chance_of_none_;
};

}  // namespace pluvia
