#include "renderer/scene/material.h"

#include <cmath>

namespace pluvia {

UvTransform uv_transform(Vec2 offset, float rotation, Vec2 scale) {
    const float c = std::cos(rotation), s = std::sin(rotation);
    return {Vec2{c, -s} * scale.x, Vec2{s, c} * scale.y, offset};
}

UvPlacement uv_placement(const UvTransform& t) {
    const float scale_u = std::hypot(t.column_u.x, t.column_u.y);
    const float rotation =
        scale_u > 0 ? std::atan2(-t.column_u.y, t.column_u.x) : std::atan2(t.column_v.x, t.column_v.y);
    return {t.offset, rotation, {scale_u, std::sin(rotation) * t.column_v.x + std::cos(rotation) * t.column_v.y}};
}

}  // namespace pluvia
