#include "tools/validate/depth_metrics.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

bool has_depth(float metres) {
    return std::isfinite(metres) && metres > 0;
}

}  // namespace

DepthErrors depth_errors(const Image<float>& a, const Image<float>& b) {
    DepthErrors e;
    double valid = 0, both = 0;
    for (size_t i = 0; i < b.pixels.size(); ++i) {
        if (!has_depth(b.pixels[i])) continue;
        ++valid;
        if (!has_depth(a.pixels[i])) continue;
        ++both;
        const double x = a.pixels[i], y = b.pixels[i], ratio = std::max(x / y, y / x);
        e.abs_rel += std::abs(x - y) / y;
        e.rmse += (x - y) * (x - y);
        for (int k = 0; k < 3; ++k) e.delta[k] += ratio < std::pow(1.25, k + 1);
    }
    e.abs_rel /= both;
    e.rmse = std::sqrt(e.rmse / both);
    for (double& d : e.delta) d /= valid;
    e.missing = (valid - both) / valid;
    return e;
}

MaskAgreement mask_agreement(const Image<float>& a, const Image<float>& b) {
    double in_a = 0, in_b = 0, in_both = 0;
    for (size_t i = 0; i < b.pixels.size(); ++i) {
        const bool x = a.pixels[i] >= 0.5f, y = b.pixels[i] >= 0.5f;
        in_a += x, in_b += y, in_both += x && y;
    }
    if (in_a == 0 && in_b == 0) return {1, 1, 1};
    return {in_both / (in_a + in_b - in_both), in_a > 0 ? in_both / in_a : 0, in_b > 0 ? in_both / in_b : 0};
}

}  // namespace pluvia
