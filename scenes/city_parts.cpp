#include "scenes/city_parts.h"

#include "scenes/bare_tree.h"
#include "scenes/street_things.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <map>

namespace pluvia {

std::vector<TreePit> tree_pits(const CityPlan& plan) {
    std::vector<TreePit> all;
    for (const bool right : {false, true})
        for (int i = 0; i < plan.trees; ++i)
            all.push_back({(right ? 1.0f : -1.0f) * (plan.road.half_width + 1.15f),
                           (right ? 27.5f : 31.0f) - 102.4f / float(plan.trees) * float(i)});
    return all;
}

void add_trees(const CityPlan& plan, Street& street, Palette& palette) {
    if (plan.trees == 0) return;
    std::vector<std::vector<int>> kinds;
    for (int i = 0; i < 4; ++i)
        kinds.push_back(add_meshes(street, "tree_" + std::to_string(i),
                                   bare_tree(palette, {.seed = uint64_t(i) + 1,
                                                       .height = 6.6f + 0.5f * float(i),
                                                       .trunk_radius = 0.12f + 0.012f * float(i),
                                                       .forks = 5})));
    Chance chance{0x7ee4 + plan.road.seed - 2};
    int index = 0;
    for (const TreePit& pit : tree_pits(plan)) {
        const float turn = chance(0, 2 * pi), size = chance(0.86f, 1.12f);
        place(street, plan.name + "/tree_" + std::to_string(index), "vegetation",
              kinds[size_t(index * 7 + index / 8) % 4],
              translate({pit.x, plan.road.kerb_height - 0.02, pit.z}) * rotate_y(turn) * scale({size, size, size}));
        ++index;
    }
    Assembly leaves;
    const auto on_pavement = [&](float x, float) {
        return plan.road.kerb_height + 0.015f * (std::abs(x) - plan.road.half_width - 0.32f);
    };
    const auto on_road = [&](float x, float z) { return plan.road.height(x, z); };
    for (const float side : {-1.0f, 1.0f}) {
        const float inner = side * (plan.road.half_width + 0.35f), outer = side * (plan.road.wall() - 0.3f),
                    gutter = side * (plan.road.half_width - 1.2f), edge = side * (plan.road.half_width - 0.03f);
        add_fallen_leaves(leaves, palette, {std::min(inner, outer), -60}, {std::max(inner, outer), 36}, 2600,
                          on_pavement, side > 0 ? 5 : 6);
        add_fallen_leaves(leaves, palette, {std::min(gutter, edge), -60}, {std::max(gutter, edge), 36}, 1500, on_road,
                          side > 0 ? 7 : 8);
    }
    place_once(street, plan.name + "/fallen_leaves", "vegetation", leaves);
}

namespace {

/// What stands by the wall of a pavement 4.6 m wide does so on others.
double within(const CityPlan& plan, double from_kerb) {
    return from_kerb < 2 ? from_kerb : from_kerb + double(plan.road.pavement) - 4.6;
}

/// On the left (right) pavement, `from_kerb` metres behind the kerb's edge, front towards the plan.road.
Transform on_left(const CityPlan& plan, double z, double from_kerb) {
    from_kerb = within(plan, from_kerb);
    return translate({-plan.road.half_width - from_kerb, plan.road.kerb_height + 0.01, z}) * rotate_y(pi / 2);
}
Transform on_right(const CityPlan& plan, double z, double from_kerb) {
    from_kerb = within(plan, from_kerb);
    return translate({plan.road.half_width + from_kerb, plan.road.kerb_height + 0.01, z}) * rotate_y(-pi / 2);
}

}  // namespace

void add_furniture(const CityPlan& plan, Street& street, Palette& palette) {
    int count = 0;
    const auto put = [&](const std::string& what, const std::string& semantic, const std::vector<int>& meshes,
                         const Transform& at) {
        place(street, plan.name + "/" + what + "_" + std::to_string(count++), semantic, meshes, at);
    };
    const auto lamp = add_meshes(street, "street_lamp", street_lamp(palette));
    for (int i = 0; i * plan.lamp_pitch < 95; ++i) {
        put("street_lamp", "pole", lamp, on_left(plan, 25 - plan.lamp_pitch * i, 0.62));
        put("street_lamp", "pole", lamp, on_right(plan, 34 - plan.lamp_pitch * i, 0.62));
    }
    const auto hydrant_mesh = add_meshes(street, "hydrant", hydrant(palette));
    put("hydrant", "static", hydrant_mesh, on_right(plan, 14.2, 0.75) * rotate_y(0.5));
    put("hydrant", "static", hydrant_mesh, on_left(plan, -22, 0.75));
    put("hydrant", "static", hydrant_mesh, on_right(plan, -45, 0.75));
    put("hydrant", "static", hydrant_mesh, on_left(plan, 31.5, 0.75));
    const auto can = add_meshes(street, "trash_can", trash_can(palette));
    for (const auto& [left, z, from] : {std::tuple{true, 8.6, 3.9},
                                        {true, 8.0, 3.75},
                                        {false, 9.6, 3.8},
                                        {false, -12.0, 3.9},
                                        {false, -12.6, 3.7},
                                        {true, -18.0, 3.9},
                                        {true, -40.0, 3.8},
                                        {false, 24.0, 3.9}})
        put("trash_can", "static", can, (left ? on_left(plan, z, from) : on_right(plan, z, from)) * rotate_y(z));
    const auto basket = add_meshes(street, "litter_basket", litter_basket(palette));
    put("litter_basket", "static", basket, on_left(plan, 11.5, 1.0));
    put("litter_basket", "static", basket, on_right(plan, -4.5, 1.0));
    put("litter_basket", "static", basket, on_left(plan, -30, 1.0));
    const auto box = add_meshes(street, "mail_box", mail_box(palette));
    put("mail_box", "static", box, on_left(plan, 15.0, 1.1));
    put("mail_box", "static", box, on_right(plan, 3.4, 1.1));
    put("mail_box", "static", box, on_left(plan, -34, 1.1));
    if (!plan.cars.empty()) {
        const auto meter = add_meshes(street, "parking_meter", parking_meter(palette));
        for (double z = 28; z > -60; z -= 6.4) {
            put("parking_meter", "pole", meter, on_left(plan, z, 0.5));
            put("parking_meter", "pole", meter, on_right(plan, z - 3.2, 0.5));
        }
    }
    const auto bench = add_meshes(street, "bench", park_bench(palette));
    put("bench", "static", bench, on_left(plan, 2.2, 1.2) * rotate_y(pi));
    put("bench", "static", bench, on_right(plan, -24, 1.2) * rotate_y(pi));
    put("sandwich_board", "static", add_meshes(street, "board_1", sandwich_board(palette, "COFFEE", "2.50")),
        on_left(plan, 13.0, 2.6) * rotate_y(-1.2));
    put("sandwich_board", "static", add_meshes(street, "board_2", sandwich_board(palette, "ROSES", "FRESH")),
        on_right(plan, -5, 2.9) * rotate_y(1.1));
    put("one_way", "traffic sign", add_meshes(street, "one_way", one_way_sign(palette)), on_left(plan, 5.2, 0.6));
    put("name_sign", "traffic sign", add_meshes(street, "name_sign", name_sign(palette, "ELM ST")),
        on_right(plan, -69, 0.6) * rotate_y(pi / 2));
    for (uint64_t i = 0; i < 2; ++i) {
        const auto tub = add_meshes(street, "planter_" + std::to_string(i), planter(palette, i));
        put("planter", "static", tub, on_left(plan, i == 0 ? 20.6 : -7.6, 3.9));
        put("planter", "static", tub, on_right(plan, i == 0 ? -9.4 : 17.4, 3.9) * rotate_y(1));
    }
    const auto bag = add_meshes(street, "rubbish_bag", rubbish_bag(palette, 5));
    for (int i = 0; i < 5; ++i)
        put("rubbish_bag", "static", bag,
            on_right(plan, 20.4 - 0.45 * i, 0.9 + 0.25 * (i % 2)) * rotate_y(2.1 * i) *
                scale({1, 0.8 + 0.1 * (i % 3), 1}));
    const auto cone = add_meshes(street, "traffic_cone", traffic_cone(palette));
    for (int i = 0; i < 3; ++i)
        put("traffic_cone", "static", cone, translate({3.5 - 0.4 * i, plan.road.height(3.4f, -16), -15.0 - 1.1 * i}));
}

void add_cars(const CityPlan& plan, Street& street, Palette& palette) {
    std::map<std::string, std::vector<int>> meshes;
    int index = 0;
    for (const ParkedCar& car_of : plan.cars) {
        const std::string key = car_of.paint + "_" + std::to_string(int(car_of.shape.length * 100));
        if (!meshes.count(key)) meshes[key] = add_meshes(street, key, car(palette, car_of.shape, car_of.paint));
        const double x = (car_of.left ? -1 : 1) * (plan.road.half_width - 1.15),
                     y = plan.road.height(float(x), float(car_of.z)) - 0.01;
        place(street, plan.name + "/car_" + std::to_string(index), "car", meshes[key],
              translate({x, y, car_of.z}) * rotate_y((car_of.left ? 0 : pi) + 0.012 * (index % 3 - 1)));
        ++index;
    }
}

}  // namespace pluvia
