#include "renderer/core/sampling.h"

namespace pluvia {

int find_interval(std::span<const double> sorted, double u) {
    const auto above = std::upper_bound(sorted.begin(), sorted.end(), u);
    return std::max(0, int(above - sorted.begin()) - 1);
}

Distribution1D::Distribution1D(std::span<const float> weights) : cdf_(weights.size() + 1, 0.0) {
    for (size_t i = 0; i < weights.size(); ++i) cdf_[i + 1] = cdf_[i] + weights[i];
    total_ = cdf_.back();
    for (size_t i = 1; i < cdf_.size(); ++i)
        cdf_[i] = total_ > 0 ? cdf_[i] / total_ : double(i) / double(weights.size());
    cdf_.back() = 1;
}

Distribution1D::Sample Distribution1D::sample(float u) const {
    const int cell = std::min(find_interval(cdf_, u), size() - 1);
    const double width = cdf_[cell + 1] - cdf_[cell];
    const float offset = width > 0 ? float((u - cdf_[cell]) / width) : 0.5f;
    return {cell, std::min(offset, 0x1.fffffep-1f)};
}

}  // namespace pluvia
