// Houses of the lane: a closed body, a frame of posts and beams before it, and roofs. What fills the frame's bays is in
// lane_bays.cpp, the roofs are lane_roof.cpp.
#include "scenes/lane_bays.h"
#include "scenes/noise.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace pluvia::lane {
namespace {

constexpr float plinth_height = 0.24f, sill_height = 0.36f;

class Front {
public:
    Front(const Finishes& finishes, const House& house)
        : f_(finishes), house_(house), chance_{instance_id(house.name)} {}

    Assembly build() {
        Assembly& a = assembly_;
        const float w = house_.width;
        add_box(a[house_.walls], {0, 0, -house_.body_depth}, {w, house_.eave_height, recess});
        for (float x = 0; x < w - 0.01f;) {  // plinth of cut stones
            const float end = x + chance_(0.7f, 1.2f), next = w - end < 0.4f ? w : end,
                        front = 0.05f + chance_(0, 0.012f);
            add_box(a[f_.granite], {x + 0.004f, -0.1f, recess}, {next - 0.004f, plinth_height, front},
                    chance_.tint(0.3f), 0.012f);
            x = next;
        }
        beam(plinth_height, sill_height, 0.03f);
        beam(house_.ground_height - 0.2f, house_.ground_height, 0.035f);
        beam(house_.eave_height - 0.14f, house_.eave_height, 0.03f);
        const float upper_bottom = house_.lower_roof_depth > 0 ? house_.ground_height + 0.45f : house_.ground_height;
        row(house_.ground, sill_height, house_.ground_height - 0.2f, fill_ground_bay);
        row(house_.upper, upper_bottom, house_.eave_height - 0.14f, fill_upper_bay);
        roofs();
        weather();
        return std::move(assembly_);
    }

private:
    void beam(float bottom, float top, float front) {
        add_box(assembly_[house_.posts], {0, bottom, recess}, {house_.width, top, front}, chance_.tint(0.25f), 0.006f);
    }

    void row(const std::string& letters, float bottom, float top, void (*fill)(const BayWork&, char, const Bay&)) {
        const BayWork work = {assembly_, f_, house_.boards, house_.posts, house_.walls, chance_};
        const float pitch = house_.width / float(letters.size()), half_post = 0.055f;
        for (size_t i = 0; i <= letters.size(); ++i) {
            const float x = std::clamp(pitch * float(i), half_post, house_.width - half_post);
            add_box(assembly_[house_.posts], {x - half_post, bottom, recess}, {x + half_post, top, post_front},
                    chance_.tint(0.25f), 0.006f);
            if (i < letters.size())
                fill(work, letters[i], {pitch * float(i) + half_post, pitch * float(i + 1) - half_post, bottom, top});
        }
    }

    void roofs() {
        const Eave upper = {.width = house_.width,
                            .wall_height = house_.eave_height + 0.12f,
                            .depth = 0.62f,
                            .back = 0.5f * house_.body_depth};
        add_eave(assembly_, f_, upper, chance_);
        const Eave lower = {
            .width = house_.width, .wall_height = house_.ground_height + 0.4f, .depth = house_.lower_roof_depth};
        if (lower.depth > 0) {
            add_eave(assembly_, f_, lower, chance_);
            for (const float x : {0.06f, 0.5f * house_.width, house_.width - 0.06f})  // brackets that carry it
                add_beam(assembly_[house_.posts], {x, lower.wall_height - 0.42f, 0},
                         {x, lower.wall_height - 0.44f, 0.9f * lower.depth}, {0, 1, 0}, 0.09f, 0.1f);
        }
        for (const float x : house_.downpipes) add_downpipe(assembly_, f_, lower.depth > 0 ? lower : upper, x);
    }

    /// Splashing rain and dust darken the lowest metre of a wall.
    void weather() {
        for (auto& [finish, shape] : assembly_.shapes) {
            if (finish == f_.lit_window || finish == f_.warm_window) continue;
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
    place_once(street, "lane/" + house.name, "building", Front(finishes, house).build(), house.scene_from_facade);
}

void add_garden_wall(Street& street, const Finishes& f, const std::string& name, float width, float height,
                     const Transform& scene_from_facade) {
    Chance chance{instance_id(name)};
    Assembly a;
    add_box(a[f.granite], {0, -0.1f, -0.2f}, {width, 0.5f, 0.05f}, chance.tint(0.2f), 0.015f);
    for (float x = 0; x < width - 0.05f; x += 0.16f) {
        const float right = std::min(x + 0.158f, width), front = -0.02f + chance(-0.006f, 0.006f);
        add_plank(a[f.red_wood], {x + 0.002f, 0.5f, front - 0.02f}, {right, height, front}, 0.006f, chance.tint(0.4f));
    }
    add_box(a[f.dark_wood], {0, 0.5f, -0.13f}, {width, 0.58f, 0.02f});
    add_box(a[f.dark_wood], {0, height - 0.08f, -0.14f}, {width, height, 0.03f});
    const Eave coping = {.width = width, .wall_height = height + 0.2f, .depth = 0.38f};
    add_eave(a, f, coping, chance);
    const Transform turned = translate({width, 0, -0.14}) * rotate_y(std::numbers::pi);  // the other side of the coping
    Assembly back;
    add_eave(back, f, coping, chance);
    for (const auto& [finish, shape] : back.shapes) append(a[finish], shape, turned);
    place_once(street, "lane/" + name, "wall", a, scene_from_facade);
}

}  // namespace pluvia::lane
