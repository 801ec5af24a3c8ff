// Maps from the unit square to the shapes that light transport samples, each beside its pdf, and tabulated
// distributions. u is uniform in [0, 1)^2; pdfs are with respect to solid angle where a direction is returned.
#pragma once

#include "renderer/core/units.h"
#include "renderer/core/vec.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace pluvia {

/// Balance-like weight of one strategy against another. Source: Veach 1997, section 9.2.4, exponent 2.
/// pdf must be positive; infinite pdfs (delta lights) never reach it.
constexpr float power_heuristic(float pdf, float other_pdf) {
    const float ratio = other_pdf / pdf;
    return 1 / (1 + ratio * ratio);
}

/// Uniform on the unit disk, area-preserving. Source: Shirley and Chiu 1997.
inline Vec2 sample_disk(Vec2 u) {
    const float a = 2 * u.x - 1, b = 2 * u.y - 1;
    if (a == 0 && b == 0) return {0, 0};
    const bool wide = std::abs(a) > std::abs(b);
    const float radius = wide ? a : b;
    const float phi = wide ? (pi / 4) * (b / a) : (pi / 2) - (pi / 4) * (a / b);
    return {radius * std::cos(phi), radius * std::sin(phi)};
}

/// Direction about +z with density cos(theta)/pi.
inline Vec3 sample_cosine_hemisphere(Vec2 u) {
    const Vec2 d = sample_disk(u);
    return {d.x, d.y, std::sqrt(std::max(0.0f, 1 - d.x * d.x - d.y * d.y))};
}
inline float pdf_cosine_hemisphere(float cos_theta) {
    return std::max(0.0f, cos_theta) / pi;
}

/// Uniform on the unit sphere.
inline Vec3 sample_sphere(Vec2 u) {
    const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z));
    return {r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), z};
}
constexpr float pdf_sphere = 1 / (4 * pi);

/// Uniform within the cone around +z whose half angle has 1 - cosine = one_minus_cos (given so that narrow cones such
/// as the sun's keep their precision).
inline Vec3 sample_cone(Vec2 u, float one_minus_cos) {
    const float h = u.x * one_minus_cos, r = std::sqrt(std::max(0.0f, h * (2 - h)));
    return {r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), 1 - h};
}
inline float pdf_cone(float one_minus_cos) {
    return 1 / (2 * pi * one_minus_cos);
}

/// Barycentric weights of the second and third corner, uniform over a triangle's area.
/// Source: Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
inline Vec2 sample_triangle(Vec2 u) {
    if (u.y > u.x) {
        const float half = u.x * 0.5f;
        return {half, u.y - half};
    }
    const float half = u.y * 0.5f;
    return {u.x - half, half};
}

/// Piecewise-constant distribution over [0, 1) in equal cells.
class Distribution1D {
public:
    Distribution1D() = default;
    /// weights: not negative, finite, at least one; if all are zero the distribution is uniform.
    explicit Distribution1D(std::span<const float> weights);

    struct Sample {
        int cell;
        float offset;  // position within the cell, [0, 1): still uniform, to be used again
    };
    Sample sample(float u) const { return find(double(u), 0, size()); }
    /// Of the cells first <= cell < end alone, in proportion to their probabilities, which are not all zero.
    Sample sample(float u, int first, int end) const {
        return find(cdf_[first] + double(u) * (cdf_[end] - cdf_[first]), first, end);
    }
    /// Of the same cells.
    double probability(int first, int end) const { return cdf_[end] - cdf_[first]; }
    /// Probability of a cell.
    float probability(int cell) const { return float(cdf_[cell + 1] - cdf_[cell]); }
    int size() const { return int(cdf_.size()) - 1; }
    /// Sum of the weights, before normalisation.
    double total() const { return total_; }

private:
    Sample find(double u, int first, int end) const;

    std::vector<double> cdf_;  // size() + 1 values from 0 to 1
    // Cell in which each of size() equal steps of u begins: from there the cell of u is two steps away on average,
    // whatever the weights. Source: Chen and Asau 1974, "On Generating Random Variates from an Empirical Distribution".
    std::vector<uint32_t> guide_;
    double total_ = 0;
};

}  // namespace pluvia
