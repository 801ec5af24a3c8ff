// A ray, and where the next one starts so that it does not meet the surface it leaves.
#pragma once

#include "renderer/core/vec.h"

#include <bit>
#include <limits>

namespace pluvia {

struct Ray {
    Vec3 origin, direction;                                // direction is of unit length
    float t_max = std::numeric_limits<float>::infinity();  // metres

    Vec3 at(float t) const { return origin + direction * t; }
};

/// A point a few float steps off the surface, on the side that the geometric normal n points to.
/// Single precision ends here: a hit point is known to some 1e-7 of its distance from the scene's centre, so the
/// step is counted in representable numbers where coordinates are large and in metres near zero.
/// Source: Wächter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems 6.
/// extent: metres to the farthest corner of the triangle. Where a ray meets a triangle is found from the way to its
/// corners, whose rounding moves the triangle's plane: on ground of one piece and some kilometres by more than a step.
inline Vec3 offset_from_surface(Vec3 p, Vec3 n, float extent) {
    constexpr float near_origin = 1.0f / 32, float_scale = 1.0f / 65536, int_scale = 256, plane_rounding = 0x1p-21f;
    if (extent * plane_rounding > float_scale) p += n * (extent * plane_rounding);
    const auto step = [&](float x, float nx) {
        if (std::abs(x) < near_origin) return x + float_scale * nx;
        const auto ulps = int32_t(int_scale * nx);
        return std::bit_cast<float>(std::bit_cast<int32_t>(x) + (x < 0 ? -ulps : ulps));
    };
    return {step(p.x, n.x), step(p.y, n.y), step(p.z, n.z)};
}

}  // namespace pluvia
