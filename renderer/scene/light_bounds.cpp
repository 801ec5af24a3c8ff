#include "renderer/scene/light_bounds.h"

#include "renderer/core/units.h"

#include <algorithm>

namespace pluvia {
namespace {

float safe_acos(float cosine) {
    return std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

/// Smallest cone around two cones of directions; Pharr et al. 2023, 3.8.4.
void unite_cones(LightBounds& a, const LightBounds& b) {
    const float angle_a = safe_acos(a.cos_spread), angle_b = safe_acos(b.cos_spread);
    const float between = safe_acos(dot(a.axis, b.axis));
    if (std::min(between + angle_b, pi) <= angle_a) return;
    if (std::min(between + angle_a, pi) <= angle_b) {
        a.axis = b.axis, a.cos_spread = b.cos_spread;
        return;
    }
    const float angle = (angle_a + between + angle_b) / 2;
    const Vec3 perpendicular = cross(a.axis, b.axis);
    if (angle >= pi || length_squared(perpendicular) < 1e-12f) {
        a.cos_spread = -1;
        return;
    }
    const Vec3 side = normalize(cross(perpendicular, a.axis));
    const float turn = angle - angle_a;
    a.axis = normalize(a.axis * std::cos(turn) + side * std::sin(turn));
    a.cos_spread = std::cos(angle);
}

}  // namespace

LightBounds unite(LightBounds a, const LightBounds& b) {
    if (a.power == 0) return b;
    if (b.power == 0) return a;
    unite_cones(a, b);
    a.cos_emission = std::min(a.cos_emission, b.cos_emission);
    a.two_sided = a.two_sided || b.two_sided;
    a.lower = min(a.lower, b.lower), a.upper = max(a.upper, b.upper);
    a.power += b.power;
    return a;
}

float split_cost(const LightBounds& b) {
    if (b.power == 0) return 0;
    const float spread = safe_acos(b.cos_spread), emission = safe_acos(b.cos_emission);
    const float whole = std::min(spread + emission, pi),
                sin_spread = std::sqrt(std::max(0.0f, 1 - b.cos_spread * b.cos_spread));
    const float solid_angle =
        2 * pi * (1 - b.cos_spread) +
        pi / 2 * (2 * whole * sin_spread - std::cos(spread - 2 * whole) - 2 * spread * sin_spread + b.cos_spread);
    const Vec3 d = b.upper - b.lower;
    return b.power * solid_angle * (d.x * d.y + d.y * d.z + d.z * d.x);
}

}  // namespace pluvia
