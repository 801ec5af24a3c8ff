// Distances along a ray that favour what is near a point, as the light of a lamp at that point does.
#pragma once

#include "renderer/core/ray.h"

#include <algorithm>

namespace pluvia {

/// Density proportional to the inverse square of the distance from the point, between begin < end (finite).
/// Source: Kulla and Fajardo 2012, "Importance Sampling Techniques for Path Tracing in Participating Media", section 4.
class EquiangularDistance {
public:
    EquiangularDistance(const Ray& ray, Vec3 point, float begin, float end) {
        const Vec3 to_point = point - ray.origin;
        closest_ = dot(to_point, ray.direction);
        const float aside = length(to_point - ray.direction * closest_);
        // Nearer than float can tell: any width is a valid density, and this one is still narrow.
        width_ = std::max(aside, 1e-5f * (1 + std::abs(closest_)));
        first_ = std::atan((begin - closest_) / width_), last_ = std::atan((end - closest_) / width_);
        begin_ = begin, end_ = end;
    }
    /// u: uniform in [0, 1).
    float sample(float u) const {
        return std::clamp(closest_ + width_ * std::tan(first_ + u * (last_ - first_)), begin_, end_);
    }
    float pdf(float distance) const {
        const float t = distance - closest_;
        return width_ / ((last_ - first_) * (width_ * width_ + t * t));
    }

private:
    float closest_, width_, first_, last_, begin_, end_;
};

}  // namespace pluvia
