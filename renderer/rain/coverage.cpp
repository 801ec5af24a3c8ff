#include "renderer/rain/coverage.h"

#include <algorithm>

namespace pluvia {

std::optional<Covered> covered_interval(const Streak& streak, const Ray& ray, float exposure_time) {
    // The drop's centre is at w + V t from the ray's origin. Crossed with the direction that leaves a motion across the
    // ray, a + b t, of a point that must come within the radius.
    const Vec3d w = Vec3d(streak.start) - Vec3d(ray.origin), v(streak.velocity), d(ray.direction);
    const Vec3d a = cross(w, d), b = cross(v, d);
    const double radius = streak.radius, exposure = exposure_time;
    const double d_squared = length_squared(d), b_squared = length_squared(b);
    double begin = 0, end = exposure;
    // Below a millionth of the radius of motion it does not matter when the drop is where.
    if (b_squared * exposure * exposure <= 1e-12 * radius * radius * d_squared) {
        if (length_squared(a + b * (exposure / 2)) > radius * radius * d_squared) return {};
    } else {
        const double volume = dot(d, cross(w, v));  // over |b|: how far the path misses the ray
        const double inside = radius * radius * b_squared - volume * volume;
        if (inside <= 0) return {};
        const double of_b = 1 / b_squared, centre = -dot(a, b) * of_b, half = std::sqrt(inside * d_squared) * of_b;
        begin = std::max(begin, centre - half);
        end = std::min(end, centre + half);
        if (begin >= end) return {};
    }

    // Only while the view depth of the centre is at least the contact depth.
    const double ahead = double(streak.start.z) - contact_depth(streak);
    if (v.z < 0 && ahead + v.z * end < 0) end = -ahead / v.z;
    if (v.z > 0 && ahead + v.z * begin < 0) begin = -ahead / v.z;
    if (begin > end || ahead + v.z * (begin + end) / 2 < 0) return {};

    const float distance = float(dot(w + v * ((begin + end) / 2), d));
    if (exposure == 0) return Covered{0, 1, distance};
    const double of_exposure = 1 / exposure;
    const Covered covered{float(begin * of_exposure), float(end * of_exposure), distance};
    if (covered.begin >= covered.end) return {};
    return covered;
}

float position_across(const Streak& streak, const Ray& ray) {
    const Vec3d w = Vec3d(ray.origin) - Vec3d(streak.start), v(streak.velocity), d(ray.direction);
    // View axes are left-handed: this points to the right of a picture in which v points down.
    const Vec3d right = cross(d, v);
    const double size = length(right);
    return size > 0 ? float(std::clamp(dot(w, right) / (size * double(streak.radius)), -1.0, 1.0)) : 0.0f;
}

float ExposureUnion::add(float begin, float end) {
    Interval* const all = intervals();
    Interval* const all_end = all + count_;
    Interval* const first = std::find_if(all, all_end, [&](Interval i) { return i.end >= begin; });
    Interval joined{begin, end};
    double newly_covered = double(end) - double(begin);
    Interval* last = first;
    for (; last != all_end && last->begin <= end; ++last) {
        newly_covered -= double(std::min(last->end, end)) - double(std::max(last->begin, begin));
        joined = {std::min(joined.begin, last->begin), std::max(joined.end, last->end)};
    }
    if (newly_covered <= 0) return 0;
    total_ = std::min(1.0, total_ + newly_covered);

    if (first != last) {
        *first = joined;
        count_ -= int(last - first) - 1;
        std::move(last, all_end, first + 1);
        return float(newly_covered);
    }
    const int place = int(first - all);
    if (count_ == int(first_.size()) && overflow_.empty()) overflow_.assign(first_.begin(), first_.end());
    if (!overflow_.empty() && count_ == int(overflow_.size())) overflow_.resize(2 * overflow_.size());
    Interval* const store = intervals();
    std::move_backward(store + place, store + count_, store + count_ + 1);
    store[place] = joined;
    ++count_;
    return float(newly_covered);
}

}  // namespace pluvia
