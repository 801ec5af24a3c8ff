#include "scenes/road.h"

#include "scenes/noise.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr int period = 4096;

float cloud(float x, float z, float cells_per_metre, int octaves, uint64_t seed) {
    return fractal_noise({(x + 600) * cells_per_metre, (z + 600) * cells_per_metre}, period, period, octaves, seed);
}

/// Sheet that follows the road `lift` above it, between x0, x1 and z_near, z_far, with its own shade.
void add_layer(Shape& shape, const Road& road, float x0, float x1, float z_near, float z_far, float cell, float lift,
               const std::function<float(float x, float z)>& shade) {
    const int columns = std::max(1, int(std::ceil((x1 - x0) / cell))),
              rows = std::max(1, int(std::ceil((z_near - z_far) / cell)));
    const size_t first = shape.positions.size();
    add_sheet(shape, columns, rows, [&](float s, float t) {
        const float x = x0 + s * (x1 - x0), z = z_near + t * (z_far - z_near);
        return SheetPoint{{x, road.height(x, z) + lift, z}, {x, z}};
    });
    for (size_t i = first; i < shape.positions.size(); ++i)
        shape.colors[i] = Rgb(shade(shape.positions[i].x, shape.positions[i].z));
}

void add_markings(Assembly& a, Palette& palette, const Road& road) {
    Shape& yellow = a[palette("road_paint_yellow")];
    const auto worn = [&](float x, float z) { return 0.45f + 0.75f * cloud(x, z, 3, 4, road.seed + 9); };
    for (float z = road.near; z > road.far; z -= 0.5f)
        for (const float x : {-0.17f, 0.06f}) {
            if (cloud(x * 3, z, 1.7f, 3, road.seed + 8) < 0.3f) continue;  // worn off
            add_layer(yellow, road, x, x + 0.11f, z, z - 0.5f, 0.25f, 0.003f, worn);
        }
    Shape& white = a[palette("road_paint_white")];
    for (const float z : {road.far + 1.2f, road.near - 4.0f}) {  // crossings at both ends, stop lines before them
        for (float x = -road.half_width + 0.5f; x < road.half_width - 0.6f; x += 0.95f)
            add_layer(white, road, x, x + 0.5f, z + 2.8f, z, 0.3f, 0.003f, worn);
    }
}

}  // namespace

float Road::height(float x, float z) const {
    const float u = x / half_width;
    const float hollows = cloud(x, z, 0.45f, 3, seed) - 0.5f, ripples = cloud(x, z, 2.2f, 2, seed + 1) - 0.5f;
    float ruts = 0;
    for (const float track : {-3.0f, -1.35f, 1.35f, 3.0f}) ruts += bump(x - track * half_width / 4.4f, 0.55f);
    return crown * (1 - u * u) + 0.05f * hollows + 0.006f * ripples - 0.008f * ruts;
}

void add_carriageway(Street& street, Palette& palette, const std::string& name, const Road& road) {
    Assembly a;
    const float h = road.half_width;
    const auto shade = [&](float x, float z) {
        float track = 0;
        for (const float t : {-3.0f, -1.35f, 1.35f, 3.0f}) track += bump(x - t * h / 4.4f, 0.5f);
        const float oil = bump(x + 2.2f, 0.6f) + bump(x - 2.2f, 0.6f);
        const float gutter = smooth_step(h - 0.7f, h, std::abs(x));
        const float blotch = smooth_step(0.4f, 0.68f, cloud(x, z, 0.6f, 5, road.seed + 3));
        return (0.72f + 0.2f * track - 0.16f * oil * cloud(x, z, 1.1f, 3, road.seed + 4)) * (1 - 0.38f * blotch) *
               (1 - 0.4f * gutter) * (0.85f + 0.3f * cloud(x, z, 2.5f, 3, road.seed + 5));
    };
    add_layer(a[palette("asphalt")], road, -h, h, road.near, road.far, 0.22f, 0, shade);
    Chance chance{hash_key(road.seed, 5)};
    // Patches where the road was opened: rectangles, and a long one over a pipe.
    Shape& patch = a[palette("asphalt_patch")];
    const auto dark = [&](float x, float z) { return 0.75f + 0.3f * cloud(x, z, 2, 3, road.seed + 6); };
    for (float z = road.near - 6; z > road.far + 8; z -= chance(5, 12)) {
        const float x = chance(-0.8f, 0.5f) * h, w = chance(0.6f, 1.9f), d = chance(0.8f, 3.2f);
        add_layer(patch, road, x, std::min(x + w, h - 0.1f), z, z - d, 0.2f, 0.004f, dark);
    }
    add_layer(patch, road, 2.1f * h / 4.4f, 2.1f * h / 4.4f + 0.55f, road.near - 12, road.near - 47, 0.22f, 0.0035f,
              dark);
    add_markings(a, palette, road);
    place_once(street, name + "/road", "road", a);
    const auto cover = add_meshes(street, "manhole", manhole(palette));
    int index = 0;
    for (float z = road.near - 9; z > road.far + 5; z -= 17, ++index) {
        const float x = index % 2 == 0 ? -1.9f : 2.35f;
        place(street, name + "/manhole_" + std::to_string(index), "road", cover,
              translate({x, road.height(x, z) + 0.006, z}));
    }
}

Assembly manhole(Palette& palette) {
    Assembly a;
    Shape& iron = a[palette("cast_iron")];
    add_lathe(iron,
              {{0.36f, -0.05f},
               {0.36f, -0.003f},
               {0.335f, 0},
               {0.33f, -0.012f},
               {0.32f, -0.012f},
               {0.315f, 0},
               {0.001f, 0.001f}},
              40, {2, 1});
    for (int i = -5; i <= 5; ++i)
        for (int j = -5; j <= 5; ++j) {
            const float x = 0.054f * float(i), z = 0.054f * float(j);
            if (x * x + z * z < 0.085f) add_block(iron, {x - 0.016f, 0, z - 0.016f}, {x + 0.016f, 0.0055f, z + 0.016f});
        }
    return a;
}

void add_pavements(Street& street, Palette& palette, const std::string& name, const Road& road,
                   const std::vector<TreePit>& pits) {
    constexpr float kerb = 0.32f, slab_depth = 0.9f;
    // Turns z up: a box's bevelled +z face becomes the upper side of a slab; y points into the depth of the street.
    constexpr Transform lying = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
    for (const bool right : {false, true}) {
        Assembly slabs, kerbs;
        Chance chance{hash_key(road.seed, right ? 11 : 12)};
        const float inner = road.half_width + kerb, outer = road.wall(), sign = right ? 1.0f : -1.0f;
        const auto in_pit = [&](float x, float z, float reach_x, float reach_z) {
            for (const TreePit& pit : pits)
                if (std::abs(x - pit.x) < pit.half + reach_x && std::abs(z - pit.z) < pit.half + reach_z) return true;
            return false;
        };
        int row = 0;
        for (float z = road.near; z > road.far; z -= slab_depth, ++row) {
            const float z_next = std::max(road.far, z - slab_depth);
            const float pitch = 0.62f, shift = row % 2 == 0 ? 0 : 0.5f * pitch;
            for (float x = inner - shift; x < outer - 0.01f; x += pitch) {
                const float x0 = std::max(x, inner) + 0.004f, x1 = std::min(x + pitch, outer + 0.3f) - 0.004f;
                if (x1 - x0 < 0.06f) continue;
                const float middle_x = sign * 0.5f * (x0 + x1), middle_z = 0.5f * (z + z_next);
                const float w = x1 - x0, d = z - z_next - 0.008f;
                const float sink = chance(-0.004f, 0.003f), tilt = chance(-0.004f, 0.004f),
                            roll = chance(-0.004f, 0.004f);
                const Tint tint = chance.tint(0.26f);
                if (in_pit(middle_x, middle_z, 0.1f, 0.1f)) continue;
                const float damp = 0.72f + 0.42f * cloud(middle_x, middle_z, 0.5f, 3, road.seed + 21);
                Shape slab;
                add_box(slab, {-0.5f * w, -0.5f * d, -0.07f}, {0.5f * w, 0.5f * d, 0},
                        {tint.color * damp, tint.uv_offset}, 0.007f);
                const double fall = road.kerb_height + 0.015 * double(std::abs(middle_x) - inner);  // towards the road
                append(slabs[palette("paving")], slab,
                       translate({middle_x, fall + sink, middle_z}) * lying * rotate(0.5 * tilt, 0.5 * roll, 0, 1));
            }
        }
        for (float z = road.near; z > road.far;) {
            const float z_next = std::max(road.far, z - chance(0.85f, 1.05f));
            Shape stone;
            const float d = z - z_next - 0.01f, lift = chance(-0.004f, 0.004f);
            add_box(stone, {-0.5f * kerb, -0.5f * d, -0.4f}, {0.5f * kerb, 0.5f * d, 0}, chance.tint(0.2f), 0.022f);
            append(kerbs[palette("kerb_stone")], stone,
                   translate({sign * (road.half_width + 0.5 * kerb), road.kerb_height + lift, 0.5 * (z + z_next)}) *
                       lying);
            z = z_next;
        }
        // Bed under the slabs, seen through the joints and in the pits.
        const float x0 = sign > 0 ? inner : -outer - 0.3f, x1 = sign > 0 ? outer + 0.3f : -inner,
                    y = road.kerb_height - 0.03f;
        add_facet(slabs[palette("soil")],
                  {Vec3{x0, y, road.near}, {x1, y, road.near}, {x1, y, road.far}, {x0, y, road.far}});
        for (const TreePit& pit : pits) {
            if ((pit.x > 0) != right) continue;
            const float r = pit.half + 0.02f, top = road.kerb_height + 0.03f;
            Shape& edge = slabs[palette("cast_iron")];
            for (const float side : {-1.0f, 1.0f}) {
                add_block(edge, {pit.x - r, y - 0.02f, pit.z + side * r - 0.02f},
                          {pit.x + r, top, pit.z + side * r + 0.02f});
                add_block(edge, {pit.x + side * r - 0.02f, y - 0.02f, pit.z - r},
                          {pit.x + side * r + 0.02f, top, pit.z + r});
            }
        }
        const std::string side = right ? "right" : "left";
        place_once(street, name + "/pavement_" + side, "sidewalk", slabs);
        place_once(street, name + "/kerb_" + side, "sidewalk", kerbs);
    }
}

}  // namespace pluvia
