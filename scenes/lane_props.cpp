// Things of use that stand and hang in the lane.
#include "scenes/lane.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia::lane {

Assembly bamboo_fence(const Finishes& f, float width) {
    Assembly a;
    Chance chance{0xba3b};
    constexpr float height = 0.78f, depth = 0.5f, pitch = 0.036f;
    const int count = int(width / pitch);
    for (int i = 0; i < count; ++i) {  // split canes bent from the wall to the ground
        const float x = pitch * (float(i) + 0.5f), lift = chance(-0.006f, 0.006f);
        add_sheet(
            a[f.bamboo], 3, 7,
            [&](float s, float t) {
                const float phi = 0.5f * pi * (1 - t), round = pi * s, r = 0.5f * pitch * std::sin(round) + lift;
                return SheetPoint{{x - 0.5f * pitch * std::cos(round), (height + r) * std::cos(phi),
                                   0.03f + (depth + r) * std::sin(phi)},
                                  {s * pitch, -t * 1.1f}};
            },
            chance.tint(0.5f));
    }
    for (const float t : {0.12f, 0.5f, 0.85f}) {
        const float phi = 0.5f * pi * t;
        const Vec3 p = {0, height * std::cos(phi) + 0.012f, 0.03f + depth * std::sin(phi) + 0.014f};
        add_tube(a[f.bamboo], {p, p + Vec3(width, 0, 0)}, 0.014f, 6, {Rgb(0.45f), {}});
    }
    return a;
}

Assembly bench(const Finishes& f) {
    Assembly a;
    Chance chance{0xbe};
    for (int i = 0; i < 4; ++i)
        add_box(a[f.brown_wood], {-0.6f, 0.4f, 0.02f + 0.1f * float(i)}, {0.6f, 0.43f, 0.11f + 0.1f * float(i)},
                chance.tint(0.3f), 0.004f);
    for (const float x : {-0.5f, 0.45f})
        for (const float z : {0.04f, 0.35f})
            add_box(a[f.brown_wood], {x, 0, z}, {x + 0.05f, 0.4f, z + 0.05f}, chance.tint(0.3f), 0.004f);
    for (const float z : {0.05f, 0.36f})
        add_box(a[f.brown_wood], {-0.5f, 0.1f, z}, {0.5f, 0.14f, z + 0.03f}, chance.tint(0.3f));
    add_box(a[f.red_cloth], {-0.52f, 0.431f, 0.0f}, {0.3f, 0.445f, 0.44f}, {}, 0.004f);
    return a;
}

Assembly bucket(const Finishes& f) {
    Assembly a;
    constexpr float low = 0.12f, high = 0.145f, height = 0.26f;
    Chance chance{0xb0};
    for (int i = 0; i < 16; ++i) {  // staves
        const float phi = 2 * pi * float(i) / 16;
        const Vec3 out = {std::sin(phi), 0, std::cos(phi)};
        add_beam(a[f.bamboo], out * low, out * high + Vec3(0, height, 0), out, 0.052f, 0.014f, chance.tint(0.4f));
    }
    for (const float y : {0.05f, 0.2f}) {
        const float r = low + (high - low) * y / height + 0.009f;
        add_lathe(a[f.iron], {{r, y - 0.01f}, {r + 0.002f, y + 0.01f}}, 20, {1, 0.02f});
    }
    add_lathe(a[f.glass], {{0.125f, 0.21f}, {0, 0.211f}}, 16, {1, 1});  // water
    add_tube(a[f.bamboo],
             {{-0.14f, height, 0}, {-0.14f, height + 0.1f, 0}, {0.14f, height + 0.1f, 0}, {0.14f, height, 0}}, 0.011f,
             6);
    return a;
}

Assembly umbrella_stand(const Finishes& f) {
    Assembly a;
    add_lathe(
        a[f.porcelain],
        {{0.12f, 0}, {0.13f, 0.02f}, {0.125f, 0.44f}, {0.14f, 0.46f}, {0.13f, 0.47f}, {0.11f, 0.45f}, {0.11f, 0.05f}},
        18, {0.8f, 0.5f});
    const int colors[] = {f.red_cloth, f.indigo_cloth, f.rubber};
    for (int i = 0; i < 3; ++i) {
        const float phi = 2.1f * float(i) + 0.4f;
        const Vec3 lean = normalize(Vec3(0.16f * std::cos(phi), 1, 0.16f * std::sin(phi)));
        Shape folded;
        add_lathe(folded, {{0.01f, 0}, {0.03f, 0.15f}, {0.045f, 0.5f}, {0.04f, 0.62f}, {0.02f, 0.68f}, {0, 0.69f}}, 9,
                  {0.3f, 0.7f});
        const ShadingBasis basis(lean);
        append(a[colors[i]], folded, {Vec3d(basis.bitangent), Vec3d(lean), Vec3d(basis.tangent), Vec3d(0, 0.04, 0)});
        const Vec3 foot = {0, 0.04f, 0}, hook = {0.1f, 0, 0};
        const std::vector<Vec3> handle = {foot + lean * 0.66f, foot + lean * 0.93f, foot + lean * 0.93f + hook,
                                          foot + lean * 0.84f + hook};
        add_tube(a[f.bamboo], rounded(handle, 0.05f), 0.009f, 6);
    }
    return a;
}

Assembly crates(const Finishes& f) {
    Assembly a;
    Chance chance{0xc7};
    for (int level = 0; level < 3; ++level) {
        const float y = 0.31f * float(level), dx = chance(-0.02f, 0.02f);
        const int finish = level == 1 ? f.terracotta : f.indigo_cloth;
        for (int rail = 0; rail < 4; ++rail) {
            const float low = y + 0.005f + 0.08f * float(rail), high = low + (rail == 0 ? 0.07f : 0.045f);
            add_box(a[finish], {-0.22f + dx, low, -0.18f}, {0.22f + dx, high, -0.165f}, {}, 0.003f);
            add_box(a[finish], {-0.22f + dx, low, 0.165f}, {0.22f + dx, high, 0.18f}, {}, 0.003f);
            add_box(a[finish], {-0.22f + dx, low, -0.18f}, {-0.205f + dx, high, 0.18f});
            add_box(a[finish], {0.205f + dx, low, -0.18f}, {0.22f + dx, high, 0.18f});
        }
        for (const float x : {-0.21f, 0.0f, 0.21f})
            for (const float z : {-0.175f, 0.175f})
                add_box(a[finish], {x - 0.012f + dx, y, z - 0.006f}, {x + 0.012f + dx, y + 0.3f, z + 0.006f});
        add_box(a[finish], {-0.21f + dx, y + 0.005f, -0.17f}, {0.21f + dx, y + 0.02f, 0.17f});
    }
    return a;
}

}  // namespace pluvia::lane
