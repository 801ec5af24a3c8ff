#include "scenes/tenement.h"

#include "scenes/materials.h"
#include "scenes/moulding.h"
#include "scenes/noise.h"
#include "scenes/shop.h"
#include "scenes/window.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pluvia {
namespace {

constexpr float recess = -0.35f;

int down_light(Palette& palette) {
    return palette("down_light", [](Scene&) {
        Material m = matte("down_light", Rgb(0.8f), 0.4f);
        m.emission = nits(neutral_white, 7000);
        m.lamp = true;
        return m;
    });
}

class TenementBuilder {
public:
    TenementBuilder(Palette& palette, const Tenement& house)
        : p_(palette), h_(house), chance_{instance_id(house.name)} {}

    Assembly build() {
        ground_floor();
        float y = h_.ground_height;
        for (const char letter : h_.upper) storey(letter, y), y += h_.storey_height;
        parapet(y);
        body(y);
        pipes(y);
        for (auto& [finish, shape] : a_.shapes)  // dirt near the ground and below the parapet
            for (size_t i = 0; i < shape.positions.size(); ++i)
                if (shape.positions[i].z > -0.4f)
                    shape.colors[i] *= 0.62f + 0.38f * smooth_step(0, 0.8f, shape.positions[i].y);
        return std::move(a_);
    }

private:
    void ground_floor() {
        const size_t bays = h_.ground.size();
        const float pitch = h_.width / float(bays), head = h_.ground_height - 1.0f;
        std::vector<Opening> openings;
        for (size_t i = 0; i < bays; ++i) {
            const float left = pitch * float(i) + 0.22f, right = pitch * float(i + 1) - 0.22f,
                        middle = 0.5f * (left + right);
            const char letter = h_.ground[i];
            if (letter == 'b') continue;
            Opening o = {left, right, 0.08f, head, 0};
            if (letter == 'd') o = {std::max(left, middle - 0.75f), std::min(right, middle + 0.75f), 0.08f, head, 0};
            if (letter == 'w') o.bottom = 0.6f;
            openings.push_back(o);
            fill(letter, o);
        }
        add_wall(a_[p_(h_.base)], {0, -0.2f}, {h_.width, h_.ground_height}, 0, openings);
        for (const Opening& o : openings)
            add_reveal(a_[p_(h_.base)], o, 0, h_.ground[0] == 'd' ? -1.2f : recess - 0.1f);
        for (const Opening& o : openings)  // step of stone
            if (o.bottom < 0.3f)
                add_box(a_[p_("kerb_stone")], {o.left - 0.1f, -0.1f, -0.3f}, {o.right + 0.1f, 0.09f, 0.12f},
                        chance_.tint(0.15f), 0.015f);
        if (h_.canopy) {
            add_moulding(a_[p_("bronze_frame")],
                         {{0, head + 0.08f},
                          {0.75f, head + 0.1f},
                          {0.78f, head + 0.13f},
                          {0.78f, head + 0.24f},
                          {0.74f, head + 0.26f},
                          {0, head + 0.34f}},
                         0.05f, h_.width - 0.05f, 0);
        }
        // Lights in the soffit or on little arms.
        for (const Opening& o : openings)
            for (const float x : {o.left + 0.25f * o.width(), o.right - 0.25f * o.width()}) {
                const float y = h_.canopy ? head + 0.085f : o.top, z = h_.canopy ? 0.45f : -0.17f;
                Shape can, light;
                add_lathe(can, {{0.075f, -0.045f}, {0.085f, -0.05f}, {0.085f, 0.02f}}, 14, {0.5f, 0.1f});
                append(a_[p_("grey_paint")], can, translate({x, y, z}));
                add_lathe(light, {{0.001f, -0.036f}, {0.06f, -0.034f}, {0.074f, -0.03f}}, 12, {1, 1});
                append(a_[down_light(p_)], light, translate({x, y, z}));
            }
    }

    void fill(char letter, const Opening& o) {
        Shape& frame = a_[p_(h_.frame)];
        const auto bar = [&](float x0, float y0, float x1, float y1, float z, float depth) {
            add_box(frame, {x0, y0, z - depth}, {x1, y1, z}, {}, 0.005f);
        };
        switch (letter) {
            case 's': {  // slats of a roller shutter, its box above
                const float top = o.top - 0.28f;
                add_box(a_[p_("shutter")], {o.left, top, -0.3f}, {o.right, o.top, -0.06f}, {}, 0.01f);
                const Tint tint = chance_.tint(0.35f);
                const int slats = int((top - o.bottom) / 0.07f);
                for (int i = 0; i < slats; ++i) {
                    const float y = o.bottom + (top - o.bottom) * float(i) / float(slats),
                                h = (top - o.bottom) / float(slats);
                    add_sheet(
                        a_[p_("shutter")], 1, 6,
                        [&](float s, float t) {
                            return SheetPoint{{o.left + s * o.width(), y + t * h, -0.14f + 0.013f * std::sin(pi * t)},
                                              {s * o.width(), -y - t * h}};
                        },
                        tint);
                }
                bar(o.left, o.bottom, o.left + 0.05f, top, -0.1f, 0.12f);
                bar(o.right - 0.05f, o.bottom, o.right, top, -0.1f, 0.12f);
                bar(o.left, o.bottom, o.right, o.bottom + 0.06f, -0.11f, 0.06f);
                return;
            }
            case 'n': {
                const int paper = pane_finish(p_, "lit_paper");
                add_pane(a_, paper, o, o, -0.24f, chance_);
                Shape& wood = a_[p_("dark_wood")];
                const int bars = int(o.width() / 0.075f);
                for (int i = 0; i <= bars; ++i) {
                    const float x = o.left + 0.02f + (o.width() - 0.04f) * float(i) / float(bars),
                                half = i % (bars / 4) == 0 ? 0.03f : 0.012f;
                    add_box(wood, {x - half, o.bottom, -0.22f}, {x + half, o.top, half > 0.02f ? -0.15f : -0.18f},
                            chance_.tint(0.2f));
                }
                for (const float y : {o.bottom, o.bottom + 0.75f, o.top - 0.55f, o.top - 0.09f})
                    add_box(wood, {o.left, y, -0.21f}, {o.right, y + 0.09f, -0.14f}, chance_.tint(0.2f), 0.006f);
                // Noren: cloth in strips from a rod.
                const float rod = o.top - 0.42f;
                add_tube(wood, {{o.left + 0.05f, rod, 0.05f}, {o.right - 0.05f, rod, 0.05f}}, 0.016f, 8);
                const int strips = std::max(3, int(o.width() / 0.45f));
                for (int i = 0; i < strips; ++i) {
                    const float x0 = o.left + 0.08f + (o.width() - 0.16f) * float(i) / float(strips) + 0.006f,
                                w = (o.width() - 0.16f) / float(strips) - 0.012f;
                    const float phase = chance_(0, 6), swing = chance_(-0.04f, 0.04f);
                    for (const bool behind : {false, true})
                        add_sheet(a_[p_("awning_cloth")], 6, 6,
                                  [&](float s, float t) {
                                      const float u = behind ? 1 - s : s;
                                      return SheetPoint{{x0 + u * w, rod - 0.62f * (1 - t),
                                                         0.05f + (1 - t) * (swing + 0.03f * std::sin(phase + 7 * u)) -
                                                             (behind ? 0.003f : 0.0f)},
                                                        {u * w, (1 - t) * 0.62f}};
                                  },
                                  {h_.cloth, {}});
                }
                return;
            }
            case 'w':
                add_shop_window(a_, p_, o, h_.frame, chance_);
                add_shop_room(a_, p_,
                              {.left = o.left - 0.15f,
                               .right = o.right + 0.15f,
                               .floor = 0.1f,
                               .ceiling = o.top + 0.1f,
                               .front = recess - 0.1f,
                               .depth = 2.2f,
                               .light = fluorescent,
                               .luminance = 1600},
                              chance_);
                return;
            case 'd': {
                const float back = -1.2f;
                add_pane(a_, pane_finish(p_, "lit_office"),
                         {o.middle() - 0.4f, o.middle() + 0.4f, o.bottom, o.bottom + 2.05f, 0},
                         {o.left, o.right, o.bottom, o.top, 0}, back + 0.03f, chance_);
                add_facet(a_[p_("dark_mortar")], {Vec3{o.left, o.bottom, back},
                                                  {o.right, o.bottom, back},
                                                  {o.right, o.top, back},
                                                  {o.left, o.top, back}});
                add_architrave(frame, {o.middle() - 0.4f, o.middle() + 0.4f, o.bottom, o.bottom + 2.05f, 0}, 0.06f,
                               back, back + 0.06f);
                bar(o.middle() - 0.4f, o.bottom + 0.9f, o.middle() + 0.4f, o.bottom + 0.98f, back + 0.05f, 0.03f);
                return;
            }
            default: {  // glass doors in bronze frames, pleated curtains behind
                const int pane = pane_finish(p_, chance_(0, 1) < 0.75f ? "lit_pleats" : "lit_cafe");
                const float transom = o.top - 0.5f;
                add_pane(a_, pane, o, o, recess + 0.03f, chance_);
                add_facet(a_[p_("dark")], {Vec3{o.left, o.bottom, recess - 0.08f},
                                           {o.right, o.bottom, recess - 0.08f},
                                           {o.right, o.top, recess - 0.08f},
                                           {o.left, o.top, recess - 0.08f}});
                add_architrave(frame, {o.left + 0.07f, o.right - 0.07f, o.bottom, o.top - 0.07f, 0}, 0.07f, recess,
                               recess + 0.12f);
                bar(o.left + 0.07f, transom - 0.05f, o.right - 0.07f, transom + 0.05f, recess + 0.11f, 0.1f);
                const int leaves = std::max(2, int(o.width() / 0.85f));
                for (int i = 0; i <= leaves; ++i) {
                    const float x = std::clamp(o.left + 0.07f + (o.width() - 0.14f) * float(i) / float(leaves),
                                               o.left + 0.1f, o.right - 0.1f);
                    bar(x - 0.035f, o.bottom, x + 0.035f, transom - 0.05f, recess + 0.09f, 0.05f);
                }
                bar(o.left + 0.07f, o.bottom, o.right - 0.07f, o.bottom + 0.16f, recess + 0.085f, 0.05f);
                const float handle = o.middle() + 0.1f;
                add_tube(a_[p_("chrome")],
                         rounded({{handle, 0.85f, recess + 0.09f},
                                  {handle, 0.85f, recess + 0.16f},
                                  {handle, 1.35f, recess + 0.16f},
                                  {handle, 1.35f, recess + 0.09f}},
                                 0.03f),
                         0.014f, 8);
            }
        }
    }

    void storey(char letter, float y) {
        std::vector<Opening> openings;
        const float sill = y + 0.95f, top = y + h_.storey_height - 0.55f;
        if (letter == 'r') openings.push_back({0.5f, h_.width - 0.5f, sill, top, 0});
        if (letter == 'p') {
            const int count = std::max(1, int(h_.width / 2.6f));
            for (int i = 0; i < count; ++i) {
                const float middle = h_.width * (float(i) + 0.5f) / float(count);
                openings.push_back({middle - 0.8f, middle + 0.8f, sill - 0.1f, top, 0});
            }
        }
        add_wall(a_[p_(h_.wall)], {0, y}, {h_.width, y + h_.storey_height}, 0, openings);
        for (const Opening& o : openings) {
            add_reveal(a_[p_(h_.wall)], o, 0, -0.25f);
            add_moulding(a_[p_("aluminium")],
                         {{0, o.bottom - 0.05f},
                          {0.06f, o.bottom - 0.05f},
                          {0.065f, o.bottom - 0.01f},
                          {-0.1f, o.bottom + 0.01f}},
                         o.left - 0.04f, o.right + 0.04f, -0.1f);
            const int panes = std::max(2, int(o.width() / 0.85f));
            const bool office = chance_(0, 1) < 0.5f;
            for (int i = 0; i < panes; ++i) {
                const float left = o.left + o.width() * float(i) / float(panes),
                            right = o.left + o.width() * float(i + 1) / float(panes);
                const std::string pane =
                    chance_(0, 1) < h_.lit ? (office ? "lit_office" : "lit_pleats") : random_pane(chance_, 0);
                add_window(a_, p_, {left + 0.003f, right - 0.003f, o.bottom, o.top, 0}, -0.08f - 0.03f * float(i % 2),
                           {.frame = "aluminium", .columns = 1, .rows = 1, .sashes = false}, pane, chance_);
            }
        }
    }

    void parapet(float y) {
        add_band(a_[p_(h_.wall)], 0, h_.width, y - 0.05f, y + 0.7f, 0.03f);
        add_moulding(a_[p_("aluminium")],
                     {{0.03f, y + 0.66f}, {0.07f, y + 0.66f}, {0.075f, y + 0.73f}, {-0.25f, y + 0.74f}}, -0.01f,
                     h_.width + 0.01f, -0.25f);
    }

    void body(float top) {
        const float w = h_.width, back = -h_.depth;
        Shape& wall = a_[p_(h_.wall)];
        top += 0.7f;
        add_facet(wall, {Vec3{w, -0.2f, 0}, {w, -0.2f, back}, {w, top, back}, {w, top, 0}});
        add_facet(wall, {Vec3{0, -0.2f, back}, {0, -0.2f, 0}, {0, top, 0}, {0, top, back}});
        add_facet(wall, {Vec3{w, -0.2f, back}, {0, -0.2f, back}, {0, top, back}, {w, top, back}});
        Shape& dark = a_[p_("dark")];
        add_facet(dark,
                  {Vec3{0, top - 0.7f, -0.05f}, {w, top - 0.7f, -0.05f}, {w, top - 0.7f, back}, {0, top - 0.7f, back}});
        add_facet(
            dark,
            {Vec3{0, h_.ground_height, -0.45f}, {w, h_.ground_height, -0.45f}, {w, top, -0.45f}, {0, top, -0.45f}});
    }

    void pipes(float top) {
        const int count = 1 + int(h_.width > 6);
        for (int i = 0; i < count; ++i) {
            const float x = i == 0 ? 0.1f : h_.width - 0.12f, radius = chance_(0.025f, 0.045f);
            add_tube(a_[p_(chance_(0, 1) < 0.5f ? "grey_paint" : "bronze_frame")],
                     {{x, 0.05f, 0.09f}, {x, top + 0.3f, 0.09f}}, radius, 9);
            for (float y = 0.6f; y < top; y += 1.5f)
                add_box(a_[p_("iron")], {x - radius - 0.02f, y, 0},
                        {x + radius + 0.02f, y + 0.03f, 0.09f + radius + 0.008f});
        }
    }

    Palette& p_;
    const Tenement& h_;
    Chance chance_;
    Assembly a_;
};

}  // namespace

Assembly tenement(Palette& palette, const Tenement& house) {
    return TenementBuilder(palette, house).build();
}

}  // namespace pluvia
