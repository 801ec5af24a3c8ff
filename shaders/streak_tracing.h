// Makes the streak database by tracing rays from the camera through oscillating drops: once for each view and
// oscillation, for all lights together, since where a camera's ray leaves a drop is where its light comes from.
#pragma once

#include "shaders/drop_shape.h"
#include "shaders/streak_database.h"

#include <functional>

namespace pluvia {

struct StreakTracing {
    int width = 8;  // pixels across the drop
    int rays_per_pixel = 200;
    uint64_t seed = 0;  // of the oscillations
    /// Half the angle of a light, radians: what is seen of a smaller one depends on chance at any number of rays.
    float light_radius = 0.14f;
};

/// Height in pixels of the pictures of a view (index) that are `width` wide.
int streak_rows(int view, int width);

/// Oscillation number `index` of the database: larger than common, as its streaks are to show it.
DropOscillation streak_oscillation(uint64_t seed, int index);

/// progress: told the share done, 0 to 1, by any thread; may throw to stop. The result is the same for any number of
/// threads.
StreakDatabase trace_streaks(const StreakTracing& settings, const std::function<void(double)>& progress);

}  // namespace pluvia
