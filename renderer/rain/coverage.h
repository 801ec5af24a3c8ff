// The exact share of an exposure during which a falling drop covers a ray, and the fold of many drops front to back.
// Which drops are near a ray is answered by streak_bins.h.
#pragma once

#include "renderer/core/ray.h"
#include "renderer/rain/streaks.h"

#include <array>
#include <optional>
#include <vector>

namespace pluvia {

struct Covered {
    float begin = 0, end = 0;  // fractions of the exposure, 0 <= begin < end <= 1
    float distance = 0;        // metres along the ray to the drop's centre in the middle of the interval

    float fraction() const { return end - begin; }
};

/// When the drop is in the way of a ray (view coordinates; origin on the lens, direction of unit length): the centre of
/// the sphere is then less than its radius away from the ray. Empty where it never is, or only nearer than
/// contact_depth. The ray's t_max is not looked at. A drop that falls along the ray covers it all the time or never.
/// Computed in double precision from the rounded streak and ray: times are exact to 1e-7 of the exposure.
std::optional<Covered> covered_interval(const Streak& streak, const Ray& ray, float exposure_time);

/// How far from the axis of its path a drop that covers the ray (view coordinates) is met, in radii: -1 at the left
/// edge to 1 at the right one, as the camera sees it with the motion downwards. 0 for a drop that falls along the ray.
float position_across(const Streak& streak, const Ray& ray);

/// Union of the intervals in which drops have covered a ray. Added front to back, the returned fractions are the exact
/// weights of the drops, and what is not covered at the end is the weight of the background: together they are 1 to
/// float rounding.
class ExposureUnion {
public:
    /// Covers begin to end and returns the part of the exposure that no earlier interval covered, 0 to end - begin.
    float add(float begin, float end);
    /// Covered part of the exposure, 0 to 1.
    float total() const { return float(total_); }
    /// Part of the exposure in which the background is seen.
    float transmittance() const { return float(1 - total_); }

private:
    struct Interval {
        float begin, end;
    };
    Interval* intervals() { return overflow_.empty() ? first_.data() : overflow_.data(); }

    // Sorted and disjoint. Rays with more than a few drops are rare: those alone take memory from the heap.
    std::array<Interval, 16> first_;
    std::vector<Interval> overflow_;
    int count_ = 0;
    double total_ = 0;  // double, so that hundreds of parts still add up to 1
};

}  // namespace pluvia
