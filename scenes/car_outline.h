// The outline of a car's body, which car.cpp clothes.
#pragma once

#include "scenes/car.h"
#include "scenes/noise.h"

#include <cmath>

namespace pluvia {

constexpr float lens_depth = 0.08f;  // metres, of the glass of lamps

class CarOutline {
public:
    explicit CarOutline(const CarShape& shape) : c_(shape) {}

    float front() const { return 0.5f * c_.length; }

    /// 1 in the middle of the car, less towards its ends, where the plan is rounded.
    float rounding(float z) const {
        const float from_end = front() - std::abs(z), radius = 0.5f;
        if (from_end > radius) return 1;
        const float u = 1 - std::max(from_end, 0.0f) / radius;
        return 1 - 0.2f * u * u * u;
    }
    /// Height of the upper edge of the body's sides.
    float belt(float z) const {
        const float middle = 0.5f * (c_.bonnet + c_.boot);
        float y = z > 0 ? std::lerp(middle, c_.bonnet - 0.06f, smooth_step(0.2f, front() - 0.5f, z))
                        : std::lerp(middle, c_.boot - 0.02f, smooth_step(0.2f, front() - 0.3f, -z));
        const float nose = smooth_step(front() - 0.62f, front(), z), tail = smooth_step(front() - 0.22f, front(), -z);
        return y - 0.2f * nose * nose - 0.1f * tail;
    }
    /// Middle of the glass of a head lamp. side: 1 or -1.
    Vec3 head_lamp(float side) const {
        return {side * (0.5f * c_.width * rounding(front()) - 0.2f), belt(front()) - 0.09f, front() - 0.02f};
    }

protected:
    const CarShape& c_;
};

}  // namespace pluvia
