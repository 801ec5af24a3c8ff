#include "scenes/arcade_parts.h"

#include "scenes/arcade_things.h"
#include "scenes/road.h"
#include "scenes/street_things.h"
#include "scenes/utilities.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pluvia {

void add_ground(const ArcadePlan& plan, Street& street, Palette& palette) {
    // Fields of pavers, turned in turn so that their pattern of shades does not show.
    std::vector<std::vector<int>> fields, sides;
    for (uint64_t i = 0; i < 3; ++i) {
        fields.push_back(
            add_meshes(street, "pavers_" + std::to_string(i), paver_field(palette, "paver", 2, 0.2f, 0.1f, i)));
        sides.push_back(add_meshes(street, "side_pavers_" + std::to_string(i),
                                   paver_field(palette, "red_paver", 0.9f, 0.3f, 0.15f, i + 7)));
    }
    int index = 0;
    const int columns = int(std::ceil(plan.kerb));
    for (double z = plan.near_end - 1; z > plan.far_end - 8; z -= 2)
        for (int column = 0; column < columns; ++column) {
            const double x = 2 * column - (columns - 1);
            const double fall = -0.012 * std::abs(x);
            place(street, plan.name + "/paving_" + std::to_string(index), "road",
                  fields[size_t(index * 5 + index / 7) % 3], translate({x, fall, z}) * rotate_y(pi * (index % 2)));
            ++index;
        }
    index = 0;
    for (double z = plan.near_end - 0.45; z > plan.far_end; z -= 0.9)
        for (const double side : {-1.0, 1.0})
            for (double x = plan.kerb + 0.17; x < plan.wall - 0.05; x += 0.9) {
                place(street, plan.name + "/side_paving_" + std::to_string(index), "sidewalk",
                      sides[size_t(index * 5 + index / 4) % 3],
                      translate({side * (x + 0.45), 0.05, z}) * rotate_y(pi * (index % 2)));
                ++index;
            }
    Assembly edges;
    Chance chance{0x3e};
    constexpr Transform lying = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
    for (const float side : {-1.0f, 1.0f})
        for (float z = plan.near_end; z > plan.far_end; z -= 0.6f) {
            Shape stone;
            add_box(stone, {-0.08f, -0.295f, -0.2f}, {0.08f, 0.295f, 0}, chance.tint(0.25f), 0.012f);
            append(edges[palette("kerb_stone")], stone,
                   translate({side * (plan.kerb + 0.085), 0.052, z - 0.3}) * lying);
            if (int(z / 0.6f) % 9 == 0) {  // grate
                Shape grate;
                for (float t = -0.27f; t < 0.27f; t += 0.045f)
                    add_block(grate, {-0.12f, -0.03f, t}, {0.12f, 0, t + 0.02f});
                append(edges[palette("cast_iron")], grate, translate({side * (plan.kerb - 0.13), -0.028, z - 0.3}));
            }
        }
    place_once(street, plan.name + "/kerbs", "sidewalk", edges);
    const auto cover = add_meshes(street, "manhole", manhole(palette));
    for (int i = 0; i < 6; ++i)
        place(street, plan.name + "/manhole_" + std::to_string(i), "road", cover,
              translate({i % 2 == 0 ? 0.9 : -1.3, -0.004, 13 - 11.3 * i}));
    Assembly block;
    add_facet(block[palette("soil")],
              {Vec3{-60, -0.25f, 70}, {60, -0.25f, 70}, {60, -0.25f, -110}, {-60, -0.25f, -110}});
    for (const auto& [z0, z1] :
         {std::pair{plan.far_end + 0.0f, plan.far_end - 7.0f}, std::pair{plan.near_end + 7.0f, plan.near_end}})
        for (float x = -30; x < 30; x += 3)
            add_facet(block[palette("asphalt")],
                      {Vec3{x, -0.04f, z0}, {x + 3, -0.04f, z0}, {x + 3, -0.04f, z1}, {x, -0.04f, z1}},
                      {Rgb(0.8f), {}});
    place_once(street, plan.name + "/block", "road", block);
}

void add_poles(const ArcadePlan& plan, Street& street, Palette& palette) {
    const auto lamp = add_meshes(street, "twin_lantern", twin_lantern(palette));
    int index = 0;
    for (double z = 19; z > plan.far_end; z -= plan.lantern_pitch, ++index) {
        const bool on_left = index % 2 == 0;
        const double x = plan.kerb + 0.35;
        place(street, plan.name + "/twin_lantern_" + std::to_string(index), "pole", lamp,
              translate({on_left ? -x : x, 0.05, z}) * rotate_y(on_left ? pi / 2 : -pi / 2));
    }
    if (!plan.poles) return;
    const auto pole = add_meshes(street, "utility_pole", utility_pole(palette));
    std::vector<Vec3> right, left;
    index = 0;
    for (float z = 16; z > plan.far_end; z -= 15, ++index) {
        const float x = (index % 2 == 0 ? 1.0f : -1.0f) * (plan.kerb + 0.25f);
        place(street, plan.name + "/utility_pole_" + std::to_string(index), "pole", pole, translate({x, 0, z}));
        (x > 0 ? right : left).push_back({x, 0, z});
    }
    Assembly cables;
    const auto along = [&](const std::vector<Vec3>& poles) {
        for (size_t i = 1; i < poles.size(); ++i)
            for (const float x : {-0.65f, -0.3f, 0.3f, 0.65f})
                for (const float y : {6.82f, 7.52f})
                    add_cable(cables, palette, poles[i - 1] + Vec3(x, y, 0.13f), poles[i] + Vec3(x, y, 0.13f),
                              0.5f + 0.2f * x);
        for (size_t i = 1; i < poles.size(); ++i) {
            add_cable(cables, palette, poles[i - 1] + Vec3(0, 5.9f, 0), poles[i] + Vec3(0, 5.9f, 0), 0.45f, 0.018f);
            add_cable(cables, palette, poles[i - 1] + Vec3(0, 5.5f, 0), poles[i] + Vec3(0, 5.6f, 0), 0.7f, 0.012f);
        }
    };
    along(right), along(left);
    for (size_t i = 0; i < std::min(left.size(), right.size()); ++i) {  // across, and to the houses
        add_cable(cables, palette, right[i] + Vec3(0, 6.4f, 0), left[i] + Vec3(0, 6.3f, 0), 0.4f, 0.011f);
        for (const float dz : {-4.0f, 3.0f, 6.0f}) {
            add_cable(cables, palette, right[i] + Vec3(0, 6.1f, 0), {-plan.wall, 5.2f + 0.1f * dz, right[i].z + dz},
                      0.25f);
            add_cable(cables, palette, left[i] + Vec3(0, 6.2f, 0), {plan.wall, 5.0f - 0.1f * dz, left[i].z + dz}, 0.3f);
        }
    }
    place_once(street, plan.name + "/cables", "static", cables);
}

void add_things(const ArcadePlan& plan, Street& street, Palette& palette) {
    int count = 0;
    const auto put = [&](const std::string& what, const std::vector<int>& meshes, const Transform& at) {
        place(street, plan.name + "/" + what + "_" + std::to_string(count++), "static", meshes, at);
    };
    const auto cone = add_meshes(street, "traffic_cone", traffic_cone(palette));
    for (const auto& [x, z] : {std::pair{0.3, 2.2}, {0.0, 1.2}, {0.2, -33.0}})
        put("cone", cone, translate({plan.kerb + x, 0.0, z}));
    for (const auto& [x, z] : {std::pair{0.2, -13.0}, {0.1, -14.1}})
        put("cone", cone, translate({-plan.kerb - x, 0.0, z}));
    const double by_wall = plan.wall - 0.4;
    const auto bag = add_meshes(street, "rubbish_bag", rubbish_bag(palette, 9));
    for (int i = 0; i < 6; ++i)
        put("rubbish_bag", bag,
            translate({-by_wall + 0.18 * (i % 2), 0.05, 5.6 - 0.42 * i}) * rotate_y(1.7 * i) *
                scale({0.9, 0.75 + 0.1 * (i % 3), 0.9}));
    for (uint64_t i = 0; i < 2; ++i) {
        const auto tub = add_meshes(street, "planter_" + std::to_string(i), planter(palette, i + 5));
        put("planter", tub, translate({by_wall - 0.05, 0.05, i == 0 ? 10.4 : -19.0}) * scale({0.8, 0.8, 0.8}));
        put("planter", tub, translate({0.05 - by_wall, 0.05, i == 0 ? -4.0 : -27.2}) * scale({0.8, 0.9, 0.8}));
    }
    const auto can = add_meshes(street, "trash_can", trash_can(palette));
    for (const auto& [x, z] : {std::pair{by_wall, -8.2}, {-by_wall, -21.5}, {by_wall, 6.9}})
        put("trash_can", can, translate({x, 0.05, z}));
}

}  // namespace pluvia
