// Mean and variance of numbers that come one by one. Source: Welford 1962.
#pragma once

#include <cstdint>

namespace pluvia {

class RunningMean {
public:
    void add(double value);
    int64_t count() const { return count_; }
    double mean() const { return mean_; }
    /// Of the numbers, with count - 1 in the denominator; 0 for less than two.
    double variance() const;
    /// Of the mean, for independent numbers.
    double standard_error() const;

    /// Five sigma; tolerance: error that the compared value itself may have.
    bool agrees_with(double expected, double tolerance = 0) const;
    bool at_most(double bound, double tolerance = 0) const;

private:
    int64_t count_ = 0;
    double mean_ = 0, sum_of_squares_ = 0;
};

}  // namespace pluvia
