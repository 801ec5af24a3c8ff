#include "renderer/core/sampling.h"

namespace pluvia {

Distribution1D::Distribution1D(std::span<const float> weights) : cdf_(weights.size() + 1, 0.0) {
    for (size_t i = 0; i < weights.size(); ++i) cdf_[i + 1] = cdf_[i] + weights[i];
    total_ = cdf_.back();
    for (size_t i = 1; i < cdf_.size(); ++i)
        cdf_[i] = total_ > 0 ? cdf_[i] / total_ : double(i) / double(weights.size());
    cdf_.back() = 1;
    guide_.resize(weights.size());
    uint32_t cell = 0;
    for (size_t i = 0; i < guide_.size(); ++i) {
        while (cell + 1 < guide_.size() && cdf_[cell + 1] * double(size()) <= double(i)) ++cell;
        guide_[i] = cell;
    }
}

Distribution1D::Sample Distribution1D::find(double u, int first, int end) const {
    // The guide never starts behind u by more than rounding of the table and of the product.
    int cell = int(guide_[std::min(size_t(u * double(size())), guide_.size() - 1)]);
    cell = std::clamp(cell, first, end - 1);
    while (cell > first && cdf_[cell] > u) --cell;
    while (cell + 1 < end && cdf_[cell + 1] <= u) ++cell;
    const double width = cdf_[cell + 1] - cdf_[cell];
    const float offset = width > 0 ? float((u - cdf_[cell]) / width) : 0.5f;
    return {cell, std::min(offset, 0x1.fffffep-1f)};
}

}  // namespace pluvia
