#include "tools/validate/running_mean.h"

#include <cmath>

namespace pluvia {

void RunningMean::add(double value) {
    ++count_;
    const double before = value - mean_;
    mean_ += before / double(count_);
    sum_of_squares_ += before * (value - mean_);
}

double RunningMean::variance() const {
    return count_ < 2 ? 0 : sum_of_squares_ / double(count_ - 1);
}

double RunningMean::standard_error() const {
    return count_ == 0 ? 0 : std::sqrt(variance() / double(count_));
}

bool RunningMean::agrees_with(double expected, double tolerance) const {
    return std::abs(mean_ - expected) <= 5 * standard_error() + tolerance;
}

bool RunningMean::at_most(double bound, double tolerance) const {
    return mean_ - bound <= 5 * standard_error() + tolerance;
}

}  // namespace pluvia
