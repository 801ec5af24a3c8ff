// Fronts of the lane's houses: a frame of posts and beams whose bays are filled with boards, plaster, lattices and doors.
// The letters of the bays are explained in lane.h, the roofs are lane_roof.cpp.
#include "scenes/lane.h"
#include "scenes/noise.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia::lane {
namespace {

constexpr float recess = -0.14f;     // z of the closed body behind the frame
constexpr float post_front = 0.02f;  // z of posts and beams
constexpr float plinth_height = 0.24f, sill_height = 0.36f, lintel_height = 2.02f;

/// One opening of the frame, between two posts and two beams.
struct Bay {
    float left, right, bottom, top;
    float width() const { return right - left; }
};

class Front {
public:
    Front(const Finishes& finishes, const House& house)
        : f_(finishes), house_(house), chance_{instance_id(house.name)} {}

    Assembly build() {
        Assembly& a = assembly_;
        const float w = house_.width;
        add_box(a[house_.walls], {0, 0, -house_.body_depth}, {w, house_.eave_height, recess});
        for (float x = 0; x < w - 0.01f;) {  // plinth of cut stones
            const float end = std::min(w, x + chance_(0.7f, 1.2f));
            add_box(a[f_.granite], {x + 0.004f, -0.1f, recess}, {w - end < 0.4f ? w - 0.004f : end - 0.004f, plinth_height,
                    0.05f + chance_(0, 0.012f)}, chance_.tint(0.3f), 0.012f);
            x = w - end < 0.4f ? w : end;
        }
        beam(plinth_height, sill_height, 0.03f);
        beam(house_.ground_height - 0.2f, house_.ground_height, 0.035f);
        beam(house_.eave_height - 0.14f, house_.eave_height, 0.03f);
        const float upper_bottom = house_.lower_roof_depth > 0 ? house_.ground_height + 0.45f : house_.ground_height;
        row(house_.ground, sill_height, house_.ground_height - 0.2f, &Front::fill_ground);
        row(house_.upper, upper_bottom, house_.eave_height - 0.14f, &Front::fill_upper);
        roofs();
        weather();
        return std::move(assembly_);
    }

private:
    void beam(float bottom, float top, float front) {
        add_box(assembly_[house_.posts], {0, bottom, recess}, {house_.width, top, front}, chance_.tint(0.25f), 0.006f);
    }

    void row(const std::string& letters, float bottom, float top, void (Front::*fill)(char, const Bay&)) {
        const float pitch = house_.width / float(letters.size()), half_post = 0.055f;
        for (size_t i = 0; i <= letters.size(); ++i) {
            const float x = std::clamp(pitch * float(i), half_post, house_.width - half_post);
            add_box(assembly_[house_.posts], {x - half_post, bottom, recess}, {x + half_post, top, post_front},
                    chance_.tint(0.25f), 0.006f);
            if (i < letters.size())
                (this->*fill)(letters[i], {pitch * float(i) + half_post, pitch * float(i + 1) - half_post, bottom, top});
        }
    }

    void fill_ground(char letter, const Bay& bay) {
        const Bay above = {bay.left, bay.right, lintel_height, bay.top};
        Bay below = {bay.left, bay.right, bay.bottom, lintel_height};
        if (letter == 'B') return boards(bay);
        if (letter == 'g') return corrugated(bay);
        rail(bay, lintel_height - 0.05f, lintel_height + 0.05f);
        plaster_panel(above);
        switch (letter) {
        case 'b': return boards(below);
        case 's': return weatherboards(below);
        case 'l': case 'k': {
            const float sill = 0.78f;
            boards({below.left, below.right, below.bottom, sill});
            rail(bay, sill, sill + 0.07f, 0.05f);
            return lattice({below.left, below.right, sill + 0.07f, below.top - 0.05f}, letter == 'l' ? f_.lit_window : -1, 0.058f);
        }
        case 'd': return sliding_door(below);
        default: {
            sliding_door(below);
            Assembly curtain = noren(f_, below.width() - 0.06f, 0.62f);
            for (const auto& [finish, shape] : curtain.shapes)
                append(assembly_[finish], shape, translate({0.5 * (below.left + below.right), below.top - 0.02, 0.075}));
        }
        }
    }

    void fill_upper(char letter, const Bay& bay) {
        const float sill = bay.bottom + 0.42f * (bay.top - bay.bottom) - 0.2f, head = bay.top - 0.28f;
        const Bay window = {bay.left + 0.03f, bay.right - 0.03f, sill, head};
        if (letter == 'b') return boards(bay);
        if (letter == 'p') return plaster_panel(bay);
        plaster_panel({bay.left, bay.right, bay.bottom, sill});
        plaster_panel({bay.left, bay.right, head, bay.top});
        rail(bay, sill - 0.06f, sill, 0.06f);
        rail(bay, head, head + 0.05f, 0.03f);
        switch (letter) {
        case 'w': return lattice(window, f_.warm_window, 0.09f);
        case 'm': return slits(window);
        case 's': return blind(window);
        default: return pane(window);
        }
    }

    void rail(const Bay& bay, float bottom, float top, float front = post_front) {
        add_box(assembly_[house_.posts], {bay.left, bottom, recess}, {bay.right, top, front}, chance_.tint(0.25f));
    }

    void boards(const Bay& bay) {
        const int count = std::max(1, int(std::round(bay.width() / 0.15f)));
        const float pitch = bay.width() / float(count);
        for (int i = 0; i < count; ++i) {
            const float x = bay.left + pitch * float(i), front = -0.03f + chance_(-0.006f, 0.006f);
            add_plank(assembly_[house_.boards], {x + 0.002f, bay.bottom, front - 0.02f}, {x + pitch - 0.002f, bay.top, front}, 0.006f,
                      chance_.tint(0.4f));
        }
        if (bay.top - bay.bottom > 1)  // battens over every second joint
            for (int i = 2; i < count; i += 2) {
                const float x = bay.left + pitch * float(i);
                add_box(assembly_[house_.boards], {x - 0.014f, bay.bottom, -0.04f}, {x + 0.014f, bay.top, -0.006f}, chance_.tint(0.4f));
            }
    }

    void weatherboards(const Bay& bay) {
        const float dado = bay.bottom + 0.85f;
        plaster_panel({bay.left, bay.right, dado, bay.top});
        const int count = 5;
        for (int i = 0; i < count; ++i) {
            const float y = bay.bottom + (dado - bay.bottom) * float(i) / count, h = (dado - bay.bottom) / count;
            Shape board;
            add_box(board, {bay.left, 0, -0.01f}, {bay.right, h * 1.15f, 0.008f}, chance_.tint(0.4f));
            append(assembly_[house_.boards], board, translate({0, y, -0.03}) * rotate(std::sin(-0.06), 0, 0, std::cos(-0.06)));
        }
        for (float x = bay.left + 0.12f; x < bay.right - 0.06f; x += 0.32f)
            add_box(assembly_[house_.boards], {x, bay.bottom, -0.05f}, {x + 0.03f, dado, 0.012f}, chance_.tint(0.4f));
        rail(bay, dado, dado + 0.05f, 0.03f);
    }

    void corrugated(const Bay& bay) {
        constexpr float wave = 0.076f;
        const int columns = int(bay.width() / wave * 8);
        add_sheet(assembly_[f_.zinc], columns, 2, [&](float s, float t) {
            const float x = bay.left + s * bay.width(), y = bay.bottom + t * (bay.top - bay.bottom);
            return SheetPoint{{x, y, -0.035f + 0.009f * std::sin(2 * pi * x / wave)}, {x, -y}};
        }, chance_.tint(0.15f));
    }

    void plaster_panel(const Bay& bay) {
        const Vec3 p = {bay.left, bay.bottom, -0.03f};
        const float w = bay.width(), h = bay.top - bay.bottom;
        if (h <= 0) return;
        add_quad(assembly_[house_.walls], {p, p + Vec3(w, 0, 0), p + Vec3(w, h, 0), p + Vec3(0, h, 0)},
                 {p.x, -p.y}, {p.x + w, -p.y - h}, {Rgb(1), {chance_(0, 2), chance_(0, 2)}});
    }

    /// Picture over a whole opening, its corners cut to the opening's own part of a 0.9 m wide window.
    void picture(const Bay& bay, float z, int finish) {
        add_quad(assembly_[finish], {Vec3{bay.left, bay.bottom, z}, {bay.right, bay.bottom, z}, {bay.right, bay.top, z},
                 {bay.left, bay.top, z}}, {0, 1}, {1, 0});
    }

    /// Upright bars before lit paper (or darkness, finish -1).
    void lattice(const Bay& bay, int finish, float pitch) {
        picture(bay, -0.115f, finish < 0 ? f_.glass : finish);
        const int count = std::max(2, int(bay.width() / pitch));
        for (int i = 1; i < count; ++i) {
            const float x = bay.left + bay.width() * float(i) / float(count);
            add_box(assembly_[house_.posts], {x - 0.011f, bay.bottom, -0.07f}, {x + 0.011f, bay.top, -0.025f}, chance_.tint(0.3f));
        }
        for (int i = 1; i <= 3; ++i) {
            const float y = bay.bottom + (bay.top - bay.bottom) * float(i) / 4;
            add_box(assembly_[house_.posts], {bay.left, y - 0.012f, -0.085f}, {bay.right, y + 0.012f, -0.05f}, chance_.tint(0.3f));
        }
    }

    void sliding_door(const Bay& bay) {
        picture(bay, -0.12f, f_.lit_window);
        const float middle = 0.5f * (bay.left + bay.right);
        for (const bool second : {false, true}) {  // two leaves, one before the other
            const float left = second ? middle - 0.03f : bay.left, right = second ? bay.right : middle + 0.03f;
            const float z = second ? -0.095f : -0.06f;
            const auto bar = [&](float x0, float y0, float x1, float y1) {
                add_box(assembly_[house_.posts], {x0, y0, z - 0.03f}, {x1, y1, z}, chance_.tint(0.25f));
            };
            bar(left, bay.bottom, left + 0.05f, bay.top);
            bar(right - 0.05f, bay.bottom, right, bay.top);
            bar(left, bay.top - 0.06f, right, bay.top);
            bar(left, bay.bottom, right, bay.bottom + 0.4f);
            for (int i = 1; i <= 5; ++i) {
                const float y = bay.bottom + 0.4f + (bay.top - bay.bottom - 0.46f) * float(i) / 6;
                bar(left, y - 0.009f, right, y + 0.009f);
            }
            for (int i = 1; i <= 3; ++i) {
                const float x = left + (right - left) * float(i) / 4;
                bar(x - 0.009f, bay.bottom + 0.4f, x + 0.009f, bay.top);
            }
        }
    }

    void slits(const Bay& bay) {
        picture(bay, -0.13f, f_.warm_window);
        const int count = std::max(3, int(bay.width() / 0.1f));
        for (int i = 0; i < count; ++i) {
            const float x = bay.left + bay.width() * (float(i) + 0.5f) / float(count);
            add_box(assembly_[house_.walls], {x - 0.027f, bay.bottom, -0.1f}, {x + 0.027f, bay.top, -0.02f}, chance_.tint(0.1f), 0.012f);
        }
    }

    void blind(const Bay& bay) {
        picture(bay, -0.12f, f_.warm_window);
        const float hem = bay.bottom - 0.1f, roll = 0.05f;
        int row = 0;
        for (float y = bay.top - roll; y > hem; y -= 0.018f, ++row)  // reeds
            add_box(assembly_[f_.bamboo], {bay.left, y - 0.0135f, 0.05f}, {bay.right, y, 0.058f}, chance_.tint(0.5f));
        add_tube(assembly_[f_.bamboo], {{bay.left - 0.02f, hem, 0.055f}, {bay.right + 0.02f, hem, 0.055f}}, 0.014f, 8);
        for (const float x : {bay.left + 0.12f, bay.right - 0.12f})
            add_box(assembly_[f_.indigo_cloth], {x - 0.006f, hem, 0.058f}, {x + 0.006f, bay.top, 0.062f});
    }

    void pane(const Bay& bay) {
        picture(bay, -0.1f, f_.glass);
        const float middle = 0.5f * (bay.left + bay.right);
        for (const float x : {bay.left + 0.02f, middle, bay.right - 0.02f})
            add_box(assembly_[house_.posts], {x - 0.02f, bay.bottom, -0.1f}, {x + 0.02f, bay.top, -0.04f}, chance_.tint(0.25f));
        for (int i = 0; i <= 4; ++i) {  // railing
            const float y = bay.bottom + 0.08f + 0.09f * float(i);
            add_box(assembly_[house_.posts], {bay.left - 0.03f, y, 0.05f}, {bay.right + 0.03f, y + 0.02f, 0.075f}, chance_.tint(0.3f));
        }
        for (const float x : {bay.left, bay.right})
            add_box(assembly_[house_.posts], {x - 0.02f, bay.bottom - 0.05f, post_front}, {x + 0.02f, bay.bottom + 0.5f, 0.08f});
    }

    void roofs() {
        const Eave upper = {.width = house_.width, .wall_height = house_.eave_height + 0.12f, .depth = 0.62f,
                            .back = 0.5f * house_.body_depth};
        add_eave(assembly_, f_, upper, chance_);
        const Eave lower = {.width = house_.width, .wall_height = house_.ground_height + 0.4f, .depth = house_.lower_roof_depth};
        if (lower.depth > 0) {
            add_eave(assembly_, f_, lower, chance_);
            for (const float x : {0.06f, 0.5f * house_.width, house_.width - 0.06f})  // brackets that carry it
                add_beam(assembly_[house_.posts], {x, lower.wall_height - 0.42f, 0}, {x, lower.wall_height - 0.44f, 0.9f * lower.depth}, {0, 1, 0}, 0.09f, 0.1f);
        }
        for (const float x : house_.downpipes) add_downpipe(assembly_, f_, lower.depth > 0 ? lower : upper, x);
    }

    /// Splashing rain and dust darken the lowest metre of a wall.
    void weather() {
        for (auto& [finish, shape] : assembly_.shapes) {
            const int material = finish;
            if (material == f_.lit_window || material == f_.warm_window) continue;
            for (size_t i = 0; i < shape.positions.size(); ++i)
                shape.colors[i] *= 0.62f + 0.38f * smooth_step(0, 1.1f, shape.positions[i].y);
        }
    }

    const Finishes& f_;
    const House& house_;
    Chance chance_;
    Assembly assembly_;
};

}  // namespace

void add_house(Street& street, const Finishes& finishes, const House& house) {
    place_once(street, "lane/" + house.name, Front(finishes, house).build(), house.scene_from_facade);
}

void add_garden_wall(Street& street, const Finishes& f, const std::string& name, float width, float height,
                     const Transform& scene_from_facade) {
    Chance chance{instance_id(name)};
    Assembly a;
    add_box(a[f.granite], {0, -0.1f, -0.2f}, {width, 0.5f, 0.05f}, chance.tint(0.2f), 0.015f);
    for (float x = 0; x < width - 0.05f; x += 0.16f)
        add_box(a[f.red_wood], {x + 0.002f, 0.5f, -0.12f}, {std::min(x + 0.158f, width), height, -0.02f + chance(-0.006f, 0.006f)},
                chance.tint(0.4f), 0.006f);
    add_box(a[f.dark_wood], {0, 0.5f, -0.13f}, {width, 0.58f, 0.02f});
    add_box(a[f.dark_wood], {0, height - 0.08f, -0.14f}, {width, height, 0.03f});
    const Eave coping = {.width = width, .wall_height = height + 0.2f, .depth = 0.38f, .rafters = true};
    add_eave(a, f, coping, chance);
    const Transform turned = translate({width, 0, -0.14}) * rotate_y(std::numbers::pi);  // the other side of the coping
    Assembly back;
    add_eave(back, f, coping, chance);
    for (const auto& [finish, shape] : back.shapes) append(a[finish], shape, turned);
    place_once(street, "lane/" + name, a, scene_from_facade);
}

}  // namespace pluvia::lane
