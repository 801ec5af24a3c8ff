// Ground of the lane: worn slabs with open joints on a slight crown, drains with covers and grates at both sides.
#include "scenes/lane.h"
#include "scenes/noise.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia::lane {
namespace {

/// Turns z up: a box's bevelled +z face becomes the upper side of a slab; y points into the depth of the lane.
constexpr Transform lying = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
constexpr float crown = 0.03f;  // how much the middle lies higher than the edges

/// A slab worn by feet: its upper side is a fine sheet with hollows and rounded edges, for water to stand in and low
/// light to graze.
void add_slab(Shape& shape, float x0, float x1, float z_near, float z_far, float top, Chance& chance) {
    constexpr int pieces = 24;
    const float w = x1 - x0, d = z_near - z_far, u = chance(0, 500), v = chance(0, 500);
    const Tint tint = chance.tint(0.42f);
    const auto surface = [&](float s, float t) {
        // Closer points towards the edges, which are rounded over 25 mm.
        const float x = 0.5f * w * std::sin(0.5f * pi * (2 * s - 1)), y = 0.5f * d * std::sin(0.5f * pi * (2 * t - 1));
        const float edge = std::min(0.5f * w - std::abs(x), 0.5f * d - std::abs(y));
        const float drop = 1 - std::min(edge / 0.025f, 1.0f);
        const float worn = fractal_noise({x * 5 + u, y * 5 + v}, 1024, 1024, 3, 81) - 0.5f;
        const float dressed = fractal_noise({x * 24 + u, y * 24 + v}, 1024, 1024, 2, 82) - 0.5f;
        return SheetPoint{{x, y, -0.011f * drop * drop + (1 - drop) * (0.016f * worn + 0.004f * dressed)}, {x, -y}};
    };
    Shape slab;
    add_sheet(slab, pieces, pieces, surface, tint);
    const float skirt = -0.015f;
    const Vec3 corners[4] = {
        {-0.5f * w, -0.5f * d, 0}, {0.5f * w, -0.5f * d, 0}, {0.5f * w, 0.5f * d, 0}, {-0.5f * w, 0.5f * d, 0}};
    for (int k = 0; k < 4; ++k) {
        const Vec3 a = corners[k], b = corners[(k + 1) % 4], up = {0, 0, skirt}, down = {0, 0, -0.12f};
        add_facet(slab, {a + down, b + down, b + up, a + up}, tint);
    }
    const float tilt = chance(-0.007f, 0.007f), roll = chance(-0.007f, 0.007f);
    const Transform settle = rotate(0.5 * tilt, 0.5 * roll, 0, 1);
    append(shape, slab,
           translate({0.5 * (x0 + x1), top + chance(-0.004f, 0.004f), 0.5 * (z_near + z_far)}) * lying * settle);
}

/// Iron grate: a frame with bars across.
void add_grate(Shape& shape, float x0, float x1, float z_near, float z_far, float top) {
    for (const float x : {x0, x1 - 0.025f}) add_box(shape, {x, top - 0.03f, z_far}, {x + 0.025f, top, z_near});
    const int bars = int((z_near - z_far) / 0.05f);
    for (int i = 0; i <= bars; ++i) {
        const float z = z_far + (z_near - z_far - 0.014f) * float(i) / float(bars);
        add_box(shape, {x0 + 0.025f, top - 0.03f, z}, {x1 - 0.025f, top, z + 0.014f});
    }
}

}  // namespace

void add_paving(Street& street, const Finishes& f, const Paving& paving) {
    const float half_width = paving.half_width, near = paving.near, far = paving.far;
    Chance chance{instance_id(paving.name)};
    const float drain = 0.26f, edge = half_width - drain;
    const auto height = [&](float x) { return crown * (1 - (x / half_width) * (x / half_width)) - crown; };
    Assembly slabs, drains;
    for (float z = near; z > far;) {
        const float z_next = std::max(far, z - chance(0.38f, 0.66f));
        for (float x = -edge; x < edge;) {
            float x_next = x + chance(0.42f, 0.95f);
            if (edge - x_next < 0.3f) x_next = edge;
            add_slab(slabs[f.granite], x + 0.006f, x_next - 0.006f, z - 0.006f, z_next + 0.006f,
                     height(0.5f * (x + x_next)), chance);
            x = x_next;
        }
        z = z_next;
    }
    int index = 0;
    for (float z = near; z > far + 0.1f; z -= 0.6f, ++index)
        for (const bool right : {false, true}) {
            const float x0 = right ? edge + 0.01f : -half_width + 0.01f, x1 = x0 + drain - 0.02f;
            const float top = -crown - 0.004f;
            if ((index + (right ? 3 : 0)) % 5 == 0)
                add_grate(drains[f.iron], x0, x1, z - 0.006f, z - 0.594f, top);
            else
                add_slab(drains[f.concrete], x0, x1, z - 0.006f, z - 0.594f, top, chance);
        }
    const float joint = -crown - 0.02f, reach = half_width + 0.2f;
    add_quad(slabs[f.soil],
             {Vec3{-reach, joint, near}, {reach, joint, near}, {reach, joint, far}, {-reach, joint, far}}, {0, 0},
             {2 * reach, far - near});
    place_once(street, "lane/" + paving.name + "_slabs", "sidewalk", slabs, paving.scene_from_paving);
    place_once(street, "lane/" + paving.name + "_drains", "sidewalk", drains, paving.scene_from_paving);
}

}  // namespace pluvia::lane
