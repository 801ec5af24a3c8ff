#include "tools/dataset/frame_keys.h"

#include <algorithm>

namespace pluvia {

Vec3d value_at(const std::vector<FrameKey>& keys, double frame) {
    const auto after = std::find_if(keys.begin(), keys.end(), [&](const FrameKey& key) { return key.frame > frame; });
    if (after == keys.begin()) return keys.front().value;
    if (after == keys.end()) return keys.back().value;
    const FrameKey& before = *(after - 1);
    const double s = (frame - before.frame) / (after->frame - before.frame);
    return before.value * (1 - s) + after->value * s;
}

Vec3d integral_to(const std::vector<FrameKey>& keys, double frame) {
    // Straight between keys, so trapezoids are exact.
    Vec3d sum;
    double from = 0;
    const auto add_to = [&](double to) {
        if (to <= from) return;
        sum += (value_at(keys, from) + value_at(keys, to)) * ((to - from) / 2);
        from = to;
    };
    for (const FrameKey& key : keys) add_to(std::min(key.frame, frame));
    add_to(frame);
    return sum;
}

}  // namespace pluvia
