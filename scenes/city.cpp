#include "scenes/city.h"

#include "scenes/city_houses.h"
#include "scenes/city_parts.h"

#include <cctype>
#include <map>
#include <utility>

namespace pluvia {
namespace {

/// The houses that rows are made of: each kind twice, differing in its sign, its windows and what it sells.
class Houses {
public:
    Houses(const CityPlan& plan, Street& street, Palette& palette) : plan_(plan), street_(street), palette_(palette) {}

    /// Side by side along a wall; `start` is its left end as seen by who faces it. Small letters: the second of a kind.
    void add_row(const std::string& row, const std::string& letters, const Transform& start) {
        double x = 0;
        for (size_t i = 0; i < letters.size(); ++i) {
            const House& house = get(letters[i]);
            place(street_, plan_.name + "/" + row + "_" + std::to_string(i), "building", house.meshes,
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
        house.storeys.insert(house.storeys.end(), size_t(plan_.extra_storeys), 3.2f);
        house.name = std::string("house_") + letter;
        return houses_[letter] = {add_meshes(street_, house.name, town_house(palette_, house)), house.width};
    }

    const CityPlan& plan_;
    Street& street_;
    Palette& palette_;
    std::map<char, House> houses_;
};

void add_houses(const CityPlan& plan, Street& street, Palette& palette) {
    const double wall = plan.road.wall();
    Houses houses(plan, street, palette);
    // left_wall starts near and runs away from the viewer, right_wall starts far and comes back.
    houses.add_row("left", plan.left, left_wall(-wall, 36));
    houses.add_row("right", plan.right, right_wall(wall, -72));
    houses.add_row("far", plan.far, end_wall(-30, -86));
    houses.add_row("behind", plan.behind, facing_away(26, 53));
    // Across the ends of the crossing streets, for who turns there.
    const std::string some = plan.left.substr(0, 4);
    houses.add_row("west_far", some, left_wall(-61, -62)), houses.add_row("west_near", some, left_wall(-61, 62));
    houses.add_row("east_far", some, right_wall(61, -94)), houses.add_row("east_near", some, right_wall(61, 30));
}

void add_ground(const CityPlan& plan, Street& street, Palette& palette) {
    add_carriageway(street, palette, plan.name, plan.road);
    add_pavements(street, palette, plan.name, plan.road, tree_pits(plan));
    // The crossing streets at both ends, and bare ground under everything.
    Assembly crossing;
    for (const auto& [z0, z1] : {std::pair{-72.0f, -82.0f}, std::pair{49.0f, 40.0f}})
        for (float x = -60; x < 60; x += 4)
            add_facet(crossing[palette("asphalt")],
                      {Vec3{x, -0.02f, z0}, {x + 4, -0.02f, z0}, {x + 4, -0.02f, z1}, {x, -0.02f, z1}},
                      {Rgb(0.8f), {}});
    place_once(street, plan.name + "/crossing", "road", crossing);
    Assembly far_pavement;
    for (const auto& [z0, z1] : {std::pair{-82.0f, -86.1f}, std::pair{53.1f, 49.0f}})
        for (float x = -60; x < 60; x += 2) {
            Shape slab;
            add_block(slab, {x, -0.1f, z1}, {x + 1.99f, 0.15f, z0}, {Rgb(0.9f), {}});
            append(far_pavement[palette("paving")], slab, {});
        }
    place_once(street, plan.name + "/far_pavements", "sidewalk", far_pavement);
    Assembly plinths;  // on which houses stand, seen at their ends
    for (const float x : {-plan.road.wall() - 11.9f, plan.road.wall() + 0.1f})
        add_block(plinths[palette("kerb_stone")], {x, -0.3f, -71.9f}, {x + 11.8f, 0.14f, 35.9f}, {Rgb(0.8f), {}});
    place_once(street, plan.name + "/plinths", "building", plinths);
    Assembly block;
    add_facet(block[palette("soil")], {Vec3{-80, -0.3f, 90}, {80, -0.3f, 90}, {80, -0.3f, -120}, {-80, -0.3f, -120}});
    place_once(street, plan.name + "/block", "terrain", block);
}

}  // namespace

Scene build_city(const CityPlan& plan) {
    Street street;
    street.scene.name = plan.name;
    Palette palette(street);
    add_ground(plan, street, palette);
    add_houses(plan, street, palette);
    add_trees(plan, street, palette);
    add_cars(plan, street, palette);
    add_furniture(plan, street, palette);
    street.scene.cameras = plan.cameras;
    check(street.scene, plan.name);
    return std::move(street.scene);
}

}  // namespace pluvia
