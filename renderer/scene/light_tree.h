// LightTree: a bounding volume hierarchy over many small lights, from which one is drawn with a probability close to
// its share of the light at a point. lights.h turns the choice into light.
// Source: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting". Their tree
// is binary; here a node has up to eight children, which are weighed at the same time by vector instructions and
// against each other rather than by what encloses them.
#pragma once

#include "renderer/scene/light_bounds.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace pluvia {

/// A point that gathers light, and the side from which it does; the zero normal gathers from everywhere
/// (drops and scattering points).
struct Receiver {
    Vec3 position, normal;
};

class LightTree {
public:
    LightTree() = default;
    /// Lights keep their index in `lights`; those without power are never chosen.
    explicit LightTree(const std::vector<LightBounds>& lights);

    bool empty() const { return nodes_.empty(); }

    static constexpr size_t max_choices = 16;
    struct Choice {
        int light;
        float probability;
    };
    /// u: uniform in [0, 1). Empty where no light can reach the receiver.
    std::optional<Choice> choose(const Receiver& receiver, float u) const;
    /// Several at once, stratified: choice i of n is that of choose() for (i + u) / n, with light -1 where that is
    /// empty. They go down the tree side by side, since neighbours share most of the way. n: at most max_choices.
    void choose(const Receiver& receiver, float u, std::span<Choice> choices) const;
    /// Probability with which choose() returns this light.
    float probability(const Receiver& receiver, int light) const;

private:
    static constexpr int width = 8;
    using Lanes = std::array<float, width>;

    /// The children of a node as the descent uses them: a sphere around each box, angles as sines and cosines.
    /// Places without a child have no power.
    struct Node {
        Lanes centre_x = {}, centre_y = {}, centre_z = {}, axis_x = {}, axis_y = {}, axis_z = {};
        Lanes radius_squared = {}, cos_spread = {}, sin_spread = {}, cos_emission = {}, two_sided = {}, power = {};
        std::array<int, width> child = {};  // index of a node, or ~index of a light
        int parent = -1, place_in_parent = 0;
    };
    struct Place {
        int node = -1, lane = 0;  // node -1: no power
    };

    static Lanes importances(const Node& node, const Receiver& receiver);
    static float sum(const Lanes& lanes);
    struct Branch;
    static Branch build(std::vector<std::pair<int, LightBounds>>& lights, int begin, int end);
    void add_node(const Branch& branch, int parent, int place_in_parent);

    std::vector<Node> nodes_;
    std::vector<Place> place_of_light_;
};

}  // namespace pluvia
