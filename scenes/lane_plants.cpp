// Plants of the lane: leaves and fronds are small bent sheets whose outline is cut out by alpha.
#include "scenes/lane.h"

#include "renderer/core/sampling.h"
#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia::lane {
namespace {

/// One leaf of two halves folded along its midrib, from its stalk in `direction`, bent down towards its tip.
void add_leaf(Shape& shape, Vec3 stalk, Vec3 direction, float leaf_length, const Tint& tint) {
    const Vec3 side = normalize(cross(direction, Vec3(0.01f, 1, 0.02f))), up = cross(side, direction);
    const float half = 0.36f * leaf_length;
    add_sheet(
        shape, 2, 1,
        [&](float s, float t) {
            const float across = 2 * s - 1;
            return SheetPoint{stalk + direction * (leaf_length * t) + side * (across * half) +
                                  up * (leaf_length * (0.12f * std::abs(across) - 0.25f * t * t)),
                              {s, 1 - t}};
        },
        tint);
}

Vec3 random_direction(Chance& chance, float least_height) {
    const float y = chance(least_height, 1), phi = chance(0, 2 * pi), r = std::sqrt(std::max(0.0f, 1 - y * y));
    return {r * std::cos(phi), y, r * std::sin(phi)};
}

Tint leaf_tint(Chance& chance) {
    const float light = chance(0.6f, 1), yellow = chance(0.9f, 1);
    return {Rgb(light, light, light * yellow), {}};
}

/// Stems from the ground that lean apart, each with leaves along its upper part.
void add_stems(Assembly& a, const Finishes& f, Chance& chance, Vec3 foot, float height, int stems, int leaves,
               int leaf_finish, float leaf_length) {
    for (int i = 0; i < stems; ++i) {
        const Vec3 lean = random_direction(chance, 0.75f);
        const Vec3 kink = {chance(-0.03f, 0.03f), 0, chance(-0.03f, 0.03f)};
        const Vec3 middle = foot + lean * (0.55f * height) + kink;
        const Vec3 tip = middle + normalize(lean + Vec3(0, 0.5f, 0)) * (chance(0.3f, 0.5f) * height);
        add_tube(a[f.brown_wood], {foot, middle, tip}, 0.007f, 5);
        for (int k = 0; k < leaves / stems; ++k) {
            const float t = chance(0.35f, 1.05f);
            const Vec3 on_stem =
                t < 0.6f ? foot + (middle - foot) * (t / 0.6f) : middle + (tip - middle) * ((t - 0.6f) / 0.4f);
            const Vec3 out = random_direction(chance, -0.45f);
            const Vec3 twig = on_stem + out * chance(0.02f, 0.16f * height);
            const float droop = chance(-0.6f, 0.2f), size = leaf_length * chance(0.7f, 1.2f);
            add_leaf(a[leaf_finish], twig, normalize(out + Vec3(0, droop, 0)), size, leaf_tint(chance));
        }
    }
}

}  // namespace

Assembly bush(const Finishes& f, uint64_t seed, float height, int leaves, bool dark) {
    Assembly a;
    Chance chance{hash_key(seed, 1)};
    add_stems(a, f, chance, {0, 0, 0}, height, 5, leaves, dark ? f.dark_leaf : f.leaf, dark ? 0.075f : 0.1f);
    return a;
}

Assembly palm(const Finishes& f, uint64_t seed, float height) {
    Assembly a;
    Chance chance{hash_key(seed, 2)};
    for (int i = 0; i < 13; ++i) {
        const float phi = 2.4f * float(i), reach = height * chance(0.35f, 0.7f), top = height * chance(0.65f, 1.05f);
        const Vec3 out = {std::cos(phi), 0, std::sin(phi)}, side = {-out.z, 0, out.x};
        const float half = 0.13f * height;
        const Tint tint = leaf_tint(chance);
        const auto rib = [&](float t) {
            return out * (reach * t * t * 0.9f + 0.1f * reach * t) + Vec3(0, top * t * (1.6f - 0.75f * t), 0);
        };
        add_sheet(
            a[f.frond], 2, 6,
            [&](float s, float t) {
                const float across = 2 * s - 1, along = 0.3f + 0.7f * t;
                return SheetPoint{rib(along) + side * (across * half) + Vec3(0, -0.25f * half * std::abs(across), 0),
                                  {s, 1 - t}};
            },
            tint);
        add_tube(a[f.leaf], {rib(0), rib(0.15f), rib(0.31f)}, 0.007f, 4, {Rgb(0.7f), {0.49f, 0.5f}});
    }
    return a;
}

Assembly tree(const Finishes& f, uint64_t seed, float height) {
    Assembly a;
    Chance chance{hash_key(seed, 3)};
    const Vec3 fork = {0.1f, 0.45f * height, 0.05f};
    add_tube(a[f.brown_wood], {{0, 0, 0}, {0.04f, 0.25f * height, 0}, fork}, 0.06f, 8);
    for (int i = 0; i < 7; ++i) {
        const float reach = height * chance(0.3f, 0.5f);
        const Vec3 tip = fork + random_direction(chance, 0.15f) * reach;
        add_tube(a[f.brown_wood], {fork, fork + (tip - fork) * 0.5f + Vec3(0, 0.06f, 0), tip}, 0.022f, 6);
        add_stems(a, f, chance, fork + (tip - fork) * 0.75f, 0.2f * height, 3, 100, f.leaf, 0.115f);
    }
    return a;
}

Assembly pot(const Finishes& f, int finish, float radius, float height) {
    Assembly a;
    const float rim = 1.12f * radius;
    add_lathe(a[finish],
              {{0.62f * radius, 0},
               {0.7f * radius, 0.01f},
               {0.9f * radius, 0.5f * height},
               {radius, 0.85f * height},
               {rim, 0.86f * height},
               {rim, height},
               {0.95f * radius, height},
               {0.92f * radius, 0.9f * height}},
              20, {2 * pi * radius, height});
    add_lathe(a[f.soil], {{0.93f * radius, 0.9f * height}, {0.5f * radius, 0.92f * height}, {0, 0.93f * height}}, 20,
              {2 * pi * radius, radius});
    return a;
}

}  // namespace pluvia::lane
