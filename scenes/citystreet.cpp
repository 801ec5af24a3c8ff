// The plan of the city street: houses, pavements, what stands on them, and the cameras. The street runs from z = 40 to
// z = -72 between walls 18 m apart; a row of houses across it ends the view at both ends, beyond a crossing street.
#include "scenes/bare_tree.h"
#include "scenes/builders.h"
#include "scenes/car.h"
#include "scenes/citystreet_houses.h"
#include "scenes/road.h"
#include "scenes/street_things.h"

#include "renderer/core/units.h"

#include <cctype>
#include <map>
#include <utility>

namespace pluvia {
namespace {

const std::string name = "citystreet";
constexpr Road road = {.half_width = 4.4f, .near = 40, .far = -72, .seed = 3};

/// The houses that rows are made of: each kind twice, differing in its sign, its windows and what it sells.
class Houses {
public:
    Houses(Street& street, Palette& palette) : street_(street), palette_(palette) {}

    /// Side by side along a wall; `start` is its left end as seen by who faces it. Small letters: the second of a kind.
    void add_row(const std::string& row, const std::string& letters, const Transform& start) {
        double x = 0;
        for (size_t i = 0; i < letters.size(); ++i) {
            const House& house = get(letters[i]);
            place(street_, name + "/" + row + "_" + std::to_string(i), "building", house.meshes,
                  start * translate({x, 0.15, 0}));
            x += house.width;
        }
    }

private:
    struct House {
        std::vector<int> meshes;
        float width;
    };
    const House& get(char letter) {
        const auto found = houses_.find(letter);
        if (found != houses_.end()) return found->second;
        static const std::map<char, const char*> second_signs = {{'a', "MUSIC"},  {'c', "CAFE ROMA"}, {'d', "GROCER"},
                                                                 {'e', "CINEMA"}, {'g', "RECORDS"},   {'i', "SHOES"}};
        TownHouse house = city_house(char(std::toupper(letter)));
        if (second_signs.count(letter)) house.sign = second_signs.at(letter);
        house.name = std::string("house_") + letter;
        return houses_[letter] = {add_meshes(street_, house.name, town_house(palette_, house)), house.width};
    }

    Street& street_;
    Palette& palette_;
    std::map<char, House> houses_;
};

void add_houses(Street& street, Palette& palette) {
    const double wall = road.wall();
    Houses houses(street, palette);
    // left_wall starts near and runs away from the viewer, right_wall starts far and comes back.
    houses.add_row("left", "DBCAFEHIGdbJe", left_wall(-wall, 36));
    houses.add_row("right", "ejGhDaFcBIAbE", right_wall(wall, -72));
    houses.add_row("far", "HEADFGC", end_wall(-30, -86));
    houses.add_row("behind", "AFdCEH", facing_away(26, 53));
}

std::vector<TreePit> pits() {
    std::vector<TreePit> all;
    for (const bool right : {false, true})
        for (int i = 0; i < 8; ++i)
            all.push_back(
                {(right ? 1.0f : -1.0f) * (road.half_width + 1.15f), (right ? 27.5f : 31.0f) - 12.8f * float(i)});
    return all;
}

void add_ground(Street& street, Palette& palette) {
    add_carriageway(street, palette, name, road);
    add_pavements(street, palette, name, road, pits());
    // The crossing streets at both ends, and bare ground under everything.
    Assembly crossing;
    for (const auto& [z0, z1] : {std::pair{-72.0f, -82.0f}, std::pair{49.0f, 40.0f}})
        for (float x = -60; x < 60; x += 4)
            add_facet(crossing[palette("asphalt")],
                      {Vec3{x, -0.02f, z0}, {x + 4, -0.02f, z0}, {x + 4, -0.02f, z1}, {x, -0.02f, z1}},
                      {Rgb(0.8f), {}});
    place_once(street, name + "/crossing", "road", crossing);
    Assembly far_pavement;
    for (const auto& [z0, z1] : {std::pair{-82.0f, -86.1f}, std::pair{53.1f, 49.0f}})
        for (float x = -60; x < 60; x += 2) {
            Shape slab;
            add_block(slab, {x, -0.1f, z1}, {x + 1.99f, 0.15f, z0}, {Rgb(0.9f), {}});
            append(far_pavement[palette("paving")], slab, {});
        }
    place_once(street, name + "/far_pavements", "sidewalk", far_pavement);
    Assembly block;
    add_facet(block[palette("soil")], {Vec3{-80, -0.3f, 90}, {80, -0.3f, 90}, {80, -0.3f, -120}, {-80, -0.3f, -120}});
    place_once(street, name + "/block", "terrain", block);
}

void add_trees(Street& street, Palette& palette) {
    std::vector<std::vector<int>> kinds;
    for (int i = 0; i < 4; ++i)
        kinds.push_back(add_meshes(street, "tree_" + std::to_string(i),
                                   bare_tree(palette, {.seed = uint64_t(i) + 1,
                                                       .height = 6.6f + 0.5f * float(i),
                                                       .trunk_radius = 0.12f + 0.012f * float(i),
                                                       .forks = 5})));
    Chance chance{0x7ee5};
    int index = 0;
    for (const TreePit& pit : pits()) {
        const float turn = chance(0, 2 * pi), size = chance(0.86f, 1.12f);
        place(street, name + "/tree_" + std::to_string(index), "vegetation", kinds[size_t(index * 7 + index / 8) % 4],
              translate({pit.x, road.kerb_height - 0.02, pit.z}) * rotate_y(turn) * scale({size, size, size}));
        ++index;
    }
    Assembly leaves;
    const auto on_pavement = [](float x, float) {
        return road.kerb_height + 0.015f * (std::abs(x) - road.half_width - 0.32f);
    };
    const auto on_road = [](float x, float z) { return road.height(x, z); };
    for (const float side : {-1.0f, 1.0f}) {
        const float inner = side * (road.half_width + 0.35f), outer = side * (road.wall() - 0.3f),
                    gutter = side * (road.half_width - 1.2f), edge = side * (road.half_width - 0.03f);
        add_fallen_leaves(leaves, palette, {std::min(inner, outer), -60}, {std::max(inner, outer), 36}, 2600,
                          on_pavement, side > 0 ? 5 : 6);
        add_fallen_leaves(leaves, palette, {std::min(gutter, edge), -60}, {std::max(gutter, edge), 36}, 1500, on_road,
                          side > 0 ? 7 : 8);
    }
    place_once(street, name + "/fallen_leaves", "vegetation", leaves);
}

/// On the left (right) pavement, `from_kerb` metres behind the kerb's edge, front towards the road.
Transform on_left(double z, double from_kerb) {
    return translate({-road.half_width - from_kerb, road.kerb_height + 0.01, z}) * rotate_y(pi / 2);
}
Transform on_right(double z, double from_kerb) {
    return translate({road.half_width + from_kerb, road.kerb_height + 0.01, z}) * rotate_y(-pi / 2);
}

void add_furniture(Street& street, Palette& palette) {
    int count = 0;
    const auto put = [&](const std::string& what, const std::string& semantic, const std::vector<int>& meshes,
                         const Transform& at) {
        place(street, name + "/" + what + "_" + std::to_string(count++), semantic, meshes, at);
    };
    const auto lamp = add_meshes(street, "street_lamp", street_lamp(palette));
    for (int i = 0; i < 4; ++i) {
        put("street_lamp", "pole", lamp, on_left(25 - 25.6 * i, 0.62));
        put("street_lamp", "pole", lamp, on_right(34 - 25.6 * i, 0.62));
    }
    const auto hydrant_mesh = add_meshes(street, "hydrant", hydrant(palette));
    put("hydrant", "static", hydrant_mesh, on_right(14.2, 0.75) * rotate_y(0.5));
    put("hydrant", "static", hydrant_mesh, on_left(-22, 0.75));
    put("hydrant", "static", hydrant_mesh, on_right(-45, 0.75));
    put("hydrant", "static", hydrant_mesh, on_left(31.5, 0.75));
    const auto can = add_meshes(street, "trash_can", trash_can(palette));
    for (const auto& [left, z, from] : {std::tuple{true, 8.6, 3.9},
                                        {true, 8.0, 3.75},
                                        {false, 9.6, 3.8},
                                        {false, -12.0, 3.9},
                                        {false, -12.6, 3.7},
                                        {true, -18.0, 3.9},
                                        {true, -40.0, 3.8},
                                        {false, 24.0, 3.9}})
        put("trash_can", "static", can, (left ? on_left(z, from) : on_right(z, from)) * rotate_y(z));
    const auto basket = add_meshes(street, "litter_basket", litter_basket(palette));
    put("litter_basket", "static", basket, on_left(11.5, 1.0));
    put("litter_basket", "static", basket, on_right(-4.5, 1.0));
    put("litter_basket", "static", basket, on_left(-30, 1.0));
    const auto box = add_meshes(street, "mail_box", mail_box(palette));
    put("mail_box", "static", box, on_left(15.0, 1.1));
    put("mail_box", "static", box, on_right(3.4, 1.1));
    put("mail_box", "static", box, on_left(-34, 1.1));
    const auto meter = add_meshes(street, "parking_meter", parking_meter(palette));
    for (double z = 28; z > -60; z -= 6.4) {
        put("parking_meter", "pole", meter, on_left(z, 0.5));
        put("parking_meter", "pole", meter, on_right(z - 3.2, 0.5));
    }
    const auto bench = add_meshes(street, "bench", park_bench(palette));
    put("bench", "static", bench, on_left(2.2, 1.2) * rotate_y(pi));
    put("bench", "static", bench, on_right(-24, 1.2) * rotate_y(pi));
    put("sandwich_board", "static", add_meshes(street, "board_1", sandwich_board(palette, "COFFEE", "2.50")),
        on_left(13.0, 2.6) * rotate_y(-1.2));
    put("sandwich_board", "static", add_meshes(street, "board_2", sandwich_board(palette, "ROSES", "FRESH")),
        on_right(-5, 2.9) * rotate_y(1.1));
    put("one_way", "traffic sign", add_meshes(street, "one_way", one_way_sign(palette)), on_left(5.2, 0.6));
    put("name_sign", "traffic sign", add_meshes(street, "name_sign", name_sign(palette, "ELM ST")),
        on_right(-69, 0.6) * rotate_y(pi / 2));
    for (uint64_t i = 0; i < 2; ++i) {
        const auto tub = add_meshes(street, "planter_" + std::to_string(i), planter(palette, i));
        put("planter", "static", tub, on_left(i == 0 ? 20.6 : -7.6, 3.9));
        put("planter", "static", tub, on_right(i == 0 ? -9.4 : 17.4, 3.9) * rotate_y(1));
    }
    const auto bag = add_meshes(street, "rubbish_bag", rubbish_bag(palette, 5));
    for (int i = 0; i < 5; ++i)
        put("rubbish_bag", "static", bag,
            on_right(20.4 - 0.45 * i, 0.9 + 0.25 * (i % 2)) * rotate_y(2.1 * i) * scale({1, 0.8 + 0.1 * (i % 3), 1}));
    const auto cone = add_meshes(street, "traffic_cone", traffic_cone(palette));
    for (int i = 0; i < 3; ++i)
        put("traffic_cone", "static", cone, translate({3.5 - 0.4 * i, road.height(3.4f, -16), -15.0 - 1.1 * i}));
}

void add_cars(Street& street, Palette& palette) {
    struct Parked {
        const char* paint;
        CarShape shape;
        bool left;
        double z;
    };
    CarShape taxi = saloon();
    taxi.taxi_sign = true;
    const Parked parked[] = {{"car_silver", saloon(), true, -6.5},   {"car_red", hatchback(), true, -13.2},
                             {"car_black", estate(), true, -26},     {"car_blue", saloon(), true, -38.5},
                             {"car_yellow", taxi, false, -30.5},     {"car_white", hatchback(), false, -36.8},
                             {"car_green", estate(), false, -44.5},  {"car_black", saloon(), false, -57},
                             {"car_silver", hatchback(), true, -52}, {"car_blue", hatchback(), false, 31},
                             {"car_red", saloon(), true, 36}};
    std::map<std::string, std::vector<int>> meshes;
    int index = 0;
    for (const Parked& car_of : parked) {
        const std::string key = std::string(car_of.paint) + "_" + std::to_string(int(car_of.shape.length * 100));
        if (!meshes.count(key)) meshes[key] = add_meshes(street, key, car(palette, car_of.shape, car_of.paint));
        const double x = (car_of.left ? -1 : 1) * (road.half_width - 1.15),
                     y = road.height(float(x), float(car_of.z)) - 0.01;
        place(street, name + "/car_" + std::to_string(index), "car", meshes[key],
              translate({x, y, car_of.z}) * rotate_y((car_of.left ? 0 : pi) + 0.012 * (index % 3 - 1)));
        ++index;
    }
}

void add_cameras(Scene& scene) {
    constexpr float seconds = 12;
    scene.cameras = {look_at("front", {0.25, 1.75, 22}, {0, 2.7, -30}, 35, {0, 0, -3}, seconds),
                     look_at("far", {-0.6, 2.6, 37}, {0.2, 3.2, -40}, 50, {0, 0, -4}, seconds),
                     look_at("back", {-1.0, 1.75, -20}, {-0.2, 2.6, 30}, 35, {0, 0, 3}, seconds),
                     look_at("sideleft", {3.9, 1.7, 21}, {-9, 3.3, 7}, 30, {0, 0, -2}, seconds),
                     look_at("sideright", {-3.9, 1.7, 8}, {9, 3.3, -6}, 30, {0, 0, -2}, seconds),
                     look_at("sideinner", {4.1, 1.75, 12.6}, {-9, 3.3, 10.9}, 30, {0, 0, -2}, seconds)};
}

}  // namespace

Scene build_citystreet() {
    Street street;
    street.scene.name = name;
    Palette palette(street);
    add_ground(street, palette);
    add_houses(street, palette);
    add_trees(street, palette);
    add_cars(street, palette);
    add_furniture(street, palette);
    add_cameras(street.scene);
    check(street.scene, name);
    return std::move(street.scene);
}

}  // namespace pluvia
