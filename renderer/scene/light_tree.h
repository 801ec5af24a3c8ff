// LightTree: a bounding volume hierarchy over many small lights, from which one is drawn with a probability close to
// its share of the light at a point. lights.h turns the choice into light.
// Source: Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting"; bounds and
// importance as in Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", 4th edition, 12.6.3.
#pragma once

#include "renderer/core/vec.h"

#include <optional>
#include <vector>

namespace pluvia {

/// Where a light is, how much it sends out and into which directions.
struct LightBounds {
    Vec3 lower, upper;
    Vec3 axis = {0, 0, 1};   // mean direction of emission
    float cos_spread = -1;   // all normals lie within this cosine of the axis; -1 = everywhere
    float cos_emission = 0;  // light leaves within this cosine of each normal: 0 = a half space, 1 = only along it
    bool two_sided = false;  // emits to both sides of its normals
    float power = 0;         // not negative; relative

    Vec3 centre() const { return (lower + upper) * 0.5f; }
};

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

    struct Choice {
        int light;
        float probability;
    };
    /// u: uniform in [0, 1). Empty where no light can reach the receiver.
    std::optional<Choice> choose(const Receiver& receiver, float u) const;
    /// Probability with which choose() returns this light.
    float probability(const Receiver& receiver, int light) const;

private:
    /// Bounds as the descent uses them: a sphere around the box, angles as sines and cosines.
    struct Cluster {
        Vec3 centre, axis;
        float radius_squared = 0, cos_spread = -1, sin_spread = 0, cos_emission = 0, power = 0;
        bool two_sided = false;
    };
    struct Node {
        Cluster cluster;
        int second_child = -1;  // the first child follows its parent; -1 = leaf
        int light = -1;
        int parent = -1;
    };
    static Cluster make_cluster(const LightBounds& bounds);
    static float importance(const Cluster& light, const Receiver& receiver);
    /// Returns the bounds of the subtree.
    LightBounds build(std::vector<std::pair<int, LightBounds>>& lights, int begin, int end, int parent);

    std::vector<Node> nodes_;
    std::vector<int> leaf_of_light_;  // -1 = no power
};

}  // namespace pluvia
