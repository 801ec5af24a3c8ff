#include "scenes/utilities.h"

#include "renderer/core/units.h"

#include <cmath>

namespace pluvia {

Assembly air_conditioner(Palette& palette) {
    Assembly a;
    constexpr float w = 0.78f, h = 0.55f, d = 0.28f, gap = 0.09f;
    add_box(a[palette("cream_paint")], {0, 0, gap}, {w, h, gap + d}, {}, 0.015f);
    const Vec3 fan = {0.3f, 0.28f, gap + d};
    add_tube(a[palette("rubber")], {fan + Vec3(0, 0, -0.02f), fan + Vec3(0, 0, 0.003f)}, 0.225f, 28);
    for (int ring = 1; ring <= 6; ++ring) {  // wire guard
        std::vector<Vec3> circle;
        const float r = 0.038f * float(ring);
        for (int i = 0; i <= 18; ++i) {
            const float phi = 2 * pi * float(i) / 18;
            circle.push_back(fan + Vec3(r * std::cos(phi), r * std::sin(phi), 0.016f));
        }
        add_tube(a[palette("cream_paint")], circle, 0.0035f, 3);
    }
    for (int i = 0; i < 4; ++i) {
        const float phi = pi * float(i) / 4;
        const Vec3 out = Vec3(std::cos(phi), std::sin(phi), 0) * 0.235f, front = {0, 0, 0.018f};
        add_tube(a[palette("cream_paint")], {fan - out + front, fan + out + front}, 0.004f, 5);
    }
    for (float y = 0.06f; y < h - 0.05f; y += 0.035f)
        add_box(a[palette("rubber")], {0.57f, y, gap + d}, {0.73f, y + 0.012f, gap + d + 0.002f});
    for (const float x : {0.1f, w - 0.1f}) {  // brackets
        add_box(a[palette("iron")], {x - 0.02f, -0.03f, 0}, {x + 0.02f, 0, gap + d});
        add_beam(a[palette("iron")], {x, -0.28f, 0}, {x, -0.02f, gap + d - 0.04f}, {0, 0, 1}, 0.03f, 0.02f);
    }
    add_tube(a[palette("cream_paint")],
             rounded({{w, 0.15f, gap + 0.12f},
                      {w + 0.12f, 0.15f, gap + 0.12f},
                      {w + 0.12f, 0.15f, 0.04f},
                      {w + 0.12f, 1.5f, 0.04f}},
                     0.07f, 5),
             0.028f, 10);
    return a;
}

Assembly meter_box(Palette& palette) {
    Assembly a;
    add_box(a[palette("cream_paint")], {-0.12f, -0.2f, 0}, {0.12f, 0.16f, 0.12f}, {Rgb(0.75f), {}}, 0.012f);
    add_tube(a[palette("dark_glass")], {{0, 0.02f, 0.115f}, {0, 0.02f, 0.15f}}, 0.08f, 18);
    add_tube(a[palette("cream_paint")], {{0, 0.02f, 0.11f}, {0, 0.02f, 0.135f}}, 0.092f, 18, {Rgb(0.5f), {}});
    for (const float x : {-0.05f, 0.04f})
        add_tube(
            a[palette("zinc")],
            rounded({{x, -0.2f, 0.05f}, {x, -0.6f, 0.05f}, {x + 0.1f, -0.75f, 0.04f}, {x + 0.1f, -1.45f, 0.04f}}, 0.1f),
            0.013f, 8);
    add_tube(a[palette("zinc")], {{0, 0.16f, 0.05f}, {0, 1.2f, 0.05f}}, 0.016f, 8);
    return a;
}

Assembly utility_pole(Palette& palette) {
    Assembly a;
    add_lathe(a[palette("concrete")], {{0.15f, 0}, {0.1f, 7.8f}, {0, 7.85f}}, 16, {0.9f, 7.8f});
    for (const float y : {6.6f, 7.3f}) {
        add_box(a[palette("zinc")], {-0.75f, y, 0.1f}, {0.75f, y + 0.075f, 0.17f});
        for (const float x : {-0.65f, -0.3f, 0.3f, 0.65f}) {
            Shape insulator;
            add_lathe(insulator,
                      {{0.02f, 0}, {0.045f, 0.03f}, {0.025f, 0.06f}, {0.045f, 0.09f}, {0.02f, 0.14f}, {0, 0.15f}}, 10,
                      {0.2f, 0.2f});
            append(a[palette("porcelain")], insulator, translate({x, y + 0.075, 0.135}));
        }
    }
    Shape drum;
    add_lathe(drum, {{0, 0}, {0.2f, 0.02f}, {0.22f, 0.1f}, {0.22f, 0.6f}, {0.2f, 0.68f}, {0, 0.72f}}, 18, {1.4f, 0.8f});
    append(a[palette("zinc")], drum, translate({0.05, 5.4, 0.36}));
    for (float y = 2.0f; y < 6; y += 0.45f) {
        const float side = int(y / 0.45f) % 2 == 0 ? 1.0f : -1.0f;
        add_tube(a[palette("iron")], {{0, y, 0}, {side * 0.28f, y, 0}}, 0.009f, 5);
    }
    return a;
}

void add_cable(Assembly& a, Palette& palette, Vec3 from, Vec3 to, float sag, float radius) {
    std::vector<Vec3> path;
    constexpr int steps = 14;
    for (int i = 0; i <= steps; ++i) {
        const float t = float(i) / steps;
        path.push_back(from + (to - from) * t - Vec3(0, 4 * sag * t * (1 - t), 0));
    }
    add_tube(a[palette("rubber")], path, radius, 5);
}

}  // namespace pluvia
