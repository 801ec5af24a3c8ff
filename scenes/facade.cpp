#include "scenes/facade.h"

#include "scenes/moulding.h"
#include "scenes/noise.h"
#include "scenes/shop.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pluvia {
namespace {

constexpr float window_face = -0.13f, reveal_back = -0.25f;
constexpr float stoop_height = 0.75f;

class HouseBuilder {
public:
    HouseBuilder(Palette& palette, const TownHouse& house) : p_(palette), h_(house), chance_{instance_id(house.name)} {}

    Assembly build() {
        ground_floor();
        float y = h_.ground_height;
        for (size_t i = 0; i < h_.storeys.size(); ++i) {
            storey(y, h_.storeys[i], i == 0);
            y += h_.storeys[i];
        }
        if (h_.quoins)
            for (const bool right : {false, true})
                add_quoins(a_[p_(h_.trim)], right ? h_.width : 0, right ? -1 : 1, h_.ground_height + 0.3f, y, 0.035f);
        const float top = add_cornice(a_[p_(h_.cornice)], 0, h_.width, y - 0.1f, 0.62f, 0.95f);
        body(top);
        if (h_.fire_escape) {
            std::vector<float> floors;
            float floor = h_.ground_height;
            for (const float height : h_.storeys) floors.push_back(floor + 0.35f), floor += height;
            add_fire_escape(a_, p_, 0.5f * h_.width - 1.7f, 0.5f * h_.width + 1.7f, floors);
        }
        downpipe(y);
        splashes();
        return std::move(a_);
    }

private:
    static bool is_shop(char letter) { return letter == 'S' || letter == 'E'; }
    static bool is_arch(char letter) { return letter == 'a' || letter == 'A'; }

    Opening ground_opening(char letter, float left, float right) const {
        const float middle = 0.5f * (left + right), top = h_.ground_height - 0.9f;
        switch (letter) {
            case 'S':
                return {left + 0.16f, right - 0.16f, 0.62f, top, 0};
            case 'E':
                return {middle - 0.62f, middle + 0.62f, 0.06f, top, 0};
            case 'a':
                return {middle - 0.85f, middle + 0.85f, 0.1f, top, 0.8f};
            case 'A':
                return {middle - 0.5f, middle + 0.5f, 0.1f, top, 0.5f};
            case 'd':
                return {middle - 0.62f, middle + 0.62f, stoop_height, std::min(top + 0.2f, stoop_height + 2.9f), 0};
            default:
                return {middle - 0.62f, middle + 0.62f, 1.05f, top - 0.05f, 0};
        }
    }

    void ground_floor() {
        const size_t bays = h_.ground.size();
        const float pitch = h_.width / float(bays);
        std::vector<Opening> openings;
        for (size_t i = 0; i < bays; ++i) {
            const char letter = h_.ground[i];
            const float left = pitch * float(i), right = left + pitch;
            if (letter == 'b') continue;
            const Opening o = ground_opening(letter, left, right);
            openings.push_back(o);
            fill_ground(letter, o);
        }
        const float top = h_.ground_height - 0.12f;
        add_wall(a_[p_(h_.base)], {0, -0.1f}, {h_.width, top}, 0, openings);
        for (const Opening& o : openings) add_reveal(a_[p_(h_.base)], o, 0, reveal_back);
        plinth(openings);
        piers(pitch);
        add_moulding(a_[p_(h_.trim)],
                     {{0, top - 0.1f},
                      {0.05f, top - 0.06f},
                      {0.07f, top},
                      {0.16f, top + 0.04f},
                      {0.17f, top + 0.1f},
                      {0.14f, top + 0.14f},
                      {-0.1f, top + 0.17f}},
                     0, h_.width, -0.1f);
        rooms(pitch);
        if (!h_.sign.empty()) {
            const float bottom = h_.ground_height - 0.82f;
            add_fascia(a_, p_,
                       {.left = 0.15f,
                        .right = h_.width - 0.15f,
                        .bottom = bottom,
                        .top = bottom + 0.56f,
                        .text = h_.sign,
                        .board = h_.shop_paint,
                        .letters = "brass"});
            if (h_.awning)
                for (size_t i = 0; i < bays; ++i)
                    if (h_.ground[i] == 'S')
                        add_awning(a_, p_,
                                   {.left = pitch * float(i) + 0.12f,
                                    .right = pitch * float(i + 1) - 0.12f,
                                    .y = bottom - 0.02f,
                                    .stripe_a = h_.awning_color});
        }
    }

    /// Runs along the foot of the wall, but not across doors.
    void plinth(std::vector<Opening> openings) {
        float x = 0;
        openings.push_back({h_.width, h_.width, 0, 1, 0});
        for (const Opening& o : openings) {
            if (o.bottom > 0.5f) continue;
            if (o.left - x > 0.05f) add_band(a_[p_(h_.base)], x, o.left, -0.1f, 0.42f, 0.05f);
            x = o.right;
        }
    }

    void fill_ground(char letter, const Opening& o) {
        switch (letter) {
            case 'S':
                return add_shop_window(a_, p_, o, h_.shop_paint, chance_);
            case 'E':
                return add_shop_door(a_, p_, o, -0.16f, h_.shop_paint, "", chance_);
            case 'a':
                return add_shop_door(a_, p_, o, -0.1f, "golden_oak", "lit_cafe", chance_);
            case 'A':
                return add_shop_door(a_, p_, o, -0.1f, "golden_oak", "lit_cafe", chance_);
            case 'd': {
                add_shop_door(a_, p_, o, window_face, chance_(0, 1) < 0.5f ? "black_paint" : "green_paint", "lit_room",
                              chance_);
                add_architrave(a_[p_(h_.trim)], {o.left, o.right, o.bottom, o.top, 0}, 0.2f, 0, 0.09f);
                add_moulding(a_[p_(h_.trim)],
                             {{0, o.top + 0.3f},
                              {0.2f, o.top + 0.34f},
                              {0.32f, o.top + 0.42f},
                              {0.34f, o.top + 0.5f},
                              {0, o.top + 0.56f}},
                             o.left - 0.32f, o.right + 0.32f, 0);
                for (const float x : {o.left - 0.22f, o.right + 0.08f})
                    add_box(a_[p_(h_.trim)], {x, o.top + 0.06f, 0}, {x + 0.14f, o.top + 0.34f, 0.18f}, {}, 0.02f);
                return add_stoop(a_, p_, o.middle(), o.width() + 0.5f, o.bottom, 4);
            }
            default:
                add_window(a_, p_, o, window_face, h_.window, random_pane(chance_, h_.lit), chance_);
                add_architrave(a_[p_(h_.trim)], o, 0.14f, 0, 0.05f);
                add_sill(a_[p_(h_.trim)], o.left - 0.2f, o.right + 0.2f, o.bottom, 0.13f, 0.13f);
        }
    }

    /// Pilasters between the bays of a shop.
    void piers(float pitch) {
        if (h_.sign.empty()) return;
        for (size_t i = 0; i <= h_.ground.size(); ++i) {
            const float x = std::clamp(pitch * float(i), 0.14f, h_.width - 0.14f), top = h_.ground_height - 0.84f;
            Shape& shape = a_[p_(h_.base)];
            add_box(shape, {x - 0.12f, 0.45f, 0}, {x + 0.12f, top - 0.2f, 0.1f}, chance_.tint(0.1f), 0.014f);
            add_box(shape, {x - 0.15f, -0.05f, 0}, {x + 0.15f, 0.45f, 0.13f}, chance_.tint(0.1f), 0.014f);
            add_moulding(shape,
                         {{0.1f, top - 0.2f},
                          {0.12f, top - 0.16f},
                          {0.12f, top - 0.1f},
                          {0.17f, top - 0.04f},
                          {0.17f, top},
                          {0, top + 0.01f}},
                         x - 0.16f, x + 0.16f, 0);
        }
    }

    void rooms(float pitch) {
        for (size_t i = 0; i < h_.ground.size();) {
            size_t end = i;
            while (end < h_.ground.size() && is_shop(h_.ground[end])) ++end;
            if (end > i)
                add_shop_room(a_, p_,
                              {.left = pitch * float(i) + 0.1f,
                               .right = pitch * float(end) - 0.1f,
                               .floor = 0.05f,
                               .ceiling = h_.ground_height - 0.75f,
                               .front = reveal_back,
                               .cafe = h_.cafe},
                              chance_);
            i = std::max(end, i + 1);
        }
    }

    void storey(float y, float height, bool is_first) {
        const float pitch = h_.width / float(h_.upper.size());
        std::vector<Opening> openings;
        for (size_t i = 0; i < h_.upper.size(); ++i) {
            const float middle = pitch * (float(i) + 0.5f), sill = y + 0.75f,
                        top = y + height - (is_first ? 0.5f : 0.6f);
            if (h_.upper[i] == 'b') continue;
            const float half = std::min(0.6f, 0.34f * pitch);
            if (h_.upper[i] == 'p') {
                openings.push_back({middle - 1.08f, middle - 0.1f, sill, top, h_.arch});
                openings.push_back({middle + 0.1f, middle + 1.08f, sill, top, h_.arch});
            } else {
                openings.push_back({middle - half, middle + half, sill, top, h_.arch});
            }
        }
        add_wall(a_[p_(h_.wall)], {0, y}, {h_.width, y + height}, 0, openings);
        for (const Opening& o : openings) {
            add_reveal(a_[p_(h_.wall)], o, 0, reveal_back);
            add_window(a_, p_, o, window_face, h_.window, random_pane(chance_, h_.lit), chance_);
            Shape& trim = a_[p_(h_.trim)];
            add_sill(trim, o.left - 0.12f, o.right + 0.12f, o.bottom, 0.11f, 0.12f, chance_.tint(0.1f));
            if (h_.hoods) {
                add_architrave(trim, o, 0.15f, 0, 0.05f, chance_.tint(0.1f));
                if (o.rise == 0) {
                    const float t = o.top + 0.2f;
                    add_moulding(trim,
                                 {{0, t}, {0.05f, t + 0.02f}, {0.13f, t + 0.08f}, {0.15f, t + 0.14f}, {0, t + 0.19f}},
                                 o.left - 0.26f, o.right + 0.26f, 0);
                    for (const float x : {o.left - 0.2f, o.right + 0.07f})
                        add_box(trim, {x, t - 0.2f, 0}, {x + 0.13f, t + 0.03f, 0.1f}, {}, 0.015f);
                }
            } else {
                add_head_stones(trim, o, 0.26f, 0, 0.02f, o.rise > 0 ? 13 : 9, 1);
            }
        }
        if (!is_first) add_band(a_[p_(h_.trim)], 0, h_.width, y + 0.02f, y + 0.2f, 0.035f);
    }

    /// What is behind the facade: sides, back and roof, and the dark behind the panes.
    void body(float top) {
        const float w = h_.width, back = -h_.depth;
        Shape& wall = a_[p_(h_.wall)];
        add_facet(wall, {Vec3{w, 0, 0}, {w, 0, back}, {w, top, back}, {w, top, 0}});
        add_facet(wall, {Vec3{0, 0, back}, {0, 0, 0}, {0, top, 0}, {0, top, back}});
        add_facet(wall, {Vec3{w, 0, back}, {0, 0, back}, {0, top, back}, {w, top, back}});
        add_facet(a_[p_("dark")],
                  {Vec3{0, top - 0.4f, -0.1f}, {w, top - 0.4f, -0.1f}, {w, top - 0.4f, back}, {0, top - 0.4f, back}});
        Shape& dark = a_[p_("dark")];
        add_facet(dark, {Vec3{0, h_.ground_height, -0.4f},
                         {w, h_.ground_height, -0.4f},
                         {w, top - 0.4f, -0.4f},
                         {0, top - 0.4f, -0.4f}});
        if (h_.sign.empty())
            add_facet(dark,
                      {Vec3{0, 0, -0.4f}, {w, 0, -0.4f}, {w, h_.ground_height, -0.4f}, {0, h_.ground_height, -0.4f}});
    }

    void downpipe(float top) {
        const float x = h_.width - 0.16f;
        add_tube(
            a_[p_("iron")],
            rounded(
                {{x, top, 0.3f}, {x, top - 0.3f, 0.3f}, {x, top - 0.55f, 0.1f}, {x, 0.35f, 0.24f}, {x, 0.1f, 0.32f}},
                0.1f),
            0.05f, 10);
        for (float y = 1; y < top - 0.6f; y += 1.9f)
            add_box(a_[p_("iron")], {x - 0.075f, y, 0}, {x + 0.075f, y + 0.05f, 0.17f + 0.07f * (1 - y / top)});
    }

    /// Splashing rain and dust darken what is near the ground.
    void splashes() {
        for (auto& [finish, shape] : a_.shapes)
            for (size_t i = 0; i < shape.positions.size(); ++i)
                if (shape.positions[i].z > -0.2f)
                    shape.colors[i] *= 0.7f + 0.3f * smooth_step(0, 0.7f, shape.positions[i].y);
    }

    Palette& p_;
    const TownHouse& h_;
    Chance chance_;
    Assembly a_;
};

}  // namespace

Assembly town_house(Palette& palette, const TownHouse& house) {
    return HouseBuilder(palette, house).build();
}

void add_stoop(Assembly& a, Palette& palette, float x, float width, float height, int steps) {
    constexpr float tread = 0.29f;
    const float half = 0.5f * width, landing = 0.75f;
    Shape& stone = a[palette("brownstone")];
    Chance chance{uint64_t(x * 1000)};
    for (int i = 0; i < steps; ++i) {
        const float top = height * float(steps - i) / float(steps), front = landing + tread * float(i);
        add_box(stone, {x - half, -0.1f, 0}, {x + half, top - 0.045f, front - 0.03f}, chance.tint(0.12f));
        add_moulding(stone,
                     {{front - 0.03f, top - 0.045f},
                      {front - 0.008f, top - 0.04f},
                      {front, top - 0.025f},
                      {front - 0.006f, top - 0.006f},
                      {front - 0.02f, top},
                      {0, top}},
                     x - half - 0.02f, x + half + 0.02f, 0, chance.tint(0.12f));
    }
    const float foot = landing + tread * float(steps - 1) - 0.1f;
    Shape& iron = a[palette("iron")];
    for (const float side : {-1.0f, 1.0f}) {
        const float rail = x + side * (half - 0.06f);
        const auto top_at = [&](float z) {
            return z < landing ? height : height * (1 - (z - landing) / (tread * float(steps)));
        };
        std::vector<Vec3> bar;
        for (const float z : {0.05f, landing - 0.1f, foot}) bar.push_back({rail, top_at(z) + 0.9f, z});
        bar.push_back({rail, top_at(foot) + 0.82f, foot + 0.16f});
        add_tube(iron, rounded(bar, 0.15f, 5), 0.021f, 8);
        for (float z = 0.1f; z < foot; z += 0.13f) {
            const float y = top_at(z);
            add_tube(iron, {{rail, y, z}, {rail, y + 0.9f, z}}, 0.0085f, 5);
        }
        Shape newel;
        add_lathe(newel,
                  {{0.05f, 0},
                   {0.05f, 0.08f},
                   {0.032f, 0.12f},
                   {0.032f, 0.95f},
                   {0.05f, 0.98f},
                   {0.05f, 1.02f},
                   {0.03f, 1.05f},
                   {0.045f, 1.1f},
                   {0.03f, 1.16f},
                   {0.001f, 1.18f}},
                  12, {0.3f, 1.2f});
        append(iron, newel, translate({rail, std::max(0.0f, top_at(foot) - 0.02f), foot + 0.02}));
    }
}

void add_fire_escape(Assembly& a, Palette& palette, float left, float right, const std::vector<float>& floors) {
    Shape& iron = a[palette("black_paint")];
    constexpr float reach = 1.05f, rail = 0.95f;
    for (size_t i = 0; i < floors.size(); ++i) {
        const float y = floors[i];
        for (float z = 0.06f; z < reach; z += 0.09f)
            add_box(iron, {left, y - 0.03f, z}, {right, y, z + 0.04f});  // slats
        for (const float x : {left, 0.5f * (left + right), right})
            add_beam(iron, {x, y - 0.05f, 0}, {x, y - 0.05f, reach}, {0, 1, 0}, 0.05f, 0.05f);
        for (const float x : {left, right})
            add_beam(iron, {x, y - 0.9f, 0}, {x, y - 0.06f, reach - 0.15f}, {0, 1, 0}, 0.035f, 0.035f);
        for (const float h : {0.5f * rail, rail}) {
            const std::vector<Vec3> loop = {
                {left, y + h, 0.03f}, {left, y + h, reach}, {right, y + h, reach}, {right, y + h, 0.03f}};
            add_tube(iron, rounded(loop, 0.08f, 3), 0.014f, 6);
        }
        for (float x = left; x < right + 0.01f; x += 0.16f)
            add_tube(iron, {{x, y, reach}, {x, y + rail, reach}}, 0.008f, 4);
        for (float z = 0.1f; z < reach; z += 0.16f)
            for (const float x : {left, right}) add_tube(iron, {{x, y, z}, {x, y + rail, z}}, 0.008f, 4);
        if (i + 1 < floors.size()) {  // stair to the next
            const Vec3 foot = {left + 0.35f, y, reach - 0.3f}, head = {right - 0.5f, floors[i + 1], reach - 0.3f};
            for (const float z : {-0.24f, 0.24f})
                add_beam(iron, foot + Vec3(0, 0, z), head + Vec3(0, 0, z), {0, 1, 0}, 0.03f, 0.14f);
            const int treads = int((head.y - foot.y) / 0.24f);
            for (int k = 1; k < treads; ++k) {
                const Vec3 at = foot + (head - foot) * (float(k) / float(treads));
                add_box(iron, {at.x - 0.1f, at.y - 0.01f, at.z - 0.24f}, {at.x + 0.1f, at.y + 0.01f, at.z + 0.24f});
            }
            for (const float z : {-0.26f, 0.26f})
                add_tube(iron, {foot + Vec3(0, 0.85f, z), head + Vec3(0, 0.85f, z)}, 0.014f, 6);
        } else {
            for (const float x : {left + 0.3f, left + 0.75f})
                add_tube(iron, {{x, floors[0] - 2.2f, reach - 0.1f}, {x, floors[0] + 0.8f, reach - 0.1f}}, 0.016f, 6);
            for (float r = floors[0] - 2.1f; r < floors[0]; r += 0.3f)
                add_tube(iron, {{left + 0.3f, r, reach - 0.1f}, {left + 0.75f, r, reach - 0.1f}}, 0.012f, 5);
        }
    }
}

}  // namespace pluvia
