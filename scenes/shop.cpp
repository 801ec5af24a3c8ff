#include "scenes/shop.h"

#include "scenes/characters.h"
#include "scenes/materials.h"
#include "scenes/moulding.h"
#include "scenes/window.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

int goods_finish(Palette& palette) {
    return palette("goods", [](Scene&) { return matte("goods", Rgb(0.75f), 0.45f); });
}

/// Something for sale that stands on y at (x, z), no wider than `width`: a box, a bottle, a jar, books.
void add_ware(Assembly& assembly, Palette& palette, float x, float y, float z, float width, Chance& chance) {
    static const Rgb colors[] = {{0.8f, 0.12f, 0.08f}, {0.9f, 0.65f, 0.1f}, {0.15f, 0.35f, 0.6f}, {0.85f, 0.82f, 0.75f},
                                 {0.2f, 0.45f, 0.2f},  {0.5f, 0.25f, 0.1f}, {0.9f, 0.4f, 0.15f},  {0.25f, 0.2f, 0.3f}};
    const float which = chance(0, 8), kind = chance(0, 4), h = chance(0.6f, 1.5f) * width;
    const Tint tint = {colors[int(which)], {}};
    Shape& shape = assembly[goods_finish(palette)];
    const float r = 0.4f * width;
    if (kind < 2) {
        add_box(shape, {x - r, y, z - r}, {x + r, y + h, z + r}, tint, 0.05f * width);
        return;
    }
    Shape turned;
    if (kind < 3)
        add_lathe(turned, {{r * 0.8f, 0}, {r * 0.8f, h * 0.6f}, {r * 0.3f, h * 0.8f}, {r * 0.3f, h}, {0.001f, h}}, 8,
                  {1, 1}, tint);
    else
        add_lathe(turned, {{r * 0.7f, 0}, {r, h * 0.25f}, {r, h * 0.6f}, {r * 0.75f, h * 0.75f}, {0.001f, h * 0.78f}},
                  9, {1, 1}, tint);
    append(shape, turned, translate({x, y, z}));
}

void add_table(Assembly& a, Palette& palette, float x, float z, float floor, Chance& chance) {
    Shape top, leg;
    add_lathe(top, {{0.36f, 0.71f}, {0.37f, 0.735f}, {0.355f, 0.745f}, {0.001f, 0.746f}}, 18, {2, 1});
    append(a[palette("golden_oak")], top, translate({x, floor, z}));
    add_lathe(leg, {{0.24f, 0}, {0.2f, 0.02f}, {0.03f, 0.05f}, {0.025f, 0.71f}}, 10, {0.2f, 0.7f});
    append(a[palette("iron")], leg, translate({x, floor, z}));
    for (const float side : {-1.0f, 1.0f}) {  // bentwood chairs
        const Transform at = translate({x + 0.62 * side, floor, z + chance(-0.1f, 0.1f)}) * rotate_y(-side * 1.5708);
        Shape chair;
        add_box(chair, {-0.2f, 0.43f, -0.2f}, {0.2f, 0.46f, 0.2f}, {}, 0.01f);
        for (const float i : {-0.17f, 0.17f})
            for (const float j : {-0.17f, 0.17f}) add_tube(chair, {{i, 0, j}, {i * 0.9f, 0.44f, j * 0.9f}}, 0.015f, 6);
        add_tube(
            chair,
            rounded({{-0.18f, 0.45f, -0.18f}, {-0.19f, 0.86f, -0.24f}, {0.19f, 0.86f, -0.24f}, {0.18f, 0.45f, -0.18f}},
                    0.15f, 5),
            0.014f, 6);
        append(a[palette("dark_wood")], chair, at);
    }
}

}  // namespace

void add_shop_room(Assembly& a, Palette& palette, const ShopRoom& r, Chance& chance) {
    const float back = r.front - r.depth;
    Shape& walls = a[palette(r.walls)];
    add_facet(
        walls,
        {Vec3{r.left, r.floor, back}, {r.right, r.floor, back}, {r.right, r.ceiling, back}, {r.left, r.ceiling, back}});
    add_facet(walls, {Vec3{r.left, r.floor, r.front},
                      {r.left, r.floor, back},
                      {r.left, r.ceiling, back},
                      {r.left, r.ceiling, r.front}});
    add_facet(walls, {Vec3{r.right, r.floor, back},
                      {r.right, r.floor, r.front},
                      {r.right, r.ceiling, r.front},
                      {r.right, r.ceiling, back}});
    add_facet(walls, {Vec3{r.left, r.ceiling, back},
                      {r.right, r.ceiling, back},
                      {r.right, r.ceiling, r.front},
                      {r.left, r.ceiling, r.front}});
    for (float x = r.left; x < r.right - 1e-3f; x += 0.3f)  // floor boards
        add_facet(a[palette("golden_oak")],
                  {Vec3{x, r.floor, r.front},
                   {std::min(x + 0.3f, r.right), r.floor, r.front},
                   {std::min(x + 0.3f, r.right), r.floor, back},
                   {x, r.floor, back}},
                  chance.tint(0.3f));
    const int light = palette("shop_light", [&](Scene&) {
        Material m = matte("shop_light", Rgb(0.8f));
        m.emission = nits(r.light, r.luminance);
        m.lamp = true;
        return m;
    });
    const int rows = std::max(1, int((r.right - r.left) / 1.8f));
    for (int i = 0; i < rows; ++i)
        for (const float z : {0.25f, 0.7f}) {
            const float x = r.left + (r.right - r.left) * (float(i) + 0.5f) / float(rows), at = r.front - z * r.depth;
            const float y = r.ceiling - 0.04f;
            add_facet(a[light], {Vec3{x - 0.45f, y, at - 0.12f},
                                 {x + 0.45f, y, at - 0.12f},
                                 {x + 0.45f, y, at + 0.12f},
                                 {x - 0.45f, y, at + 0.12f}});
            add_box(a[palette("white_paint")], {x - 0.48f, y + 0.002f, at - 0.15f}, {x + 0.48f, r.ceiling, at + 0.15f});
        }
    if (r.cafe) {
        for (float x = r.left + 1; x < r.right - 0.9f; x += 1.9f)
            for (const float z : {0.9f, 2.3f}) add_table(a, palette, x, r.front - z, r.floor, chance);
    }
    // Shelves on the back wall; in a café only above the counter.
    const float shelf_left = r.left + 0.15f, shelf_right = r.right - 0.15f;
    for (float y = r.floor + (r.cafe ? 1.5f : 0.35f); y < r.ceiling - 0.6f; y += 0.42f) {
        add_box(a[palette("timber")], {shelf_left, y - 0.03f, back + 0.01f}, {shelf_right, y, back + 0.36f}, {},
                0.004f);
        for (float x = shelf_left + 0.12f; x < shelf_right - 0.1f;) {
            const float w = chance(0.1f, 0.24f), gone = chance(0, 1);
            if (gone > 0.15f) add_ware(a, palette, x, y, back + 0.2f, w, chance);
            x += w * 1.1f;
        }
    }
    add_box(a[palette("dark_wood")], {r.left + 0.3f, r.floor, back + 0.9f}, {r.right - 0.9f, r.floor + 1, back + 1.4f},
            {}, 0.015f);
}

void add_shop_window(Assembly& a, Palette& palette, const Opening& o, const std::string& frame, Chance& chance) {
    Shape& wood = a[palette(frame)];
    constexpr float jamb = 0.075f;
    const float transom = o.top - 0.55f, z = -0.06f;
    const auto bar = [&](float x0, float y0, float x1, float y1) {
        add_box(wood, {x0, y0, z - 0.09f}, {x1, y1, z}, {}, 0.008f);
    };
    add_architrave(wood, {o.left + jamb, o.right - jamb, o.bottom, o.top - jamb, o.rise}, jamb, z - 0.09f, z);
    bar(o.left + jamb, o.bottom, o.right - jamb, o.bottom + 0.09f);
    if (o.rise == 0) bar(o.left + jamb, transom - 0.03f, o.right - jamb, transom + 0.03f);
    const int lights = std::max(2, int(o.width() / 0.6f));
    for (int i = 1; i < lights && o.rise == 0; ++i) {
        const float x = o.left + o.width() * float(i) / float(lights);
        bar(x - 0.013f, transom + 0.03f, x + 0.013f, o.top - jamb);
    }
    if (o.width() > 2.2f) bar(o.middle() - 0.03f, o.bottom + 0.09f, o.middle() + 0.03f, transom - 0.03f);
    add_pane(a, palette("shop_glass"), {o.left + jamb, o.right - jamb, o.bottom + 0.05f, o.top - jamb, o.rise}, o,
             z - 0.045f, chance);
    // Display: a plinth under the pane with wares in two rows.
    const float top = o.bottom + 0.05f;
    add_box(a[palette("white_paint")], {o.left + 0.02f, top - 0.06f, z - 0.85f}, {o.right - 0.02f, top, z - 0.1f});
    for (const float row : {0.25f, 0.55f})
        for (float x = o.left + 0.2f; x < o.right - 0.2f;) {
            const float w = chance(0.14f, 0.34f);
            add_ware(a, palette, x, top, z - 0.1f - row, w, chance);
            x += w * 1.25f;
        }
}

void add_shop_door(Assembly& a, Palette& palette, const Opening& o, float z, const std::string& frame,
                   const std::string& pane, Chance& chance) {
    Shape& wood = a[palette(frame)];
    constexpr float jamb = 0.07f, stile = 0.11f;
    const float head = o.bottom + 2.15f < o.top - o.rise - 0.1f ? o.bottom + 2.15f : o.top - o.rise;
    const int glass = pane.empty() ? palette("shop_glass") : pane_finish(palette, pane);
    add_architrave(wood, {o.left + jamb, o.right - jamb, o.bottom, o.top - jamb, o.rise > 0 ? o.rise - 0.02f : 0}, jamb,
                   z - 0.1f, z);
    const auto bar = [&](float x0, float y0, float x1, float y1, float front, float depth) {
        add_box(wood, {x0, y0, front - depth}, {x1, y1, front}, {}, 0.006f);
    };
    bar(o.left + jamb, head - 0.04f, o.right - jamb, head + 0.04f, z, 0.1f);
    const Opening whole = {o.left + jamb, o.right - jamb, o.bottom, o.top - jamb, 0};
    add_pane(a, glass, {whole.left, whole.right, head + 0.04f, whole.top, o.rise > 0 ? o.rise - 0.02f : 0}, whole,
             z - 0.06f, chance);
    const int leaves = o.width() > 1.5f ? 2 : 1;
    for (int leaf = 0; leaf < leaves; ++leaf) {
        const float left = whole.left + whole.width() * float(leaf) / float(leaves) + 0.004f;
        const float right = whole.left + whole.width() * float(leaf + 1) / float(leaves) - 0.004f;
        const float kick = o.bottom + 0.55f, top = head - 0.045f, front = z - 0.03f;
        bar(left, o.bottom + 0.01f, left + stile, top, front, 0.045f);
        bar(right - stile, o.bottom + 0.01f, right, top, front, 0.045f);
        bar(left + stile, top - stile, right - stile, top, front, 0.045f);
        bar(left + stile, o.bottom + 0.01f, right - stile, o.bottom + 0.18f, front, 0.045f);
        bar(left + stile, kick - 0.06f, right - stile, kick + 0.06f, front, 0.045f);
        bar(left + stile + 0.03f, o.bottom + 0.21f, right - stile - 0.03f, kick - 0.09f, front - 0.012f, 0.02f);
        add_facet(wood, {Vec3{left + stile, o.bottom + 0.18f, front - 0.025f},
                         {right - stile, o.bottom + 0.18f, front - 0.025f},
                         {right - stile, kick - 0.06f, front - 0.025f},
                         {left + stile, kick - 0.06f, front - 0.025f}});
        const Opening light = {left + stile, right - stile, kick + 0.06f, top - stile, 0};
        add_pane(a, glass, light, whole, front - 0.025f, chance);
        const float x = light.middle();
        bar(x - 0.012f, light.bottom, x + 0.012f, light.top, front - 0.008f, 0.022f);
        for (int i = 1; i < 3; ++i) {
            const float y = light.bottom + light.height() * float(i) / 3;
            bar(light.left, y - 0.012f, light.right, y + 0.012f, front - 0.009f, 0.022f);
        }
        const float handle = leaf == 0 && leaves == 2 ? right - 0.055f : leaf == 0 ? right - 0.055f : left + 0.055f;
        add_tube(a[palette("brass")],
                 rounded({{handle, 1.0f + o.bottom, front},
                          {handle, 1.0f + o.bottom, front + 0.06f},
                          {handle, 1.3f + o.bottom, front + 0.06f},
                          {handle, 1.3f + o.bottom, front}},
                         0.03f),
                 0.011f, 7);
    }
}

void add_fascia(Assembly& a, Palette& palette, const Fascia& f) {
    Shape& board = a[palette(f.board)];
    add_band(board, f.left, f.right, f.bottom, f.top, 0.08f);
    add_moulding(board,
                 {{0.08f, f.top - 0.02f},
                  {0.14f, f.top + 0.01f},
                  {0.16f, f.top + 0.03f},
                  {0.16f, f.top + 0.07f},
                  {0.2f, f.top + 0.1f},
                  {0.2f, f.top + 0.12f},
                  {-0.02f, f.top + 0.15f}},
                 f.left - 0.04f, f.right + 0.04f, -0.02f);
    const float middle = 0.5f * (f.left + f.right),
                height = std::min(0.52f * (f.top - f.bottom),
                                  0.8f * (f.right - f.left) / std::max(1.0f, text_width(f.text, 1)));
    const float start = middle - 0.5f * text_width(f.text, height), base = 0.5f * (f.bottom + f.top) - 0.5f * height;
    for (const Stroke& path : text_paths(f.text, height)) {  // letters of round bar on the board
        std::vector<Vec3> bar;
        for (const Vec2 p : path) bar.push_back({start + p.x, base + p.y, 0.1f});
        add_tube(a[palette(f.letters)], bar, 0.055f * height, 6);
    }
    flatten_creases(a[palette(f.letters)]);
    if (!f.lamps) return;
    const int count = std::max(2, int((f.right - f.left) / 1.6f));
    const int bulb = palette("fascia_lamp", [](Scene&) {
        Material m = matte("fascia_lamp", Rgb(0.8f), 0.4f);
        m.emission = nits(incandescent, 9000);
        m.lamp = true;
        return m;
    });
    for (int i = 0; i < count; ++i) {  // swan necks
        const float x = f.left + (f.right - f.left) * (float(i) + 0.5f) / float(count), y = f.top + 0.18f;
        add_tube(a[palette("black_paint")],
                 rounded({{x, y, 0}, {x, y + 0.28f, 0.05f}, {x, y + 0.3f, 0.5f}, {x, y + 0.12f, 0.52f}}, 0.16f, 6),
                 0.012f, 7);
        Shape shade, glow;
        add_lathe(shade, {{0.13f, -0.1f}, {0.11f, -0.04f}, {0.06f, 0.02f}, {0.03f, 0.06f}, {0.012f, 0.08f}}, 14,
                  {0.6f, 0.2f});
        append(a[palette("black_paint")], shade, translate({x, y + 0.06, 0.52}));
        add_lathe(glow, {{0.001f, -0.105f}, {0.028f, -0.085f}, {0.034f, -0.06f}, {0.02f, -0.03f}, {0.001f, -0.02f}}, 10,
                  {1, 1});
        append(a[bulb], glow, translate({x, y + 0.06, 0.52}));
    }
}

void add_awning(Assembly& a, Palette& palette, const Awning& w) {
    const int stripes = std::max(2, int((w.right - w.left) / 0.26f));
    Shape& cloth = a[palette("awning_cloth")];
    const float low = w.y - w.fall;
    for (int i = 0; i < stripes; ++i) {
        const float x0 = w.left + (w.right - w.left) * float(i) / float(stripes),
                    x1 = w.left + (w.right - w.left) * float(i + 1) / float(stripes);
        const Tint tint = {i % 2 == 0 ? w.stripe_a : w.stripe_b, {}};
        const auto sag = [&](float t) { return 0.05f * std::sin(pi * t); };
        add_sheet(
            cloth, 2, 6,
            [&](float s, float t) {  // seen from above
                return SheetPoint{{x0 + s * (x1 - x0), low + t * w.fall - sag(t), w.reach * (1 - t)},
                                  {s * (x1 - x0), -t * w.reach}};
            },
            tint);
        add_sheet(cloth, 2, 6,
                  [&](float s, float t) {  // from below
                      return SheetPoint{
                          {x1 - s * (x1 - x0), low + t * w.fall - sag(t) - 0.004f, w.reach * (1 - t) - 0.002f},
                          {s * (x1 - x0), -t * w.reach}};
                  },
                  {tint.color * 0.8f, {}});
        const auto hem = [&](float s) { return 0.2f + 0.06f * std::sin(pi * s); };
        add_sheet(
            cloth, 6, 1,
            [&](float s, float t) {  // valance with a scalloped hem
                return SheetPoint{{x0 + s * (x1 - x0), low - (1 - t) * hem(s), w.reach},
                                  {s * (x1 - x0), (1 - t) * 0.2f}};
            },
            tint);
        add_sheet(
            cloth, 6, 1,
            [&](float s, float t) {
                return SheetPoint{{x1 - s * (x1 - x0), low - (1 - t) * hem(1 - s), w.reach - 0.004f},
                                  {s * (x1 - x0), (1 - t) * 0.2f}};
            },
            tint);
    }
    for (const float x : {w.left, w.right}) {  // sides and arms
        add_facet(cloth, {Vec3{x, low, 0}, {x, low, w.reach}, {x, low + 0.01f, w.reach}, {x, w.y, 0}},
                  {w.stripe_a * 0.9f, {}});
        add_tube(a[palette("iron")], {{x, low - 0.35f, 0.02f}, {x, low + 0.0f, w.reach - 0.02f}}, 0.012f, 6);
    }
    add_tube(a[palette("iron")], {{w.left, low, w.reach - 0.02f}, {w.right, low, w.reach - 0.02f}}, 0.016f, 7);
    add_tube(a[palette("white_paint")], {{w.left - 0.05f, w.y + 0.05f, 0.08f}, {w.right + 0.05f, w.y + 0.05f, 0.08f}},
             0.07f, 10);
}

}  // namespace pluvia
