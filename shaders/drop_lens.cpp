#include "shaders/drop_lens.h"

#include "renderer/core/sampling.h"
#include "renderer/core/transform.h"
#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr float rounding = 5e-7f;  // so that a sampled direction lies in its cone

}  // namespace

DropLens::DropLens(float width) {
    const float angle = std::clamp(60 / width, 2.0f, 8.0f) * (pi / 180), half = std::sin(angle / 2);
    one_minus_cos_ = 2 * half * half;
    density_ = 1 / (2 * pi * one_minus_cos_);
}

void DropLens::add(const DropShape& shape, Vec3 direction, Vec3 across, int moments) {
    const float level = std::sqrt(std::max(0.0f, 1 - direction.y * direction.y));
    const Vec3 right = level > 1e-4f ? normalize(cross(direction, Vec3(0, 1, 0))) : Vec3(1, 0, 0);
    const Vec3 up = cross(right, direction);
    const float height = std::hypot(level * shape.half_height, direction.y * shape.half_width);
    const Vec3 origin = right * (dot(across, right) * shape.half_width) + up * (dot(across, up) * height);
    const DropExits exits = trace_drop(shape, origin, direction);
    const float share = 1 / float(moments);
    if (exits.empty()) cones_[size_t(count_++)] = {direction, share};
    for (const DropExit& exit : exits.all()) cones_[size_t(count_++)] = {exit.direction, exit.weight * share};
}

float DropLens::evaluate(Vec3 wi) const {
    float sum = 0;
    for (int i = 0; i < count_; ++i)
        if (1 - dot(cones_[size_t(i)].direction, wi) <= one_minus_cos_ + rounding) sum += cones_[size_t(i)].weight;
    return sum * density_;
}

Vec3 DropLens::sample(Vec2 u) const {
    int i = 0;
    while (i < count_ - 1 && u.x >= cones_[size_t(i)].weight) u.x -= cones_[size_t(i++)].weight;
    const float v = std::min(u.x / cones_[size_t(i)].weight, 0x1.fffffep-1f);
    return ShadingBasis(cones_[size_t(i)].direction).to_world(sample_cone({v, u.y}, one_minus_cos_));
}

}  // namespace pluvia
