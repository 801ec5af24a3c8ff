// Roofs of the lane: pan tiles, rafters, eave tiles, gutters and downpipes.
#include "scenes/lane.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia::lane {
namespace {

constexpr float tile_width = 0.265f, tile_exposure = 0.235f,
                tile_overlap = 0.05f;  // the common Japanese pan tile (53 A)
constexpr float gutter_radius = 0.055f;

/// Height of a pan tile above its lowest point, s from 0 to 1 across: a flat trough and a roll at the right.
float tile_profile(float s) {
    const float trough = 0.012f * (1 - std::sin(pi * std::min(s / 0.72f, 1.0f)));
    return s < 0.72f ? trough : 0.012f + 0.034f * std::sin(pi * (s - 0.72f) / 0.28f);
}

/// Shape of a roof plane in its own frame: x along the eave, y up the slope, z off the roof, origin at the eave's left.
void add_tiles(Shape& shape, float width, float slope_length, Chance& chance) {
    const int courses = int(slope_length / tile_exposure), columns = std::max(1, int(std::round(width / tile_width)));
    const float pitch = width / float(columns), exposure = slope_length / float(courses);
    for (int course = 0; course < courses; ++course)
        for (int column = 0; column < columns; ++column) {
            const float lift = chance(0.024f, 0.03f), skew = chance(-0.003f, 0.003f), x0 = pitch * float(column);
            const float y0 = exposure * float(course) - 0.01f;
            const Tint tint = chance.tint(0.45f);
            const auto top = [&](float s, float t) {
                const float y = y0 + t * (exposure + tile_overlap), z = tile_profile(s) + lift * (1 - t) + skew * s;
                return SheetPoint{{x0 + s * pitch, y, z}, {s * pitch, -y}};
            };
            add_sheet(shape, 6, 1, top, tint);
            add_sheet(
                shape, 6, 1,
                [&](float s, float t) {
                    SheetPoint p = top(s, 0);
                    p.position.z -= (1 - t) * 0.02f;
                    p.uv.y += 1 - t;
                    return p;
                },
                tint);
        }
    // The first course ends in round faces under its rolls.
    for (int column = 0; column < columns; ++column) {
        const Vec3 centre = {pitch * (float(column) + 0.86f), -0.012f, 0.036f};
        add_tube(shape, {centre, centre + Vec3(0, -0.022f, 0)}, 0.042f, 7, chance.tint(0.4f));
    }
}

}  // namespace

void add_eave(Assembly& assembly, const Finishes& f, const Eave& eave, Chance& chance) {
    const float drop = eave.pitch * eave.depth, edge_height = eave.wall_height - drop;
    const float slope_length = std::hypot(eave.depth, drop);
    const float cosine = eave.depth / slope_length, sine = drop / slope_length;
    const Transform facade_from_roof = {{1, 0, 0}, {0, sine, -cosine}, {0, cosine, sine}, {0, edge_height, eave.depth}};
    Shape tiles;
    add_tiles(tiles, eave.width, slope_length, chance);
    append(assembly[f.clay], tiles, facade_from_roof);

    // Roof boards under the tiles, then rafters under the boards, the fascia in front of their ends.
    Shape boards, rafters;
    add_box(boards, {0, 0, -0.04f}, {eave.width, slope_length, -0.012f}, chance.tint(0.2f));
    append(assembly[f.brown_wood], boards, facade_from_roof);
    const int count = std::max(2, int(eave.width / 0.3f));
    for (int i = 0; i <= count; ++i) {
        const float x = 0.03f + (eave.width - 0.06f) * float(i) / float(count);
        add_box(rafters, {x - 0.022f, 0.02f, -0.1f}, {x + 0.022f, slope_length, -0.04f}, chance.tint(0.3f));
    }
    add_box(rafters, {0, -0.012f, -0.085f}, {eave.width, 0.012f, -0.005f}, chance.tint(0.2f));
    append(assembly[f.dark_wood], rafters, facade_from_roof);

    if (eave.back > 0) {
        const Vec3 low = {0, eave.wall_height + 0.03f, 0},
                   high = {0, eave.wall_height + 0.03f + eave.pitch * eave.back, -eave.back};
        const Vec3 right = {eave.width, 0, 0};
        const float behind = length(high - low);
        add_quad(assembly[f.tiled_roof], {low, low + right, high + right, high}, {0, 0}, {eave.width, -behind});
        const Vec3 foot = {0, eave.wall_height, -2 * eave.back};
        add_quad(assembly[f.tiled_roof], {foot + right, foot, high, high + right}, {0, 0}, {eave.width, -behind});
        add_box(assembly[f.clay], {0, high.y - 0.03f, high.z - 0.12f}, {eave.width, high.y + 0.22f, high.z + 0.12f});
        for (const float x : {0.0f, eave.width}) {
            const float w = eave.wall_height, ridge = high.y;
            const std::array<Vec3, 4> gable = {
                Vec3{x, w, -2 * eave.back}, {x, w, 0}, {x, ridge, high.z + 0.02f}, {x, ridge, high.z - 0.02f}};
            add_quad(assembly[f.white_plaster], gable, {0, 0}, {2 * eave.back, -(ridge - w)});
        }
    } else {
        add_box(assembly[f.clay], {0, eave.wall_height - 0.01f, -0.02f}, {eave.width, eave.wall_height + 0.1f, 0.1f},
                {}, 0.02f);
    }

    // Half-round gutter with its hangers.
    const Vec3 axis = {0, edge_height - 0.03f, eave.depth + 0.045f};
    const int segments = std::max(1, int(eave.width / 2));
    add_sheet(assembly[f.copper], segments, 8, [&](float s, float t) {
        const float phi = pi * t, x = s * eave.width;
        return SheetPoint{axis + Vec3(x, -gutter_radius * std::sin(phi), gutter_radius * std::cos(phi)),
                          {x, phi * gutter_radius}};
    });
    for (float x = 0.25f; x < eave.width; x += 0.9f) {
        std::vector<Vec3> hanger;
        for (int i = 0; i <= 4; ++i) {
            const float phi = pi * float(i) / 4;
            hanger.push_back(axis + Vec3(x, -0.059f * std::sin(phi), 0.059f * std::cos(phi)));
        }
        hanger.push_back(axis + Vec3(x, 0.045f, -0.12f));
        add_tube(assembly[f.iron], hanger, 0.006f, 4);
    }
}

void add_downpipe(Assembly& assembly, const Finishes& f, const Eave& eave, float x) {
    const float top = eave.wall_height - eave.pitch * eave.depth - 0.03f, out = eave.depth + 0.045f;
    constexpr float wall = 0.07f, radius = 0.034f;
    Shape funnel;
    add_lathe(funnel, {{0.03f, -0.2f}, {0.045f, -0.12f}, {0.075f, -0.1f}, {0.085f, 0.01f}}, 12, {0.5f, 0.3f});
    append(assembly[f.copper], funnel, translate({x, top, out}));
    const std::vector<Vec3> path = {{x, top - 0.15f, out},  {x, top - 0.3f, out}, {x, top - 0.42f, wall},
                                    {x, top - 0.62f, wall}, {x, 0.2f, wall},      {x, 0.08f, wall + 0.12f}};
    add_tube(assembly[f.copper], rounded(path, 0.1f, 5), radius, 12);
    for (float y = 0.5f; y < top - 0.6f; y += 0.9f) {  // clamps
        add_tube(assembly[f.iron], {{x, y - 0.015f, wall}, {x, y + 0.015f, wall}}, radius + 0.006f, 12);
        add_box(assembly[f.iron], {x - 0.008f, y - 0.01f, 0}, {x + 0.008f, y + 0.01f, wall});
    }
}

}  // namespace pluvia::lane
