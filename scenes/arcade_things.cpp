#include "scenes/arcade_things.h"

#include "scenes/materials.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

Assembly vending_machine(Palette& palette, uint64_t seed) {
    Assembly a;
    Chance chance{hash_key(seed, 61)};
    static const char* const paints[] = {"red_paint", "white_paint", "blue_paint"};
    const int paint = palette(paints[seed % 3]);
    constexpr float half = 0.5f, depth = 0.72f, height = 1.83f;
    // A cabinet around a lit display.
    Shape& box = a[paint];
    add_box(box, {-half, 0.06f, 0.02f}, {half, 0.92f, depth}, {}, 0.02f);
    add_box(box, {-half, 0.92f, 0.02f}, {-half + 0.06f, height, depth}, {}, 0.012f);
    add_box(box, {half - 0.2f, 0.92f, 0.02f}, {half, height, depth}, {}, 0.012f);
    add_box(box, {-half + 0.06f, height - 0.1f, 0.02f}, {half - 0.2f, height, depth}, {}, 0.012f);
    add_box(a[palette("dark")], {-half + 0.05f, 0, 0.05f}, {half - 0.05f, 0.06f, depth - 0.06f});
    const int light = palette("vending_light", [](Scene&) {
        Material m = matte("vending_light", Rgb(0.85f), 0.5f);
        m.emission = nits(fluorescent, 300);
        m.lamp = true;
        return m;
    });
    add_facet(a[light], {Vec3{-half + 0.06f, 0.92f, depth - 0.22f},
                         {half - 0.2f, 0.92f, depth - 0.22f},
                         {half - 0.2f, height - 0.1f, depth - 0.22f},
                         {-half + 0.06f, height - 0.1f, depth - 0.22f}});
    static const Rgb labels[] = {{0.8f, 0.05f, 0.04f}, {0.05f, 0.3f, 0.1f},  {0.9f, 0.6f, 0.05f},
                                 {0.1f, 0.15f, 0.5f},  {0.85f, 0.85f, 0.8f}, {0.25f, 0.12f, 0.05f}};
    const int goods = palette("goods", [](Scene&) { return matte("goods", Rgb(0.75f), 0.45f); });
    for (int row = 0; row < 3; ++row)
        for (int i = 0; i < 8; ++i) {
            const float x = -half + 0.11f + 0.083f * float(i), y = 0.96f + 0.26f * float(row);
            const Tint tint = {labels[int(chance(0, 6))], {}};
            Shape can;
            if (row < 2)
                add_lathe(can, {{0.024f, 0}, {0.033f, 0.012f}, {0.033f, 0.12f}, {0.026f, 0.135f}, {0.001f, 0.136f}}, 9,
                          {1, 1}, tint);
            else
                add_lathe(
                    can,
                    {{0.03f, 0}, {0.034f, 0.05f}, {0.034f, 0.12f}, {0.014f, 0.17f}, {0.014f, 0.2f}, {0.001f, 0.2f}}, 9,
                    {1, 1}, tint);
            append(a[goods], can, translate({x, y, depth - 0.1}));
            add_box(a[goods], {x - 0.03f, y - 0.045f, depth - 0.05f}, {x + 0.03f, y - 0.012f, depth - 0.035f},
                    {Rgb(0.9f), {}});
        }
    for (int row = 0; row < 3; ++row)
        add_box(a[palette("white_paint")], {-half + 0.06f, 0.94f + 0.26f * float(row), depth - 0.2f},
                {half - 0.2f, 0.958f + 0.26f * float(row), depth - 0.04f});
    add_quad(a[palette("shop_glass")],
             {Vec3{-half + 0.06f, 0.92f, depth - 0.02f},
              {half - 0.2f, 0.92f, depth - 0.02f},
              {half - 0.2f, height - 0.1f, depth - 0.02f},
              {-half + 0.06f, height - 0.1f, depth - 0.02f}},
             {0, 1}, {1, 0});
    add_box(a[palette("dark")], {-0.32f, 0.22f, depth - 0.01f}, {0.2f, 0.42f, depth + 0.006f});  // flap
    add_box(a[palette("chrome")], {half - 0.15f, 1.2f, depth}, {half - 0.05f, 1.34f, depth + 0.012f}, {},
            0.004f);  // coins
    add_box(a[palette("dark")], {half - 0.14f, 1.4f, depth}, {half - 0.06f, 1.47f, depth + 0.006f});
    return a;
}

Assembly twin_lantern(Palette& palette) {
    Assembly a;
    Shape& iron = a[palette("bronze_frame")];
    constexpr float height = 4.4f;
    add_box(iron, {-0.13f, 0, -0.13f}, {0.13f, 0.5f, 0.13f}, {}, 0.02f);
    add_box(iron, {-0.075f, 0.5f, -0.075f}, {0.075f, height, 0.075f}, {}, 0.012f);
    add_tube(iron, rounded({{0, height - 0.1f, 0}, {0, height + 0.15f, 0}, {0, height + 0.15f, 1.25f}}, 0.3f, 6), 0.04f,
             9);
    add_beam(iron, {0, height - 0.7f, 0}, {0, height + 0.1f, 0.55f}, {0, 1, 0}, 0.04f, 0.04f);
    const int glass = palette("lantern_glass", [](Scene&) {
        Material m = matte("lantern_glass", Rgb(0.75f), 0.35f);
        m.emission = nits(halogen, 11000);  // 0.06 m2 of sides: 2 000 lm each
        m.lamp = true;
        return m;
    });
    for (const float z : {0.7f, 1.2f}) {
        Assembly head;
        Shape pane, hat;
        add_lathe(pane, {{0.075f, -0.5f}, {0.12f, -0.24f}}, 6, {1, 1});
        append(head[glass], pane, {});
        add_lathe(hat, {{0.15f, -0.24f}, {0.155f, -0.22f}, {0.06f, -0.12f}, {0.03f, -0.08f}, {0.02f, 0.1f}}, 12,
                  {0.6f, 0.2f});
        add_lathe(hat, {{0.001f, -0.56f}, {0.05f, -0.55f}, {0.085f, -0.5f}, {0.07f, -0.49f}}, 12, {0.6f, 0.2f});
        append(head[palette("bronze_frame")], hat, {});
        for (int i = 0; i < 6; ++i) {
            const float phi = 2 * pi * float(i) / 6, s = std::sin(phi), c = std::cos(phi);
            add_tube(head[palette("bronze_frame")], {{0.078f * s, -0.5f, 0.078f * c}, {0.124f * s, -0.23f, 0.124f * c}},
                     0.008f, 4);
        }
        append(a, head, translate({0, height + 0.1, z}));
    }
    return a;
}

Assembly paver_field(Palette& palette, const std::string& finish, float size, float paver_x, float paver_z,
                     uint64_t seed) {
    constexpr Transform lying = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
    Assembly a;
    Chance chance{hash_key(seed, 71)};
    Shape& shape = a[palette(finish)];
    const int rows = int(std::round(size / paver_z)), columns = int(std::round(size / paver_x));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            // Odd rows are shifted by half a paver; the last one hangs over into the next field, as its own does.
            const float x = -0.5f * size + paver_x * (float(i) + (j % 2 == 0 ? 0.5f : 1.0f)),
                        z = -0.5f * size + paver_z * (float(j) + 0.5f);
            const float half_x = 0.5f * paver_x - 0.003f, half_z = 0.5f * paver_z - 0.003f;
            const float tilt = chance(-0.011f, 0.011f), roll = chance(-0.011f, 0.011f), sink = chance(-0.003f, 0.001f);
            Shape paver;
            add_box(paver, {-half_x, -half_z, -0.03f}, {half_x, half_z, 0}, chance.tint(0.4f), 0.005f);
            append(shape, paver, translate({x, sink, z}) * lying * rotate(0.5 * tilt, 0.5 * roll, 0, 1));
        }
    add_facet(a[palette("soil")], {Vec3{-0.5f * size, -0.012f, 0.5f * size},
                                   {0.5f * size, -0.012f, 0.5f * size},
                                   {0.5f * size, -0.012f, -0.5f * size},
                                   {-0.5f * size, -0.012f, -0.5f * size}});
    return a;
}

Assembly round_lantern(Palette& palette) {
    Assembly a;
    const int paper = palette("red_paper", [](Scene&) {
        Material m = matte("red_paper", {0.7f, 0.06f, 0.03f}, 0.8f);
        m.emission = nits({1, 0.035f, 0.012f}, 15);
        m.lamp = true;
        return m;
    });
    std::vector<Vec2> barrel;
    for (int i = 0; i <= 16; ++i) {
        const float t = -1 + 2 * float(i) / 16;
        barrel.push_back(
            {0.06f + 0.12f * std::sqrt(std::max(0.0f, 1 - std::pow(std::abs(t), 2.4f))) - (i % 2 == 0 ? 0.004f : 0.0f),
             -0.36f + 0.22f * t});
    }
    Shape body, rings;
    add_lathe(body, barrel, 18, {1, 1});
    append(a[paper], body, {});
    for (const float y : {-0.6f, -0.14f})
        add_lathe(rings, {{0.055f, y}, {0.07f, y}, {0.07f, y + 0.04f}, {0.055f, y + 0.04f}}, 14, {0.4f, 0.1f});
    append(a[palette("rubber")], rings, {});
    add_tube(a[palette("rubber")], {{0, -0.12f, 0}, {0, 0, 0}}, 0.004f, 5);
    return a;
}

}  // namespace pluvia
