// A ray through a drop of any shape of drop_shape.h, by geometric optics: reflected outside, refracted through, and
// after inner reflections. The closed forms for a sphere are in raindrop.h. Absorption is left out: no light is lost.
#pragma once

#include "shaders/drop_shape.h"

#include <array>
#include <span>

namespace pluvia {

/// Share of a ray's unpolarised light that leaves a drop in one direction.
struct DropExit {
    Vec3 direction;  // unit
    float weight;
};

/// All ways out: the first is the outer reflection, the others follow after 0, 1, 2, ... inner reflections. The weights
/// add up to 1 to float rounding: the last way takes what is left.
class DropExits {
public:
    std::span<const DropExit> all() const { return {exits_.data(), size_t(count_)}; }
    bool empty() const { return count_ == 0; }
    void add(Vec3 direction, float weight) { exits_[size_t(count_++)] = {direction, weight}; }
    int room() const { return int(exits_.size()) - count_; }

private:
    std::array<DropExit, 12> exits_;
    int count_ = 0;
};

/// Empty where the ray misses the drop. Origin and direction (unit) in the drop's frame and radii; the origin may be
/// anywhere on the ray. Inner reflections end when less than `tail` of the light is left inside.
/// The two polarisations are followed apart, also where the plane of incidence turns between two reflections.
DropExits trace_drop(const DropShape& shape, Vec3 origin, Vec3 direction, float tail = 0.005f);

}  // namespace pluvia
