#include "scenes/street_things.h"

#include "scenes/brush.h"
#include "scenes/materials.h"
#include "scenes/noise.h"

#include "renderer/core/sampling.h"
#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

void add_turned(Assembly& a, int finish, const std::vector<Vec2>& profile, int sides, const Transform& at = {}) {
    Shape turned;
    float reach = 0;
    for (const Vec2 p : profile) reach = std::max(reach, p.x);
    add_lathe(turned, profile, sides, {2 * pi * reach, profile.back().y - profile.front().y + 0.1f});
    append(a[finish], turned, at);
}

constexpr Transform along_z = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {}};  // a lathe's axis towards +z

/// Plate of 2 x half_width by height, at z = 0, both sides with the picture.
void add_plate(Assembly& a, int finish, int back, float half_width, float bottom, float top) {
    add_quad(a[finish],
             {Vec3{-half_width, bottom, 0.004f},
              {half_width, bottom, 0.004f},
              {half_width, top, 0.004f},
              {-half_width, top, 0.004f}},
             {0, 1}, {1, 0});
    add_box(a[back], {-half_width, bottom, -0.004f}, {half_width, top, 0.0035f});
}

int printed(Palette& palette, const std::string& name, const Ink& ink, Rgb sheet, Rgb writing) {
    return palette(name, [&](Scene& scene) {
        Material m = matte(name, Rgb(1), 0.35f);
        m.base_color_texture =
            add_texture(scene,
                        paint_color(ink.width, ink.height,
                                    [&](float x, float y) {
                                        const float dirt = 0.75f + 0.25f * fractal_noise({x * 6, y * 6}, 6, 6, 4, 91);
                                        return mix(sheet, writing,
                                                   ink.at(std::min(int(x * float(ink.width)), ink.width - 1),
                                                          std::min(int(y * float(ink.height)), ink.height - 1))) *
                                               dirt;
                                    }),
                        Wrap::clamp);
        return m;
    });
}

}  // namespace

Assembly street_lamp(Palette& palette) {
    Assembly a;
    const int paint = palette("black_paint");
    constexpr float height = 6.1f, reach = 1.3f, drop = 0.42f;
    Shape& metal = a[paint];
    add_box(metal, {-0.21f, 0, -0.21f}, {0.21f, 0.09f, 0.21f}, {}, 0.02f);
    add_box(metal, {-0.17f, 0.09f, -0.17f}, {0.17f, 0.98f, 0.17f}, {}, 0.025f);
    add_box(metal, {-0.19f, 0.98f, -0.19f}, {0.19f, 1.05f, 0.19f}, {}, 0.02f);
    add_box(metal, {-0.09f, 0.25f, 0.17f}, {0.09f, 0.62f, 0.182f}, {}, 0.008f);  // hatch
    add_turned(a, paint,
               {{0.15f, 1.05f},
                {0.13f, 1.12f},
                {0.095f, 1.2f},
                {0.09f, 1.32f},
                {0.1f, 1.34f},
                {0.1f, 1.38f},
                {0.082f, 1.42f},
                {0.062f, height - 0.6f},
                {0.075f, height - 0.58f},
                {0.075f, height - 0.54f},
                {0.05f, height - 0.5f},
                {0.045f, height}},
               16);
    for (int i = 0; i < 10; ++i) {  // flutes
        const float phi = 2 * pi * float(i) / 10;
        add_tube(metal,
                 {{0.08f * std::sin(phi), 1.45f, 0.08f * std::cos(phi)},
                  {0.062f * std::sin(phi), height - 0.62f, 0.062f * std::cos(phi)}},
                 0.012f, 4);
    }
    const std::vector<Vec3> crook = {
        {0, height - 0.05f, 0}, {0, height + 0.75f, 0.05f}, {0, height + 0.75f, reach}, {0, height - 0.1f, reach}};
    add_tube(metal, rounded(crook, 0.62f, 10), 0.034f, 10);
    add_tube(
        metal,
        rounded(
            {{0, height - 0.35f, 0}, {0, height - 0.1f, 0.42f}, {0, height + 0.3f, 0.5f}, {0, height + 0.62f, 0.62f}},
            0.3f, 6),
        0.016f, 7);
    add_turned(a, paint,
               {{0.19f, -0.2f},
                {0.2f, -0.17f},
                {0.17f, -0.08f},
                {0.1f, 0.02f},
                {0.07f, 0.06f},
                {0.07f, 0.16f},
                {0.05f, 0.2f},
                {0.03f, 0.3f}},
               20, translate({0, height - drop, reach}));
    const int lens = palette("street_lamp_lens", [](Scene&) {
        Material m = matte("street_lamp_lens", Rgb(0.8f), 0.3f);
        m.emission = nits(incandescent, 16000);  // with its curved area of 0.1 m2: 5 000 lm
        m.lamp = true;
        return m;
    });
    add_turned(a, lens, {{0.001f, -0.31f}, {0.07f, -0.295f}, {0.13f, -0.26f}, {0.165f, -0.2f}}, 20,
               translate({0, height - drop, reach}));
    return a;
}

Assembly hydrant(Palette& palette) {
    Assembly a;
    const int red = palette("red_paint");
    add_turned(a, red,
               {{0.17f, 0},
                {0.17f, 0.05f},
                {0.12f, 0.07f},
                {0.115f, 0.45f},
                {0.145f, 0.47f},
                {0.145f, 0.52f},
                {0.12f, 0.54f},
                {0.12f, 0.62f},
                {0.15f, 0.64f},
                {0.15f, 0.68f},
                {0.135f, 0.74f},
                {0.09f, 0.81f},
                {0.04f, 0.84f},
                {0.035f, 0.86f},
                {0.035f, 0.91f},
                {0.001f, 0.915f}},
               24);
    for (int i = 0; i < 8; ++i) {  // bolts
        const float phi = 2 * pi * (float(i) + 0.5f) / 8;
        for (const float y : {0.05f, 0.52f}) {
            const float r = y < 0.2f ? 0.148f : 0.13f;
            add_tube(a[red],
                     {{r * std::sin(phi), y, r * std::cos(phi)}, {r * std::sin(phi), y + 0.018f, r * std::cos(phi)}},
                     0.013f, 6);
        }
    }
    const std::vector<Vec2> nozzle = {{0.07f, 0},      {0.07f, 0.14f}, {0.09f, 0.145f}, {0.09f, 0.2f},
                                      {0.035f, 0.21f}, {0.03f, 0.24f}, {0.001f, 0.242f}};
    add_turned(a, red, nozzle, 16, translate({0, 0.36, 0}) * along_z);
    for (const double side : {1.0, -1.0})
        add_turned(a, red,
                   {{0.05f, 0},
                    {0.05f, 0.14f},
                    {0.066f, 0.145f},
                    {0.066f, 0.19f},
                    {0.025f, 0.2f},
                    {0.022f, 0.225f},
                    {0.001f, 0.226f}},
                   14, translate({0, 0.58, 0}) * rotate_y(side * 1.5708) * along_z);
    std::vector<Vec3> chain;
    for (int i = 0; i <= 8; ++i) {
        const float t = float(i) / 8;
        chain.push_back({0.1f * t, 0.34f - 0.13f * 4 * t * (1 - t) * 0.6f + 0.2f * t, 0.2f - 0.08f * t});
    }
    add_tube(a[palette("iron")], chain, 0.006f, 4);
    return a;
}

Assembly trash_can(Palette& palette) {
    Assembly a;
    const int zinc = palette("zinc");
    constexpr int ribs = 30, rows = 6;
    add_sheet(a[zinc], ribs * 4, rows, [&](float s, float t) {
        const float phi = 2 * pi * s, taper = 0.235f + 0.03f * t;
        const float r =
            taper + 0.009f * std::cos(float(ribs) * phi) * smooth_step(0, 0.1f, t) * smooth_step(1, 0.9f, t);
        return SheetPoint{{r * std::sin(phi), 0.02f + 0.66f * t, r * std::cos(phi)}, {phi * 0.25f, -0.66f * t}};
    });
    add_turned(a, zinc, {{0.245f, 0}, {0.245f, 0.03f}, {0.235f, 0.035f}}, 30);
    add_turned(a, zinc,
               {{0.268f, 0.67f},
                {0.275f, 0.68f},
                {0.275f, 0.7f},
                {0.285f, 0.7f},
                {0.287f, 0.735f},
                {0.26f, 0.75f},
                {0.15f, 0.8f},
                {0.001f, 0.815f}},
               30);
    add_tube(a[zinc], rounded({{-0.07f, 0.8f, 0}, {-0.07f, 0.87f, 0}, {0.07f, 0.87f, 0}, {0.07f, 0.8f, 0}}, 0.04f),
             0.011f, 6);
    for (const float x : {-0.27f, 0.27f})
        add_tube(
            a[zinc],
            rounded({{x, 0.5f, -0.07f}, {x * 1.2f, 0.46f, -0.07f}, {x * 1.2f, 0.46f, 0.07f}, {x, 0.5f, 0.07f}}, 0.04f),
            0.009f, 5);
    return a;
}

Assembly litter_basket(Palette& palette) {
    Assembly a;
    Shape& wire = a[palette("green_paint")];
    for (int i = 0; i < 26; ++i) {
        const float phi = 2 * pi * float(i) / 26, c = std::cos(phi), s = std::sin(phi);
        add_tube(wire, {{0.2f * s, 0.04f, 0.2f * c}, {0.24f * s, 0.5f, 0.24f * c}, {0.29f * s, 0.82f, 0.29f * c}},
                 0.0055f, 4);
    }
    for (const float y : {0.04f, 0.3f, 0.55f, 0.82f}) {
        std::vector<Vec3> ring;
        const float r = y < 0.5f ? 0.2f + 0.08f * y : 0.24f + 0.16f * (y - 0.5f);
        for (int i = 0; i <= 24; ++i)
            ring.push_back({r * std::sin(2 * pi * float(i) / 24), y, r * std::cos(2 * pi * float(i) / 24)});
        add_tube(wire, ring, y > 0.8f ? 0.013f : 0.007f, 5);
    }
    add_turned(a, palette("rubber"), {{0.195f, 0.05f}, {0.235f, 0.5f}, {0.27f, 0.76f}, {0.2f, 0.6f}, {0.001f, 0.5f}},
               18);
    return a;
}

Assembly mail_box(Palette& palette) {
    Assembly a;
    Shape& blue = a[palette("blue_paint")];
    constexpr float half = 0.27f, depth = 0.24f, spring = 0.95f;
    add_sheet(blue, 1, 20, [&](float s, float t) {  // front, rounded top and back in one sheet
        const float straight = 0.8f, arc = pi * depth, total = 2 * straight + arc, d = t * total;
        const float x = -half + 2 * half * s;
        if (d < straight) return SheetPoint{{x, spring - straight + d, depth}, {x, -d}};
        if (d < straight + arc) {
            const float phi = (d - straight) / depth;
            return SheetPoint{{x, spring + depth * std::sin(phi), depth * std::cos(phi)}, {x, -d}};
        }
        return SheetPoint{{x, spring - (d - straight - arc), -depth}, {x, -d}};
    });
    for (const float side : {-1.0f, 1.0f}) {
        std::vector<Vec2> outline = {{depth, 0.15f}, {depth, spring}};
        for (int i = 1; i < 10; ++i)
            outline.push_back({depth * std::cos(pi * float(i) / 10), spring + depth * std::sin(pi * float(i) / 10)});
        outline.insert(outline.end(), {{-depth, spring}, {-depth, 0.15f}});
        const float x = side * half;
        for (size_t i = 1; i + 1 < outline.size(); ++i) {
            const Vec2 p = outline[0], q = outline[i], r = outline[i + 1];
            const Vec3 u(x, p.y, p.x), v(x, q.y, q.x), w(x, r.y, r.x);
            if (side > 0)
                add_facet(blue, {u, w, v, v});
            else
                add_facet(blue, {u, v, w, w});
        }
        for (const float z : {-depth + 0.03f, depth - 0.03f})
            add_box(blue, {x * 0.9f - 0.025f, 0, z - 0.025f}, {x * 0.9f + 0.025f, 0.16f, z + 0.025f});
    }
    add_box(a[palette("iron")], {-half + 0.05f, spring + 0.03f, depth * 0.93f},
            {half - 0.05f, spring + 0.07f, depth + 0.03f}, {}, 0.01f);
    add_box(a[palette("white_paint")], {-0.16f, 0.55f, depth}, {0.16f, 0.75f, depth + 0.004f});
    return a;
}

Assembly parking_meter(Palette& palette) {
    Assembly a;
    const int grey = palette("grey_paint");
    add_turned(
        a, grey,
        {{0.07f, 0}, {0.06f, 0.02f}, {0.03f, 0.04f}, {0.03f, 1.05f}, {0.045f, 1.08f}, {0.045f, 1.12f}, {0.03f, 1.14f}},
        12);
    add_box(a[grey], {-0.085f, 1.13f, -0.06f}, {0.085f, 1.32f, 0.06f}, {}, 0.02f);
    add_turned(a, grey, {{0.001f, -0.055f}, {0.09f, -0.05f}, {0.095f, 0.045f}, {0.08f, 0.055f}}, 18,
               translate({0, 1.34, 0}) * along_z);
    add_turned(a, palette("dark_glass"), {{0.08f, 0.054f}, {0.001f, 0.058f}}, 18, translate({0, 1.34, 0}) * along_z);
    return a;
}

Assembly park_bench(Palette& palette) {
    Assembly a;
    Chance chance{0xbe2c};
    Shape& slat = a[palette("timber")];
    for (int i = 0; i < 5; ++i)
        add_box(slat, {-0.85f, 0.42f, -0.2f + 0.1f * float(i)}, {0.85f, 0.455f, -0.12f + 0.1f * float(i)},
                chance.tint(0.3f), 0.006f);
    for (int i = 0; i < 4; ++i)
        add_beam(slat, {-0.85f, 0.53f + 0.11f * float(i), -0.235f - 0.03f * float(i)},
                 {0.85f, 0.53f + 0.11f * float(i), -0.235f - 0.03f * float(i)}, {0, 1, -0.3f}, 0.03f, 0.085f,
                 chance.tint(0.3f));
    for (const float x : {-0.7f, 0.0f, 0.7f}) {
        Shape& iron = a[palette("iron")];
        add_tube(iron, rounded({{x, 0, 0.26f}, {x, 0.4f, 0.24f}, {x, 0.41f, -0.2f}, {x, 0.95f, -0.36f}}, 0.08f), 0.02f,
                 7);
        add_tube(iron, {{x, 0, -0.3f}, {x, 0.41f, -0.16f}}, 0.02f, 7);
        if (x != 0) add_tube(iron, rounded({{x, 0.4f, 0.24f}, {x, 0.66f, 0.26f}, {x, 0.66f, -0.26f}}, 0.1f), 0.016f, 7);
    }
    return a;
}

Assembly sandwich_board(Palette& palette, const std::string& line_1, const std::string& line_2) {
    Assembly a;
    Ink ink(256, 384);
    write_text(ink, line_1, {128, 110}, 50, 9);
    write_text(ink, line_2, {128, 200}, 40, 7);
    for (int i = 0; i < 4; ++i)
        draw_line(ink, {50, 265 + 26.0f * float(i)}, {206 - 22.0f * float(i % 3), 265 + 26.0f * float(i)}, 5);
    const int board = printed(palette, "chalk_" + line_1, ink, Rgb(0.035f), Rgb(0.72f));
    for (const double turn : {0.0, double(pi)}) {
        Assembly leaf;
        add_plate(leaf, board, palette("dark_wood"), 0.27f, 0.08f, 0.93f);
        for (const float x : {-0.3f, 0.27f})
            add_box(leaf[palette("timber")], {x, 0, -0.015f}, {x + 0.03f, 0.98f, 0.015f}, {}, 0.004f);
        for (const float y : {0.05f, 0.93f})
            add_box(leaf[palette("timber")], {-0.27f, y, -0.015f}, {0.27f, y + 0.04f, 0.015f}, {}, 0.004f);
        append(a, leaf, rotate_y(turn) * translate({0, 0, 0.26}) * rotate(std::sin(-0.13), 0, 0, std::cos(-0.13)));
    }
    return a;
}

Assembly traffic_cone(Palette& palette) {
    Assembly a;
    const int rubber = palette("cone_rubber", [](Scene&) { return matte("cone_rubber", {0.75f, 0.07f, 0.02f}, 0.5f); });
    add_box(a[rubber], {-0.19f, 0, -0.19f}, {0.19f, 0.035f, 0.19f});
    add_turned(a, rubber, {{0.14f, 0.03f}, {0.13f, 0.05f}, {0.082f, 0.33f}}, 20);
    add_turned(a, palette("white_paint"), {{0.083f, 0.33f}, {0.06f, 0.47f}}, 20);
    add_turned(a, rubber, {{0.06f, 0.47f}, {0.028f, 0.68f}, {0.02f, 0.7f}, {0.001f, 0.7f}}, 20);
    return a;
}

Assembly one_way_sign(Palette& palette) {
    Assembly a;
    Ink ink(384, 160);
    for (int k = -14; k <= 14; ++k) {  // shaft of the arrow, then its head
        draw_line(ink, {110, 80 + float(k) * 2}, {350, 80 + float(k) * 2}, 4);
    }
    for (int k = 0; k <= 40; ++k)
        draw_line(ink, {34 + float(k) * 2, 80 - float(k) * 1.5f}, {34 + float(k) * 2, 80 + float(k) * 1.5f}, 4);
    Ink text(384, 160);
    write_text(text, "ONE WAY", {225, 80}, 34, 7);
    for (size_t i = 0; i < ink.pixels.size(); ++i) ink.pixels[i] *= 1 - text.pixels[i];
    draw_line(ink, {8, 8}, {376, 8}, 5), draw_line(ink, {376, 8}, {376, 152}, 5),
        draw_line(ink, {376, 152}, {8, 152}, 5), draw_line(ink, {8, 152}, {8, 8}, 5);
    const int plate = printed(palette, "one_way", ink, {0.012f, 0.016f, 0.02f}, Rgb(0.75f));
    add_tube(a[palette("zinc")], {{0, -0.1f, -0.03f}, {0, 2.75f, -0.03f}}, 0.028f, 10);
    Assembly sign;
    add_plate(sign, plate, palette("zinc"), 0.46f, 2.28f, 2.66f);
    append(a, sign, {});
    return a;
}

Assembly name_sign(Palette& palette, const std::string& name) {
    Assembly a;
    Ink ink(384, 96);
    write_text(ink, name, {192, 48}, 46, 9);
    const int plate = printed(palette, "name_" + name, ink, {0.01f, 0.09f, 0.05f}, Rgb(0.75f));
    add_tube(a[palette("zinc")], {{0, -0.1f, -0.03f}, {0, 3.0f, -0.03f}}, 0.028f, 10);
    for (const double turn : {0.0, double(pi)}) {
        Assembly sign;
        add_plate(sign, plate, palette("zinc"), 0.4f, 2.72f, 2.92f);
        append(a, sign, translate({0, 0, -0.03}) * rotate_y(turn) * translate({0, 0, 0.034}));
    }
    return a;
}

Assembly planter(Palette& palette, uint64_t seed) {
    Assembly a;
    Chance chance{hash_key(seed, 31)};
    add_box(a[palette("timber")], {-0.35f, 0, -0.35f}, {0.35f, 0.5f, 0.35f}, {}, 0.02f);
    for (const float x : {-0.36f, 0.29f})
        for (const float z : {-0.36f, 0.29f})
            add_box(a[palette("timber")], {x, 0, z}, {x + 0.07f, 0.54f, z + 0.07f}, chance.tint(0.2f), 0.008f);
    Shape& leaf = a[palette("box_leaf", [](Scene&) {
        Material m = matte("box_leaf", {0.03f, 0.085f, 0.022f}, 0.45f);
        m.double_sided = true;
        return m;
    })];
    for (int i = 0; i < 1500; ++i) {
        const float phi = chance(0, 2 * pi), y = chance(-1, 1), r = 0.36f * std::cbrt(chance(0.5f, 1)),
                    s = chance(0.014f, 0.026f);
        const float c = std::sqrt(1 - y * y), tx = chance(-1, 1), ty = chance(0, 1), tz = chance(-1, 1),
                    shade = chance(0.5f, 1.1f);
        const Vec3 at = {r * c * std::cos(phi), 0.86f + r * y, r * c * std::sin(phi)};
        const Vec3 d = normalize(Vec3(tx, ty, tz)), side = normalize(cross(d, Vec3(0.1f, 0.3f, 0.9f)));
        add_facet(leaf, {at - side * s, at + d * s * 0.3f, at + side * s + d * s, at + d * s * 2.2f}, {Rgb(shade), {}});
    }
    return a;
}

Assembly rubbish_bag(Palette& palette, uint64_t seed) {
    Assembly a;
    const int plastic = palette("bin_bag", [](Scene&) { return matte("bin_bag", Rgb(0.018f), 0.28f); });
    add_sheet(a[plastic], 28, 18, [&](float s, float t) {
        const float phi = 2 * pi * s, up = t;
        const float belly = std::sin(pi * std::min(1.0f, 0.12f + 0.95f * up)) * 0.9f + 0.12f;
        const float crease =
            0.05f * (fractal_noise({s * 8, up * 4}, 8, 64, 3, seed) - 0.5f) + 0.012f * std::cos(phi * 11 + 3 * up) * up;
        const float r = 0.3f * belly * (up > 0.9f ? 1.2f * (1 - up) * 4 + 0.15f : 1.0f) + crease * (1 - up);
        return SheetPoint{{std::max(r, 0.02f) * std::sin(phi), 0.55f * up, std::max(r, 0.02f) * std::cos(phi)},
                          {phi * 0.3f, -up}};
    });
    return a;
}

}  // namespace pluvia
