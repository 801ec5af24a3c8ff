#include "renderer/transport/dry_parts.h"

#include <algorithm>
#include <limits>

namespace pluvia {

DryParts::DryParts(const RainShadow& shadow, const Ray& ray)
    : shadow_(&shadow), ray_(ray), end_(shadow.end_of_shelter(ray)) {}

std::span<const DryPart> DryParts::up_to(float distance, Counters& counters) {
    // Steps of 3 % of the way: where rain is seen the medium's share of the extinction hardly changes over one.
    constexpr float least_step = 0.1f, relative_step = 0.03f;  // metres; of the distance
    const float last = std::min(end_, ray_.t_max);
    while (reached_ < std::min(distance, last)) {
        float next = reached_ + std::max(least_step, relative_step * reached_);
        const bool at_surface = next >= ray_.t_max;
        if (at_surface) next = ray_.t_max;
        if (!shadow_->is_open(ray_.at(0.5f * (reached_ + next)), counters)) {
            const float end = at_surface ? std::numeric_limits<float>::infinity() : next;
            if (parts_.empty() || parts_.back().end < reached_)
                parts_.push_back({reached_, end});
            else
                parts_.back().end = end;
        }
        reached_ = next;
    }
    const auto beyond =
        std::partition_point(parts_.begin(), parts_.end(), [&](const DryPart& part) { return part.begin < distance; });
    return {parts_.begin(), beyond};
}

DryParts& DryPartsOfTile::parts_of(int size, const RainShadow& shadow, const RayScene& ray_scene, const View& view,
                                   int x, int y, Counters& counters) {
    const int i = x / size, k = y / size;
    for (Square& square : squares_)
        if (square.x == i && square.y == k && square.size == size) return square.parts;
    const Vec2 middle{(float(i) + 0.5f) * float(size), (float(k) + 0.5f) * float(size)};
    const Vec3d direction = view.world_vector_from_view(Vec3d(normalize(view.view_direction(middle))));
    Ray ray{Vec3(view.position), Vec3(direction)};
    RayHit hit;
    if (ray_scene.closest_hit(ray, {.at_half = true}, hit, counters)) ray.t_max = hit.distance;
    squares_.push_back({i, k, size, DryParts(shadow, ray)});
    return squares_.back().parts;
}

std::span<const DryPart> DryPartsOfTile::up_to(const RainShadow& shadow, const RayScene& ray_scene, const View& view,
                                               int x, int y, float distance, Counters& counters) {
    if (y / block != row_) squares_.clear(), row_ = y / block;
    DryParts& shared = parts_of(block, shadow, ray_scene, view, x, y, counters);
    if (shared.serves(distance)) return shared.up_to(distance, counters);
    return parts_of(1, shadow, ray_scene, view, x, y, counters).up_to(distance, counters);
}

}  // namespace pluvia
