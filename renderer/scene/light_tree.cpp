#include "renderer/scene/light_tree.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pluvia {
namespace {

float safe_sin(float cosine) {
    return std::sqrt(std::max(0.0f, 1 - cosine * cosine));
}
float safe_acos(float cosine) {
    return std::acos(std::clamp(cosine, -1.0f, 1.0f));
}

/// cos(max(0, a - b)) from the sines and cosines of a and b.
float cos_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
float sin_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}

/// Smallest cone around two cones of directions; Pharr et al. 2023, 3.8.4.
void unite_cones(LightBounds& a, const LightBounds& b) {
    const float angle_a = safe_acos(a.cos_spread), angle_b = safe_acos(b.cos_spread);
    const float between = safe_acos(dot(a.axis, b.axis));
    if (std::min(between + angle_b, pi) <= angle_a) return;
    if (std::min(between + angle_a, pi) <= angle_b) {
        a.axis = b.axis, a.cos_spread = b.cos_spread;
        return;
    }
    const float angle = (angle_a + between + angle_b) / 2;
    const Vec3 perpendicular = cross(a.axis, b.axis);
    if (angle >= pi || length_squared(perpendicular) < 1e-12f) {
        a.cos_spread = -1;
        return;
    }
    const Vec3 side = normalize(cross(perpendicular, a.axis));
    const float turn = angle - angle_a;
    a.axis = normalize(a.axis * std::cos(turn) + side * std::sin(turn));
    a.cos_spread = std::cos(angle);
}

LightBounds unite(LightBounds a, const LightBounds& b) {
    if (a.power == 0) return b;
    if (b.power == 0) return a;
    unite_cones(a, b);
    a.cos_emission = std::min(a.cos_emission, b.cos_emission);
    a.two_sided = a.two_sided || b.two_sided;
    a.lower = min(a.lower, b.lower), a.upper = max(a.upper, b.upper);
    a.power += b.power;
    return a;
}

/// Cost of splitting: power times the solid angle of emission times the surface of the box.
float split_cost(const LightBounds& b) {
    if (b.power == 0) return 0;
    const float spread = safe_acos(b.cos_spread), emission = safe_acos(b.cos_emission);
    const float whole = std::min(spread + emission, pi), sin_spread = safe_sin(b.cos_spread);
    const float solid_angle =
        2 * pi * (1 - b.cos_spread) +
        pi / 2 * (2 * whole * sin_spread - std::cos(spread - 2 * whole) - 2 * spread * sin_spread + b.cos_spread);
    const Vec3 d = b.upper - b.lower;
    return b.power * solid_angle * (d.x * d.y + d.y * d.z + d.z * d.x);
}

}  // namespace

LightTree::Cluster LightTree::make_cluster(const LightBounds& b) {
    return {b.centre(),
            b.axis,
            0.25f * length_squared(b.upper - b.lower),
            b.cos_spread,
            safe_sin(b.cos_spread),
            b.cos_emission,
            b.power,
            b.two_sided};
}

/// Upper estimate of the light that reaches the receiver from somewhere in the bounds; 0 only where none can.
/// Source: Conty Estevez and Kulla 2018, section 4.3 (without their reflectance term).
float LightTree::importance(const Cluster& light, const Receiver& receiver) {
    const Vec3 to_receiver = receiver.position - light.centre;
    const float distance_squared = length_squared(to_receiver);
    // Inside and near the bounds 1/d2 means nothing: the box's own size takes over.
    const bool inside = distance_squared <= light.radius_squared;
    float result = light.power / std::max(std::max(distance_squared, light.radius_squared), 1e-12f);
    if (inside) return result;

    const Vec3 wi = to_receiver / std::sqrt(distance_squared);
    // Cone under which the bounds are seen, as a half angle around wi.
    const float sin_seen_squared = light.radius_squared / distance_squared;
    const float sin_seen = std::sqrt(sin_seen_squared), cos_seen = std::sqrt(1 - sin_seen_squared);
    if (light.cos_spread > -1) {
        float cos_axis = dot(light.axis, wi);
        if (light.two_sided) cos_axis = std::abs(cos_axis);
        const float sin_axis = safe_sin(cos_axis);
        const float cos_x = cos_difference(sin_axis, cos_axis, light.sin_spread, light.cos_spread);
        const float sin_x = sin_difference(sin_axis, cos_axis, light.sin_spread, light.cos_spread);
        const float cos_emitted = cos_difference(sin_x, cos_x, sin_seen, cos_seen);
        if (cos_emitted <= light.cos_emission - 1e-5f) return 0;
        result *= std::max(cos_emitted, 1e-3f);
    }
    if (length_squared(receiver.normal) > 0) {
        const float cos_normal = -dot(wi, receiver.normal);
        const float cos_received = cos_difference(safe_sin(cos_normal), cos_normal, sin_seen, cos_seen);
        if (cos_received < -1e-5f) return 0;
        result *= std::max(cos_received, 1e-3f);
    }
    return result;
}

LightTree::LightTree(const std::vector<LightBounds>& lights) : leaf_of_light_(lights.size(), -1) {
    std::vector<std::pair<int, LightBounds>> powered;
    for (size_t i = 0; i < lights.size(); ++i)
        if (lights[i].power > 0) powered.emplace_back(int(i), lights[i]);
    if (powered.empty()) return;
    nodes_.reserve(2 * powered.size());
    build(powered, 0, int(powered.size()), -1);
}

LightBounds LightTree::build(std::vector<std::pair<int, LightBounds>>& lights, int begin, int end, int parent) {
    const int index = int(nodes_.size());
    nodes_.emplace_back().parent = parent;
    if (end - begin == 1) {
        nodes_[index].cluster = make_cluster(lights[begin].second);
        nodes_[index].light = lights[begin].first;
        leaf_of_light_[lights[begin].first] = index;
        return lights[begin].second;
    }
    Vec3 lower(1e30f, 1e30f, 1e30f), upper = -lower;
    for (int i = begin; i < end; ++i) {
        lower = min(lower, lights[i].second.centre());
        upper = max(upper, lights[i].second.centre());
    }
    // Binned split: the plane among a dozen per axis with the least cost, stretched along thin boxes.
    constexpr int buckets = 12;
    const Vec3 extent = upper - lower;
    const float longest = std::max(extent.x, std::max(extent.y, extent.z));
    float best_cost = 1e38f;
    int best_axis = -1, best_bucket = 0;
    const auto bucket_of = [&](const LightBounds& b, int axis) {
        return std::min(buckets - 1, int(buckets * ((b.centre()[axis] - lower[axis]) / extent[axis])));
    };
    for (int axis = 0; axis < 3; ++axis) {
        if (!(extent[axis] > 0)) continue;
        std::array<LightBounds, buckets> bucket = {};
        for (int i = begin; i < end; ++i) {
            LightBounds& b = bucket[bucket_of(lights[i].second, axis)];
            b = unite(b, lights[i].second);
        }
        for (int split = 1; split < buckets; ++split) {
            LightBounds below, above;
            for (int k = 0; k < split; ++k) below = unite(below, bucket[k]);
            for (int k = split; k < buckets; ++k) above = unite(above, bucket[k]);
            if (below.power == 0 || above.power == 0) continue;
            const float cost = (split_cost(below) + split_cost(above)) * longest / extent[axis];
            if (cost < best_cost) best_cost = cost, best_axis = axis, best_bucket = split;
        }
    }
    int middle = (begin + end) / 2;
    if (best_axis >= 0) {
        const auto first_above =
            std::stable_partition(lights.begin() + begin, lights.begin() + end,
                                  [&](const auto& light) { return bucket_of(light.second, best_axis) < best_bucket; });
        middle = int(first_above - lights.begin());
    }
    const LightBounds first = build(lights, begin, middle, index);
    nodes_[index].second_child = int(nodes_.size());
    const LightBounds whole = unite(first, build(lights, middle, end, index));
    nodes_[index].cluster = make_cluster(whole);
    return whole;
}

std::optional<LightTree::Choice> LightTree::choose(const Receiver& receiver, float u) const {
    if (nodes_.empty()) return std::nullopt;
    int index = 0;
    float probability = 1;
    if (importance(nodes_[0].cluster, receiver) == 0) return std::nullopt;
    while (nodes_[index].second_child >= 0) {
        const int first = index + 1, second = nodes_[index].second_child;
        const float a = importance(nodes_[first].cluster, receiver), b = importance(nodes_[second].cluster, receiver);
        if (a + b == 0) return std::nullopt;
        const float share = a / (a + b);
        if (u < share) {
            index = first, probability *= share;
            u = std::min(u / share, 0x1.fffffep-1f);
        } else {
            index = second, probability *= 1 - share;
            u = std::min((u - share) / (1 - share), 0x1.fffffep-1f);
        }
    }
    return Choice{nodes_[index].light, probability};
}

float LightTree::probability(const Receiver& receiver, int light) const {
    int index = leaf_of_light_[light];
    if (index < 0 || importance(nodes_[0].cluster, receiver) == 0) return 0;
    float probability = 1;
    for (int parent = nodes_[index].parent; parent >= 0; index = parent, parent = nodes_[index].parent) {
        const float a = importance(nodes_[parent + 1].cluster, receiver);
        const float b = importance(nodes_[nodes_[parent].second_child].cluster, receiver);
        if (a + b == 0) return 0;
        const float share = a / (a + b);
        probability *= index == parent + 1 ? share : 1 - share;
    }
    return probability;
}

}  // namespace pluvia
