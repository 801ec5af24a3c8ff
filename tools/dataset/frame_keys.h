// Values that change along a sequence of frames: rain and wind over time.
#pragma once

#include "renderer/core/vec.h"

#include <vector>

namespace pluvia {

/// A value at a frame. Between two keys values change evenly, before the first and after the last they stay.
struct FrameKey {
    double frame = 0;
    Vec3d value;
};

/// keys: in rising order, at least one.
Vec3d value_at(const std::vector<FrameKey>& keys, double frame);

/// Integral of the value from frame 0 on, in values times frames; frame is 0 or more.
Vec3d integral_to(const std::vector<FrameKey>& keys, double frame);

}  // namespace pluvia
