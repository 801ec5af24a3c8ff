#include "renderer/scene/light_tree.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace pluvia {

/// A node of the binary tree from which the wide one is made.
struct LightTree::Branch {
    LightBounds bounds;
    int light = -1;  // of a leaf
    std::unique_ptr<Branch> first, second;
};

/// Upper estimates of the light that reaches the receiver from somewhere in each child; 0 only where none can.
/// Source: Conty Estevez and Kulla 2018, section 4.3 (without their reflectance term).
/// Free of branches, so that a compiler turns the loop into vector instructions.
LightTree::Lanes LightTree::importances(const Node& n, const Receiver& receiver) {
    const bool has_normal = length_squared(receiver.normal) > 0;
    Lanes result;
    for (int i = 0; i < width; ++i) {
        const float x = receiver.position.x - n.centre_x[i], y = receiver.position.y - n.centre_y[i],
                    z = receiver.position.z - n.centre_z[i];
        const float distance_squared = x * x + y * y + z * z;
        // Inside and near the bounds 1/d2 means nothing: the box's own size takes over, and angles do not count.
        const float inverse_square = 1 / std::max(std::max(distance_squared, n.radius_squared[i]), 1e-12f);
        const float arriving = n.power[i] * inverse_square, inverse_distance = std::sqrt(inverse_square);

        // Cone under which the bounds are seen, as a half angle around the direction to the receiver.
        const float sin_seen_squared = n.radius_squared[i] * inverse_square;
        const float sin_seen = std::sqrt(sin_seen_squared), cos_seen = std::sqrt(std::max(0.0f, 1 - sin_seen_squared));

        // Angle between axis and receiver, less the spread, less the cone: cos(max(0, a - b)), twice.
        const float cos_along = (n.axis_x[i] * x + n.axis_y[i] * y + n.axis_z[i] * z) * inverse_distance;
        const float cos_axis = n.two_sided[i] > 0 ? std::abs(cos_along) : cos_along;
        const float sin_axis = std::sqrt(std::max(0.0f, 1 - cos_axis * cos_axis));
        const bool in_spread = cos_axis > n.cos_spread[i];
        const float cos_off = in_spread ? 1.0f : cos_axis * n.cos_spread[i] + sin_axis * n.sin_spread[i];
        const float sin_off = in_spread ? 0.0f : sin_axis * n.cos_spread[i] - cos_axis * n.sin_spread[i];
        const float cos_emitted = cos_off > cos_seen ? 1.0f : cos_off * cos_seen + sin_off * sin_seen;
        const float emitted = cos_emitted <= n.cos_emission[i] - 1e-5f ? 0.0f : std::max(cos_emitted, 1e-3f);

        const float cos_normal =
            -(receiver.normal.x * x + receiver.normal.y * y + receiver.normal.z * z) * inverse_distance;
        const float sin_normal = std::sqrt(std::max(0.0f, 1 - cos_normal * cos_normal));
        const float cos_received = cos_normal > cos_seen ? 1.0f : cos_normal * cos_seen + sin_normal * sin_seen;
        const float received = cos_received < -1e-5f ? 0.0f : std::max(cos_received, 1e-3f);

        const bool inside = distance_squared <= n.radius_squared[i];
        const float cosines = (n.cos_spread[i] > -1 ? emitted : 1.0f) * (has_normal ? received : 1.0f);
        result[i] = inside ? arriving : arriving * cosines;
    }
    return result;
}

LightTree::LightTree(const std::vector<LightBounds>& lights) : place_of_light_(lights.size()) {
    std::vector<std::pair<int, LightBounds>> powered;
    for (size_t i = 0; i < lights.size(); ++i)
        if (lights[i].power > 0) powered.emplace_back(int(i), lights[i]);
    if (!powered.empty()) add_node(build(powered, 0, int(powered.size())), -1, 0);
}

LightTree::Branch LightTree::build(std::vector<std::pair<int, LightBounds>>& lights, int begin, int end) {
    if (end - begin == 1) return {lights[begin].second, lights[begin].first, nullptr, nullptr};
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
    Branch whole;
    whole.first = std::make_unique<Branch>(build(lights, begin, middle));
    whole.second = std::make_unique<Branch>(build(lights, middle, end));
    whole.bounds = unite(whole.first->bounds, whole.second->bounds);
    return whole;
}

/// Opens the costliest branches until the node is full.
void LightTree::add_node(const Branch& branch, int parent, int place_in_parent) {
    std::vector<const Branch*> children = {&branch};
    while (children.size() < width) {
        const Branch** costliest = nullptr;
        for (const Branch*& c : children)
            if (c->first && (!costliest || split_cost(c->bounds) > split_cost((*costliest)->bounds))) costliest = &c;
        if (!costliest) break;
        const Branch* opened = *costliest;
        *costliest = opened->first.get();
        children.push_back(opened->second.get());
    }

    const int index = int(nodes_.size());
    Node node;
    node.parent = parent, node.place_in_parent = place_in_parent;
    for (size_t i = 0; i < children.size(); ++i) {
        const LightBounds& b = children[i]->bounds;
        const Vec3 centre = b.centre();
        node.centre_x[i] = centre.x, node.centre_y[i] = centre.y, node.centre_z[i] = centre.z;
        node.axis_x[i] = b.axis.x, node.axis_y[i] = b.axis.y, node.axis_z[i] = b.axis.z;
        node.radius_squared[i] = 0.25f * length_squared(b.upper - b.lower);
        node.cos_spread[i] = b.cos_spread;
        node.sin_spread[i] = std::sqrt(std::max(0.0f, 1 - b.cos_spread * b.cos_spread));
        node.cos_emission[i] = b.cos_emission;
        node.two_sided[i] = b.two_sided ? 1.0f : 0.0f;
        node.power[i] = b.power;
        node.child[i] = ~children[i]->light;
        if (!children[i]->first) place_of_light_[children[i]->light] = {index, int(i)};
    }
    nodes_.push_back(node);
    for (size_t i = 0; i < children.size(); ++i) {
        if (!children[i]->first) continue;
        nodes_[index].child[i] = int(nodes_.size());
        add_node(*children[i], index, int(i));
    }
}

float LightTree::sum(const Lanes& lanes) {
    float total = 0;
    for (const float lane : lanes) total += lane;
    return total;
}

std::optional<LightTree::Choice> LightTree::choose(const Receiver& receiver, float u) const {
    Choice choice;
    choose(receiver, u, {&choice, 1});
    return choice.light < 0 ? std::nullopt : std::optional(choice);
}

/// Nodes are as large as several lines of the cache, and lie apart.
template <class Node>
static void prefetch(const Node& node) {
    for (size_t line = 0; line < sizeof(Node); line += 64)
        __builtin_prefetch(reinterpret_cast<const char*>(&node) + line);
}

void LightTree::choose(const Receiver& receiver, float u, std::span<Choice> choices) const {
    struct Part {
        int node;
        size_t begin, end;
    };
    std::array<Part, max_choices> parts;  // of the choices, in their order, with the nodes that they have come to
    std::array<float, max_choices> numbers;
    const size_t count = std::min(choices.size(), max_choices);
    for (size_t i = 0; i < count; ++i) {
        numbers[i] = std::min((float(i) + u) / float(count), 0x1.fffffep-1f);
        choices[i] = {-1, 1};
    }
    size_t part_count = 0;
    if (!nodes_.empty()) parts[part_count++] = {0, 0, count};
    while (part_count > 0) {
        const Part part = parts[--part_count];
        const Node& node = nodes_[part.node];
        const Lanes importance = importances(node, receiver);
        Lanes below;  // sum of the importances before a lane's
        float total = 0;
        int last = 0;
        for (int i = 0; i < width; ++i) {
            below[i] = total;
            total += importance[i];
            if (importance[i] > 0) last = i;  // rounding may carry a number beyond the sum: then this one counts
        }
        if (!(total > 0)) continue;
        const float inverse_total = 1 / total;
        const size_t open_parts = part_count;
        for (size_t i = part.begin; i < part.end; ++i) {
            const float number = numbers[i] * total;
            int lane = 0;
            for (int k = 1; k < width; ++k) lane += number >= below[k];
            lane = std::min(lane, last);
            // What is left of the number decides within the child.
            numbers[i] = std::clamp((number - below[lane]) / importance[lane], 0.0f, 0x1.fffffep-1f);
            choices[i].probability *= importance[lane] * inverse_total;
            const int child = node.child[lane];
            if (child < 0)
                choices[i].light = ~child;
            else if (part_count > open_parts && parts[part_count - 1].node == child)
                parts[part_count - 1].end = i + 1;
            else {
                parts[part_count++] = {child, i, i + 1};
                prefetch(nodes_[child]);
            }
        }
    }
}

float LightTree::probability(const Receiver& receiver, int light) const {
    auto [index, lane] = place_of_light_[light];
    if (index < 0) return 0;
    float probability = 1;
    while (index >= 0) {
        const Node& node = nodes_[index];
        const Lanes importance = importances(node, receiver);
        const float total = sum(importance);
        if (!(total > 0)) return 0;
        probability *= importance[lane] * (1 / total);
        index = node.parent, lane = node.place_in_parent;
    }
    return probability;
}

}  // namespace pluvia
