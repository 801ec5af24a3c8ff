#include "scenes/window.h"

#include "scenes/materials.h"
#include "scenes/noise.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

struct Room {
    float curtains = 0.18f;  // share of the width that each side's curtain covers, 0.5 = closed
    float blind = 0;         // share of the height that a blind covers
    float depth = 0.02f;     // albedo of the room between them
    float glow = 0;          // brightness of the room relative to the curtains
    Rgb cloth = {0.42f, 0.4f, 0.36f};
};

Image<Rgba8> room_picture(const Room& room, uint64_t seed) {
    return paint_color(256, 256, [=](float x, float y) {
        const float fold = 0.5f + 0.5f * std::sin(2 * pi * (x * 13 + 1.2f * noise({x * 5, y * 2}, 5, 2, seed)));
        const float hem = 0.03f * noise({y * 5, 0.5f}, 5, 1, seed + 1);
        const float from_side = std::min(x, 1 - x) + (1 - y) * 0.05f * room.curtains;
        const bool on_curtain = from_side < room.curtains + hem;
        const bool on_blind = y < room.blind;
        if (on_blind && !on_curtain) {
            const float slat = joint(y * 30, 0.22f);
            return room.cloth * (1.15f - 0.75f * slat) * (0.8f + 0.2f * y / std::max(room.blind, 0.01f));
        }
        if (on_curtain) return room.cloth * (0.45f + 0.55f * fold);
        // The room: darker upwards by day; by night a lamp left of its middle and things before its back wall.
        const float lamp = std::exp(-9 * ((x - 0.42f) * (x - 0.42f) + (y - 0.35f) * (y - 0.35f)));
        const float thing = smooth_step(0.02f, -0.02f, 0.62f + 0.2f * noise({x * 7, 0.5f}, 7, 1, seed + 2) - y);
        const float wall = 0.55f + 0.6f * lamp;
        const float shade = std::lerp(room.depth * (0.6f + 0.8f * y), room.glow * wall, room.glow > 0 ? 1.0f : 0.0f);
        return Rgb(1, 0.94f, 0.85f) * (shade * (1 - 0.6f * thing));
    });
}

struct PaneKind {
    Room room;
    Rgb light = {};       // hue of its emission; black = unlit
    float luminance = 0;  // cd/m2 where the picture is white
};

PaneKind pane_kind(const std::string& kind) {
    if (kind == "curtain") return {{.curtains = 0.5f}, {}, 0};
    if (kind == "blind") return {{.curtains = 0, .blind = 0.62f, .cloth = {0.5f, 0.5f, 0.47f}}, {}, 0};
    if (kind == "lit_curtain") return {{.curtains = 0.5f, .cloth = {0.72f, 0.6f, 0.42f}}, incandescent, 38};
    if (kind == "lit_room") return {{.curtains = 0.2f, .glow = 0.9f, .cloth = {0.45f, 0.35f, 0.25f}}, halogen, 48};
    if (kind == "lit_blind") return {{.curtains = 0, .blind = 0.7f, .glow = 0.9f}, neutral_white, 40};
    if (kind == "lit_office") return {{.curtains = 0, .blind = 0.15f, .glow = 1}, fluorescent, 55};
    if (kind == "lit_pleats") return {{.curtains = 0.5f, .cloth = {0.85f, 0.82f, 0.76f}}, neutral_white, 85};
    if (kind == "lit_paper") return {{.curtains = 0, .blind = 1, .cloth = {0.8f, 0.72f, 0.55f}}, halogen, 120};
    if (kind == "lit_cafe") return {{.curtains = 0.06f, .glow = 1, .cloth = {0.5f, 0.2f, 0.1f}}, incandescent, 90};
    return {{.curtains = 0.16f}, {}, 0};
}

}  // namespace

int pane_finish(Palette& palette, const std::string& kind) {
    return palette("pane_" + kind, [&](Scene& scene) {
        const PaneKind k = pane_kind(kind);
        const int picture = add_texture(scene, room_picture(k.room, instance_id(kind)), Wrap::clamp);
        Material m = matte("pane_" + kind, Rgb(1), 0.03f);
        m.base_color_texture = picture;
        if (k.luminance > 0) {
            m.base_color = Rgb(0.6f);
            m.emission = nits(k.light, k.luminance);
            m.emission_texture = picture;
            m.lamp = true;
        }
        return m;
    });
}

std::string random_pane(Chance& chance, float lit) {
    static const char* const unlit_kinds[] = {"dark", "dark", "curtain", "blind", "dark"};
    static const char* const lit_kinds[] = {"lit_curtain", "lit_room", "lit_room", "lit_blind"};
    const float choice = chance(0, 1), which = chance(0, 1);
    return choice < lit ? lit_kinds[int(which * 4)] : unlit_kinds[int(which * 5)];
}

void add_pane(Assembly& assembly, int finish, const Opening& part, const Opening& whole, float z, Chance& chance) {
    Shape& shape = assembly[finish];
    const float lean_x = chance(-0.006f, 0.006f), lean_y = chance(-0.006f, 0.006f);
    const Vec3 normal = normalize(Vec3(lean_x, lean_y, 1));
    const int pieces = part.rise > 0 ? arch_pieces : 1;
    const uint32_t first = uint32_t(shape.positions.size());
    const auto add = [&](float x, float y) {
        shape.positions.push_back({x, y, z});
        shape.normals.push_back(normal);
        shape.uvs.push_back({(x - whole.left) / whole.width(), (whole.top - y) / whole.height()});
        shape.colors.push_back(Rgb(1));
    };
    for (int i = 0; i <= pieces; ++i) {
        const float x = part.left + part.width() * float(i) / float(pieces);
        add(x, part.bottom);
        add(x, part.head(x));
    }
    for (uint32_t i = 0; i < uint32_t(pieces); ++i) {
        const uint32_t a = first + 2 * i;
        shape.triangles.push_back({a, a + 2, a + 3});
        shape.triangles.push_back({a, a + 3, a + 1});
    }
}

void add_window(Assembly& assembly, Palette& palette, const Opening& o, float z, const WindowStyle& style,
                const std::string& pane, Chance& chance) {
    Shape& frame = assembly[palette(style.frame)];
    const int finish = pane_finish(palette, pane);
    const Tint tint = chance.tint(0.12f);
    constexpr float jamb = 0.06f, stile = 0.045f;
    const Opening inner = {o.left + jamb, o.right - jamb, o.bottom + jamb, o.top - jamb,
                           o.rise > 0 ? o.rise - 0.3f * jamb : 0};
    const auto bar = [&](float x0, float y0, float x1, float y1, float front, float depth, float bevel = 0.004f) {
        if (x1 - x0 > 2.1f * bevel && y1 - y0 > 2.1f * bevel)
            add_box(frame, {x0, y0, front - depth}, {x1, y1, front}, tint, bevel);
    };
    // The fixed frame, its head following the opening's.
    add_architrave(frame, {inner.left, inner.right, o.bottom, inner.top, inner.rise}, jamb, z - 0.1f, z, tint);
    bar(inner.left, o.bottom, inner.right, inner.bottom, z, 0.1f);
    const float meeting = style.sashes ? inner.bottom + 0.5f * inner.height() : inner.top;
    const auto sash = [&](float bottom, float top, float front, bool is_upper) {
        const Opening glass = {inner.left + stile, inner.right - stile, bottom + stile, top - stile,
                               is_upper && inner.rise > 0 ? inner.rise - 0.3f * stile : 0};
        add_pane(assembly, finish, glass, inner, front - 0.03f, chance);
        add_architrave(frame, {glass.left, glass.right, bottom, glass.top, glass.rise}, stile, front - 0.035f, front,
                       tint);
        bar(glass.left, bottom, glass.right, glass.bottom, front, 0.035f);
        for (int i = 1; i < style.columns; ++i) {
            const float x = glass.left + glass.width() * float(i) / float(style.columns);
            bar(x - 0.5f * style.bar, glass.bottom, x + 0.5f * style.bar, glass.head(x), front - 0.006f, 0.026f);
        }
        for (int i = 1; i < style.rows; ++i) {
            const float y = glass.bottom + (glass.height() - glass.rise) * float(i) / float(style.rows);
            bar(glass.left, y - 0.5f * style.bar, glass.right, y + 0.5f * style.bar, front - 0.007f, 0.026f);
        }
    };
    if (!style.sashes) return sash(inner.bottom, inner.top, z - 0.03f, true);
    sash(meeting - 0.02f, inner.top, z - 0.025f, true);
    sash(inner.bottom, meeting + 0.025f, z - 0.062f, false);
}

}  // namespace pluvia
