#include "scenes/arcade.h"

#include "scenes/arcade_parts.h"
#include "scenes/arcade_things.h"
#include "scenes/japanesestreet_signs.h"
#include "scenes/tenement.h"
#include "scenes/utilities.h"

#include "renderer/core/units.h"

#include <map>
#include <utility>

namespace pluvia {
namespace {

Tenement kind(char letter) {
    switch (letter) {
        case 'A':
            return {.width = 6.2f,
                    .ground = "gg",
                    .upper = "rrr",
                    .wall = "brown_tiles",
                    .base = "dark_tiles",
                    .canopy = true,
                    .lit = 0.5f};
        case 'B':
            return {.width = 5.0f,
                    .ground = "ns",
                    .upper = "pp",
                    .wall = "ochre_mortar",
                    .base = "dark_mortar",
                    .cloth = {0.04f, 0.06f, 0.18f},
                    .lit = 0.4f};
        case 'C':
            return {.width = 7.4f,
                    .ground = "gdw",
                    .upper = "rrrr",
                    .wall = "beige_tiles",
                    .base = "brown_tiles",
                    .lit = 0.6f};
        case 'D':
            return {.width = 4.6f,
                    .ground = "n",
                    .upper = "pr",
                    .wall = "dark_mortar",
                    .base = "dark_mortar",
                    .canopy = true,
                    .cloth = {0.55f, 0.05f, 0.03f},
                    .lit = 0.4f};
        case 'E':
            return {.width = 6.8f,
                    .ground = "sg",
                    .upper = "ppp",
                    .wall = "grey_mortar",
                    .base = "brown_tiles",
                    .frame = "aluminium",
                    .lit = 0.35f};
        case 'F':
            return {.width = 5.6f,
                    .ground = "wg",
                    .upper = "rrrr",
                    .wall = "dark_tiles",
                    .base = "dark_tiles",
                    .lit = 0.55f};
        case 'G':
            return {.width = 5.2f,
                    .ground = "sb",
                    .upper = "pp",
                    .wall = "brown_tiles",
                    .base = "grey_mortar",
                    .frame = "aluminium",
                    .lit = 0.3f};
        default:
            return {.width = 6.0f,
                    .ground = "dn",
                    .upper = "rpr",
                    .wall = "beige_tiles",
                    .base = "beige_tiles",
                    .cloth = {0.1f, 0.25f, 0.12f},
                    .lit = 0.5f};
    }
}

class Row {
public:
    Row(const ArcadePlan& plan, Street& street, Palette& palette) : plan_(plan), street_(street), palette_(palette) {
        const auto tall = tall_prints(), wide = wide_prints(), castors = castor_prints();
        for (size_t i = 0; i < tall.size(); ++i) {
            const float height = 1.7f + 0.45f * float(i % 3);
            SignPrint print = tall[i];
            print.aspect = 0.72f / height;
            tall_.push_back(add_meshes(street, print.name, projecting_sign(palette, print, 0.72f, height)));
        }
        for (const SignPrint& print : wide)
            wide_.push_back(add_meshes(street, print.name, wall_sign(palette, print, 2.6f, 0.65f)));
        for (const SignPrint& print : castors)
            castor_.push_back(add_meshes(street, print.name, castor_sign(palette, print, 0.55f, 1.0f)));
        neon_.push_back(add_meshes(street, "neon_1", neon_sign(palette, {"ya_roast", "niku"}, 0.8f, "orange")));
        neon_.push_back(add_meshes(street, "neon_2", neon_sign(palette, {"sake"}, 0.9f, "red")));
        neon_.push_back(add_meshes(street, "neon_3", neon_sign(palette, {"yu"}, 0.8f, "blue")));
        neon_.push_back(add_meshes(street, "neon_4", neon_sign(palette, {"ba", "bar"}, 0.6f, "pink")));
        list_ = add_meshes(street, "tenant_list", tenant_list(palette, 3, 5));
        cooler_ = add_meshes(street, "air_conditioner", air_conditioner(palette));
        meter_ = add_meshes(street, "meter_box", meter_box(palette));
        lantern_ = add_meshes(street, "round_lantern", round_lantern(palette));
        for (uint64_t i = 0; i < 3; ++i)
            vending_.push_back(add_meshes(street, "vending_machine_" + std::to_string(i), vending_machine(palette, i)));
    }

    /// Houses side by side with their signs; `start`: left end of the wall as seen by who faces it.
    void add(const std::string& row, const std::string& letters, const Transform& start, bool with_signs) {
        double x = 0;
        Chance chance{instance_id(row)};
        for (size_t i = 0; i < letters.size(); ++i) {
            Tenement house = kind(letters[i]);
            for (int k = 0; k < plan_.extra_storeys; ++k) house.upper += house.upper.back();
            if (!houses_.count(letters[i])) {
                house.name = std::string("tenement_") + letters[i];
                houses_[letters[i]] = add_meshes(street_, house.name, tenement(palette_, house));
            }
            const std::string path = plan_.name + "/" + row + "_" + std::to_string(i);
            place(street_, path, "building", houses_[letters[i]], start * translate({x, 0.05, 0}));
            if (with_signs) decorate(path, house, start * translate({x, 0.05, 0}), chance);
            x += house.width;
        }
    }

private:
    void put(const std::string& path, const std::string& what, const std::string& semantic,
             const std::vector<int>& meshes, const Transform& at) {
        place(street_, path + "_" + what + "_" + std::to_string(count_++), semantic, meshes, at);
    }

    void decorate(const std::string& path, const Tenement& house, const Transform& wall_frame, Chance& chance) {
        const double pitch = house.width / double(house.ground.size());
        for (size_t i = 0; i < house.ground.size(); ++i) {
            const double middle = pitch * (double(i) + 0.5);
            const char letter = house.ground[i];
            const bool has_sign = letter == 'g' || letter == 'n' || letter == 'w' || letter == 's';
            if (has_sign)
                put(path, "sign", "building", wide_[size_t(next_wide_++) % wide_.size()],
                    wall_frame * translate({middle, house.ground_height - 0.72, 0}));
            if (letter == 'd')
                put(path, "list", "building", list_, wall_frame * translate({middle - 1.15, 1.15, 0.01}));
            if (letter == 'b') {
                put(path, "vending_machine", "static", vending_[size_t(next_vending_++) % vending_.size()],
                    wall_frame * translate({middle - 0.55, 0, 0.05}));
                put(path, "vending_machine", "static", vending_[size_t(next_vending_++) % vending_.size()],
                    wall_frame * translate({middle + 0.55, 0, 0.05}));
            }
            if (letter == 'n')
                for (const double dx : {-0.9, -0.3, 0.3, 0.9})
                    put(path, "lantern", "building", lantern_,
                        wall_frame * translate({middle + dx, house.ground_height - 0.8, 0.42}));
            if (chance(0, 1) < 0.55f && letter != 'b' && letter != 's')
                put(path, "castor_sign", "static", castor_[size_t(next_castor_++) % castor_.size()],
                    wall_frame * translate({middle + chance(0.5f, 0.9f), 0, 0.75f + chance(0, 0.35f)}) *
                        rotate_y(1.5708 + chance(-0.5f, 0.5f)));
        }
        // Signs stand out one above the other at one end of the house.
        const double at_end = chance(0, 1) < 0.5f ? 0.3 : house.width - 0.3;
        double y = house.ground_height + chance(-0.1f, 0.5f);
        const int stack = int(chance(plan_.signs - 1, plan_.signs + 0.6f));
        for (int k = 0; k < stack && y < house.ground_height + 3.05 * double(house.upper.size()) - 1.6; ++k) {
            const size_t which = size_t(next_tall_++) % tall_.size();
            put(path, "sign", "building", tall_[which], wall_frame * translate({at_end, y, 0}));
            y += 1.85 + 0.45 * double(which % 3);
        }
        if (chance(0, 1) < 0.4f)
            put(path, "neon", "building", neon_[size_t(next_neon_++) % neon_.size()],
                wall_frame * translate({0.5 * house.width, house.ground_height + 0.15, 0.05}));
        for (size_t k = 0; k < house.upper.size(); ++k)
            if (house.upper[k] != 'r' && chance(0, 1) < 0.8f)
                put(path, "air_conditioner", "building", cooler_,
                    wall_frame * translate({0.5 * house.width - 0.4 + chance(-0.2f, 0.2f),
                                            house.ground_height + 3.05 * double(k) + 0.1, 0}));
        if (chance(0, 1) < 0.7f)
            put(path, "meter", "building", meter_, wall_frame * translate({house.width - 0.35, 1.9, 0.01}));
    }

    const ArcadePlan& plan_;
    Street& street_;
    Palette& palette_;
    std::map<char, std::vector<int>> houses_;
    std::vector<std::vector<int>> tall_, wide_, castor_, neon_, vending_;
    std::vector<int> list_, cooler_, meter_, lantern_;
    int count_ = 0, next_tall_ = 0, next_wide_ = 3, next_castor_ = 0, next_neon_ = 0, next_vending_ = 0;
};

}  // namespace

Scene build_arcade(const ArcadePlan& plan) {
    Street street;
    street.scene.name = plan.name;
    Palette palette(street);
    add_ground(plan, street, palette);
    Row row(plan, street, palette);
    row.add("left", plan.left, left_wall(-plan.wall, plan.near_end), true);
    row.add("right", plan.right, right_wall(plan.wall, plan.far_end), true);
    row.add("far", plan.far, end_wall(-22, plan.far_end - 7), true);
    row.add("behind", plan.behind, facing_away(22, plan.near_end + 7), false);
    // Across the ends of the crossing streets, for who turns there.
    const std::string some = plan.far.substr(0, 4);
    for (const auto& [name, z] : {std::pair{"far", plan.far_end - 3.5f}, {"near", plan.near_end + 3.5f}}) {
        row.add(std::string("west_") + name, some, left_wall(-31, z + 11), false);
        row.add(std::string("east_") + name, some, right_wall(31, z - 11), false);
    }
    add_poles(plan, street, palette);
    add_things(plan, street, palette);
    street.scene.cameras = plan.cameras;
    check(street.scene, plan.name);
    return std::move(street.scene);
}

}  // namespace pluvia
