#include "scenes/bare_tree.h"

#include "scenes/noise.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

/// One leaf as a sheet bent along its midrib.
void add_leaf(Shape& shape, Vec3 stalk, Vec3 along, Vec3 up, float size, Chance& chance) {
    const Vec3 side = normalize(cross(along, up)), normal = cross(side, along);
    const float curl = chance(-0.25f, 0.35f), fold = chance(0.05f, 0.3f), shade = chance(0.45f, 1.1f),
                red = chance(0.7f, 1);
    add_sheet(shape, 2, 2,
              [&](float s, float t) {
                  const float across = 2 * s - 1;
                  return SheetPoint{stalk + along * (size * t) + side * (0.45f * size * across) +
                                        normal * (size * (fold * std::abs(across) + curl * t * t)),
                                    {s, 1 - t}};
              },
              {Rgb(shade, shade * red, shade * red), {}});
}

class Grower {
public:
    Grower(Palette& palette, const BareTree& tree)
        : bark_(palette("bark")),
          leaf_(tree.dry_leaves > 0 ? palette("dry_leaf") : -1),
          tree_(tree),
          chance_{hash_key(tree.seed, 77)} {}

    Assembly build() {
        // Roots swell the foot.
        const float r = tree_.trunk_radius;
        const float lean_x = chance_(-0.08f, 0.08f), lean_z = chance_(-0.08f, 0.08f);
        const Vec3 fork = {lean_x * tree_.height, 0.3f * tree_.height, lean_z * tree_.height};
        add_tube(a_[bark_],
                 {{0, -0.15f, 0},
                  {0, 0.06f, 0},
                  {fork.x * 0.1f, 0.35f, fork.z * 0.1f},
                  {fork.x * 0.45f, 0.16f * tree_.height, fork.z * 0.4f},
                  fork},
                 {1.9f * r, 1.45f * r, 1.08f * r, 0.95f * r, 0.85f * r}, 12);
        const int limbs = 3;
        const float start = chance_(0, 2 * pi);
        for (int i = 0; i < limbs; ++i) {
            const float phi = start + 2 * pi * float(i) / limbs + chance_(-0.4f, 0.4f), out = chance_(0.45f, 0.85f);
            const float share = chance_(0.55f, 0.75f);
            grow(fork - Vec3(0, 0.12f * float(i), 0), normalize(Vec3(out * std::cos(phi), 1, out * std::sin(phi))),
                 0.32f * tree_.height, share * r, tree_.forks);
        }
        return std::move(a_);
    }

private:
    void grow(Vec3 start, Vec3 direction, float length_of_branch, float radius, int level) {
        const int pieces = level > 3 ? 5 : level > 1 ? 4 : 3;
        const int sides = level > 4 ? 9 : level > 2 ? 6 : level > 1 ? 5 : 4;
        std::vector<Vec3> path = {start};
        std::vector<float> radii = {radius};
        Vec3 d = direction;
        for (int i = 1; i <= pieces; ++i) {
            const float wobble = level > 3 ? 0.16f : 0.26f;
            const float wx = chance_(-wobble, wobble), wy = chance_(-wobble, wobble), wz = chance_(-wobble, wobble);
            d = normalize(d + Vec3(wx, wy + 0.07f, wz));
            path.push_back(path.back() + d * (length_of_branch / float(pieces)));
            radii.push_back(radius * (1 - 0.42f * float(i) / float(pieces)));
        }
        if (level == 0) radii.back() = 0.3f * radius;
        add_tube(a_[bark_], path, radii, sides);
        if (level == 0) return hang_leaf(path.back(), d);
        // The end goes on in a fork, side twigs leave along the way.
        const int side_twigs = level >= 2 ? 3 : 2;
        for (int i = 0; i < side_twigs; ++i) {
            const float t = chance_(0.3f, 0.95f) * float(pieces), f = t - std::floor(t);
            const size_t k = std::min(size_t(t), path.size() - 2);
            const float shorter = chance_(0.45f, 0.75f), finer = chance_(0.4f, 0.55f);
            grow(path[k] + (path[k + 1] - path[k]) * f, turned(d, chance_(0.7f, 1.15f)), length_of_branch * shorter,
                 radii[k] * finer, std::max(0, level - 2));
        }
        for (int i = 0; i < 2; ++i) {
            const float shorter = chance_(0.62f, 0.86f), angle = chance_(0.2f, 0.6f);
            grow(path.back(), turned(d, angle), length_of_branch * shorter, radii.back() * (i == 0 ? 0.92f : 0.7f),
                 level - 1);
        }
    }

    Vec3 turned(Vec3 d, float angle) {
        const float phi = chance_(0, 2 * pi);
        const ShadingBasis basis(d);
        return normalize(d * std::cos(angle) +
                         (basis.tangent * std::cos(phi) + basis.bitangent * std::sin(phi)) * std::sin(angle));
    }

    void hang_leaf(Vec3 tip, Vec3 d) {
        if (leaf_ < 0 || chance_(0, 1) > 0.0006f * float(tree_.dry_leaves)) return;
        add_leaf(a_[leaf_], tip, normalize(Vec3(d.x, -1.2f, d.z)), normalize(Vec3(d.z, 0.2f, -d.x)),
                 chance_(0.05f, 0.09f), chance_);
    }

    int bark_, leaf_;
    const BareTree& tree_;
    Chance chance_;
    Assembly a_;
};

}  // namespace

Assembly bare_tree(Palette& palette, const BareTree& tree) {
    return Grower(palette, tree).build();
}

void add_fallen_leaves(Assembly& a, Palette& palette, Vec2 lower, Vec2 upper, int count,
                       const std::function<float(float, float)>& height, uint64_t seed) {
    Chance chance{hash_key(seed, 78)};
    Shape& shape = a[palette("dry_leaf")];
    for (int i = 0; i < count; ++i) {
        const float x = chance(lower.x, upper.x), z = chance(lower.y, upper.y), keep = chance(0, 1);
        const float phi = chance(0, 2 * pi), size = chance(0.05f, 0.1f), tilt = chance(0, 0.35f);
        if (fractal_noise({x * 0.9f + 500, z * 0.35f + 500}, 1024, 1024, 3, seed) < 0.35f + 0.5f * keep) continue;
        const Vec3 along = normalize(Vec3(std::cos(phi), tilt, std::sin(phi)));
        add_leaf(shape, {x, height(x, z) + 0.006f, z}, along, {0, 1, 0}, size, chance);
    }
}

}  // namespace pluvia
