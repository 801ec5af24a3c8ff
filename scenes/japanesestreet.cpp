// The plan of the Japanese shopping street: houses, paving, signs and the cameras. The street runs from z = 24 to z =
// -52 between walls 7.8 m apart; houses across a lane close the view at both ends.
#include "scenes/arcade_things.h"
#include "scenes/builders.h"
#include "scenes/japanesestreet_signs.h"
#include "scenes/lit_signs.h"
#include "scenes/road.h"
#include "scenes/street_things.h"
#include "scenes/tenement.h"
#include "scenes/utilities.h"

#include "renderer/core/units.h"

#include <map>
#include <utility>

namespace pluvia {
namespace {

const std::string name = "japanesestreet";
constexpr float wall = 3.9f, kerb = 3.0f, near_end = 24, far_end = -52;

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
    Row(Street& street, Palette& palette) : street_(street), palette_(palette) {
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
            if (!houses_.count(letters[i])) {
                house.name = std::string("tenement_") + letters[i];
                houses_[letters[i]] = add_meshes(street_, house.name, tenement(palette_, house));
            }
            const std::string path = name + "/" + row + "_" + std::to_string(i);
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
        const int stack = 1 + int(chance(0, 2.6f));
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

    Street& street_;
    Palette& palette_;
    std::map<char, std::vector<int>> houses_;
    std::vector<std::vector<int>> tall_, wide_, castor_, neon_, vending_;
    std::vector<int> list_, cooler_, meter_, lantern_;
    int count_ = 0, next_tall_ = 0, next_wide_ = 3, next_castor_ = 0, next_neon_ = 0, next_vending_ = 0;
};

void add_ground(Street& street, Palette& palette) {
    // Fields of pavers, turned in turn so that their pattern of shades does not show.
    std::vector<std::vector<int>> fields, sides;
    for (uint64_t i = 0; i < 3; ++i) {
        fields.push_back(
            add_meshes(street, "pavers_" + std::to_string(i), paver_field(palette, "paver", 2, 0.2f, 0.1f, i)));
        sides.push_back(add_meshes(street, "side_pavers_" + std::to_string(i),
                                   paver_field(palette, "red_paver", 0.9f, 0.3f, 0.15f, i + 7)));
    }
    int index = 0;
    for (double z = near_end - 1; z > far_end - 8; z -= 2)
        for (const double x : {-2.0, 0.0, 2.0}) {
            const double fall = -0.012 * std::abs(x);
            place(street, name + "/paving_" + std::to_string(index), "road", fields[size_t(index * 5 + index / 7) % 3],
                  translate({x, fall, z}) * rotate_y(pi * (index % 2)));
            ++index;
        }
    index = 0;
    for (double z = near_end - 0.45; z > far_end; z -= 0.9)
        for (const double side : {-1.0, 1.0}) {
            place(street, name + "/side_paving_" + std::to_string(index), "sidewalk",
                  sides[size_t(index * 5 + index / 4) % 3],
                  translate({side * (kerb + 0.17 + 0.45), 0.05, z}) * rotate_y(pi * (index % 2)));
            ++index;
        }
    Assembly edges;
    Chance chance{0x3e};
    constexpr Transform lying = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
    for (const float side : {-1.0f, 1.0f})
        for (float z = near_end; z > far_end; z -= 0.6f) {
            Shape stone;
            add_box(stone, {-0.08f, -0.295f, -0.2f}, {0.08f, 0.295f, 0}, chance.tint(0.25f), 0.012f);
            append(edges[palette("kerb_stone")], stone, translate({side * (kerb + 0.085), 0.052, z - 0.3}) * lying);
            if (int(z / 0.6f) % 9 == 0) {  // grate
                Shape grate;
                for (float t = -0.27f; t < 0.27f; t += 0.045f)
                    add_block(grate, {-0.12f, -0.03f, t}, {0.12f, 0, t + 0.02f});
                append(edges[palette("cast_iron")], grate, translate({side * (kerb - 0.13), -0.028, z - 0.3}));
            }
        }
    place_once(street, name + "/kerbs", "sidewalk", edges);
    const auto cover = add_meshes(street, "manhole", manhole(palette));
    for (int i = 0; i < 6; ++i)
        place(street, name + "/manhole_" + std::to_string(i), "road", cover,
              translate({i % 2 == 0 ? 0.9 : -1.3, -0.004, 13 - 11.3 * i}));
    Assembly block;
    add_facet(block[palette("soil")],
              {Vec3{-60, -0.25f, 70}, {60, -0.25f, 70}, {60, -0.25f, -110}, {-60, -0.25f, -110}});
    for (const auto& [z0, z1] : {std::pair{far_end + 0.0f, far_end - 7.0f}, std::pair{near_end + 7.0f, near_end}})
        for (float x = -30; x < 30; x += 3)
            add_facet(block[palette("asphalt")],
                      {Vec3{x, -0.04f, z0}, {x + 3, -0.04f, z0}, {x + 3, -0.04f, z1}, {x, -0.04f, z1}},
                      {Rgb(0.8f), {}});
    place_once(street, name + "/block", "road", block);
}

void add_poles(Street& street, Palette& palette) {
    const auto pole = add_meshes(street, "utility_pole", utility_pole(palette));
    const auto lamp = add_meshes(street, "twin_lantern", twin_lantern(palette));
    int index = 0;
    std::vector<Vec3> right, left;
    for (float z = 16; z > far_end; z -= 15, ++index) {
        const float side = index % 2 == 0 ? 1.0f : -1.0f;
        place(street, name + "/utility_pole_" + std::to_string(index), "pole", pole, translate({side * 3.25, 0, z}));
        (side > 0 ? right : left).push_back({side * 3.25f, 0, z});
    }
    index = 0;
    for (double z = 19; z > far_end; z -= 8.5, ++index) {
        const bool on_left = index % 2 == 0;
        place(street, name + "/twin_lantern_" + std::to_string(index), "pole", lamp,
              translate({on_left ? -3.35 : 3.35, 0.05, z}) * rotate_y(on_left ? pi / 2 : -pi / 2));
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
            add_cable(cables, palette, right[i] + Vec3(0, 6.1f, 0), {-wall, 5.2f + 0.1f * dz, right[i].z + dz}, 0.25f);
            add_cable(cables, palette, left[i] + Vec3(0, 6.2f, 0), {wall, 5.0f - 0.1f * dz, left[i].z + dz}, 0.3f);
        }
    }
    place_once(street, name + "/cables", "static", cables);
}

void add_things(Street& street, Palette& palette) {
    int count = 0;
    const auto put = [&](const std::string& what, const std::vector<int>& meshes, const Transform& at) {
        place(street, name + "/" + what + "_" + std::to_string(count++), "static", meshes, at);
    };
    const auto cone = add_meshes(street, "traffic_cone", traffic_cone(palette));
    for (const auto& [x, z] : {std::pair{3.3, 2.2}, {3.0, 1.2}, {-3.2, -13.0}, {-3.1, -14.1}, {3.2, -33.0}})
        put("cone", cone, translate({x, 0.0, z}));
    const auto bag = add_meshes(street, "rubbish_bag", rubbish_bag(palette, 9));
    for (int i = 0; i < 6; ++i)
        put("rubbish_bag", bag,
            translate({-3.5 + 0.18 * (i % 2), 0.05, 5.6 - 0.42 * i}) * rotate_y(1.7 * i) *
                scale({0.9, 0.75 + 0.1 * (i % 3), 0.9}));
    for (uint64_t i = 0; i < 2; ++i) {
        const auto tub = add_meshes(street, "planter_" + std::to_string(i), planter(palette, i + 5));
        put("planter", tub, translate({3.45, 0.05, i == 0 ? 10.4 : -19.0}) * scale({0.8, 0.8, 0.8}));
        put("planter", tub, translate({-3.45, 0.05, i == 0 ? -4.0 : -27.2}) * scale({0.8, 0.9, 0.8}));
    }
    const auto can = add_meshes(street, "trash_can", trash_can(palette));
    for (const auto& [x, z] : {std::pair{3.55, -8.2}, {-3.55, -21.5}, {3.55, 6.9}})
        put("trash_can", can, translate({x, 0.05, z}));
}

void add_cameras(Scene& scene) {
    constexpr float seconds = 12;
    scene.cameras = {look_at("camera1", {0.1, 1.6, 19.5}, {-0.1, 2.5, -20}, 35, {0, 0, -2.4}, seconds),
                     look_at("camera2", {1.9, 1.6, 12}, {-3.9, 2.9, 1.5}, 30, {0, 0, -1.8}, seconds),
                     look_at("camera3", {0.5, 1.6, -44}, {0, 2.6, 10}, 35, {0, 0, 2.4}, seconds),
                     look_at("camera4", {-1.9, 1.6, 3}, {3.9, 2.9, -7.5}, 30, {0, 0, -1.8}, seconds),
                     look_at("camera5", {-0.3, 1.6, -9}, {0.3, 2.9, -50}, 40, {0, 0, -2.4}, seconds),
                     look_at("camera6", {1.9, 1.6, -19}, {-3.9, 2.8, -29.5}, 30, {0, 0, -1.8}, seconds),
                     look_at("camera7", {-1.1, 0.8, 14}, {0.6, 1.8, -14}, 35, {0, 0, -1.6}, seconds),
                     look_at("camera8", {0.9, 2.5, 2}, {-0.4, 2.6, -44}, 50, {0, 0, -3}, seconds),
                     look_at("camera9", {-0.7, 1.6, -28}, {0.3, 2.5, 16}, 35, {0, 0, 2.4}, seconds),
                     look_at("camera10", {1.0, 1.6, -2}, {0.2, 2.7, -44}, 35, {0, 0, -2.4}, seconds)};
}

}  // namespace

Scene build_japanesestreet() {
    Street street;
    street.scene.name = name;
    Palette palette(street);
    add_ground(street, palette);
    Row row(street, palette);
    row.add("left", "ACBEDFGHCAEBD", left_wall(-wall, 24), true);
    row.add("right", "FBEGHADCFBGEH", right_wall(wall, -52), true);
    row.add("far", "CAFECAC", end_wall(-22, far_end - 7), true);
    row.add("behind", "AFCEAFC", facing_away(22, near_end + 7), false);
    add_poles(street, palette);
    add_things(street, palette);
    add_cameras(street.scene);
    check(street.scene, name);
    return std::move(street.scene);
}

}  // namespace pluvia
