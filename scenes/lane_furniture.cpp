// Where the lane's lamps, signs, plants and other things are. Their shapes are in lane_lamps.cpp, lane_signs.cpp,
// lane_plants.cpp and lane_props.cpp, the houses they belong to in lane.cpp.
#include "scenes/lane.h"
#include "scenes/utilities.h"

#include "renderer/core/units.h"

#include <numbers>

namespace pluvia::lane {
namespace {

/// A thing on the left (right) wall, its front towards the lane.
Transform on_left(double y, double z, double x = -1.48) {
    return translate({x, y, z}) * rotate_y(std::numbers::pi / 2);
}
Transform on_right(double y, double z, double x = 1.48) {
    return translate({x, y, z}) * rotate_y(-std::numbers::pi / 2);
}
/// A thing on the ground, turned by degrees.
Transform standing(double x, double z, double degrees = 0) {
    return translate({x, -0.03, z}) * rotate_y(radians_from_degrees(degrees));
}

void add_lamps(Street& street, const Finishes& f) {
    const auto globe = add_meshes(street, "globe_lamp", globe_lamp(f));
    place(street, "lane/globe_lamp_1", "building", globe, on_right(2.35, -6.9));
    place(street, "lane/globe_lamp_2", "building", globe, on_right(2.3, -9.4));
    place(street, "lane/globe_lamp_3", "building", globe, on_left(2.3, -15.0, -1.53));
    place(street, "lane/globe_lamp_4", "building", globe, translate({4.4, 2.4, -21.35}));

    place_once(street, "lane/wall_lantern", "building", wall_lantern(f), on_left(3.95, -10.3, -1.54));

    const auto white = add_meshes(street, "white_lantern", paper_lantern(f, false));
    const auto red = add_meshes(street, "red_lantern", paper_lantern(f, true));
    const double left_eave = -0.98, right_eave = 0.98, hook = 2.74;
    place(street, "lane/white_lantern_1", "building", white, translate({left_eave, hook, -6.75}) * rotate_y(0.3));
    place(street, "lane/white_lantern_2", "building", white, translate({left_eave, hook, -8.15}) * rotate_y(0.3));
    place(street, "lane/red_lantern_1", "building", red, translate({right_eave, hook, -14.4}) * rotate_y(-0.4));
    place(street, "lane/red_lantern_2", "building", red, translate({right_eave, hook, -15.3}) * rotate_y(0.1));
    place(street, "lane/red_lantern_3", "building", red, translate({right_eave, hook, -16.2}) * rotate_y(0.4));
    place(street, "lane/white_lantern_3", "building", white, translate({left_eave + 0.05, hook, -18.2}));

    const auto andon = add_meshes(street, "floor_lantern", floor_lantern(f));
    place(street, "lane/floor_lantern_1", "static", andon, standing(-1.2, -16.6, 10));
    place(street, "lane/floor_lantern_2", "static", andon, standing(-1.05, -7.95, -12));
}

void add_signs(Street& street, const Finishes& f) {
    place_once(street, "lane/signboard", "building", hanging_board(f), on_left(4.87, -10.3, -1.54));
    place_once(street, "lane/standing_sign", "static", standing_sign(f, false), standing(-0.72, -7.6, 14));
    place_once(street, "lane/standing_sign_tall_1", "static", standing_sign(f, true), standing(0.98, -11.0, -16));
    place_once(street, "lane/standing_sign_tall_2", "static", standing_sign(f, true), standing(-0.95, -13.4, 20));
    place_once(street, "lane/box_sign", "building", box_sign(f), on_right(2.62, -13.4));

    Assembly plates;
    const auto hang = [&](int finish, const Transform& place_at, float half_width, float height) {
        Shape sheet;
        add_quad(sheet,
                 {Vec3{-half_width, 0, 0.012f},
                  {half_width, 0, 0.012f},
                  {half_width, height, 0.012f},
                  {-half_width, height, 0.012f}},
                 {0, 1}, {1, 0});
        append(plates[finish], sheet, place_at);
        Shape back;
        add_box(back, {-half_width, 0, -0.03f}, {half_width, height, 0.011f});
        append(plates[f.brown_wood], back, place_at);
    };
    hang(f.nameplate, on_right(1.45, -5.62), 0.055f, 0.17f);
    hang(f.poster, translate({-0.62, 1.35, -21.38}), 0.19f, 0.28f);
    hang(f.poster, on_left(1.25, -9.9, -1.53), 0.19f, 0.28f);
    hang(f.signboard, on_left(1.05, -15.2, -1.53), 0.13f, 0.95f);
    place_once(street, "lane/plates", "building", plates);
}

/// A plant in a pot, as one thing.
std::vector<int> potted(Street& street, const Finishes& f, const std::string& name, Assembly plant, int pot_finish,
                        float radius, float height) {
    Assembly a = pot(f, pot_finish, radius, height);
    for (const auto& [finish, shape] : plant.shapes) append(a[finish], shape, translate({0, 0.9 * height, 0}));
    return add_meshes(street, name, a);
}

void add_plants(Street& street, const Finishes& f) {
    const auto leafy = potted(street, f, "potted_bush", bush(f, 1, 0.75f, 260, false), f.iron, 0.15f, 0.27f);
    const auto round = potted(street, f, "white_pot_bush", bush(f, 2, 1.25f, 420, true), f.porcelain, 0.22f, 0.42f);
    const auto small = potted(street, f, "small_pot", bush(f, 3, 0.34f, 130, false), f.terracotta, 0.1f, 0.17f);
    const auto areca = potted(street, f, "potted_palm", palm(f, 4, 1.25f), f.terracotta, 0.17f, 0.3f);
    const auto fern = potted(street, f, "potted_fern", palm(f, 5, 0.5f), f.porcelain, 0.12f, 0.2f);
    place(street, "lane/plant_1", "vegetation", leafy, standing(-1.18, -4.75, 40));
    place(street, "lane/plant_2", "vegetation", small, standing(-1.22, -5.3, 0));
    place(street, "lane/plant_3", "vegetation", fern, standing(-1.15, -5.75, 70));
    place(street, "lane/plant_4", "vegetation", areca, standing(-1.12, -9.2, 0));
    place(street, "lane/plant_5", "vegetation", round, standing(1.1, -11.75, 0));
    place(street, "lane/plant_6", "vegetation", small, standing(-0.3, -21.0, 120));
    place(street, "lane/plant_7", "vegetation", leafy, standing(0.55, -20.95, 200));
    place(street, "lane/plant_8", "vegetation", small, standing(1.24, -8.5, 60));
    place(street, "lane/plant_9", "vegetation", fern, standing(1.2, -8.1, 10));
    place(street, "lane/plant_10", "vegetation", small, standing(1.25, -2.6, 200));
    place(street, "lane/plant_11", "vegetation", areca, standing(-1.1, -20.3, 130));
    place(street, "lane/plant_12", "vegetation", fern, standing(-1.2, -16.05, 20));
    place(street, "lane/plant_13", "vegetation", round, standing(-1.15, -12.2, 140));

    const auto maple = add_meshes(street, "tree", tree(f, 6, 3.7f));
    place(street, "lane/tree_1", "vegetation", maple, translate({-2.5, -0.1, -3.1}) * rotate_y(1.0));
    place(street, "lane/tree_2", "vegetation", maple,
          translate({2.2, -0.1, -18.5}) * rotate_y(2.2) * scale({0.9, 1.1, 0.9}));
}

void add_props(Street& street, const Finishes& f) {
    Palette palette(street);
    place_once(street, "lane/bamboo_fence", "fence", bamboo_fence(f, 3.6f), left_wall(-1.45, 0.9));
    place_once(street, "lane/bamboo_fence_far", "fence", bamboo_fence(f, 1.8f), left_wall(-1.42, -19.4));
    const auto cooler = add_meshes(street, "air_conditioner", air_conditioner(palette));
    place(street, "lane/air_conditioner_1", "building", cooler, left_wall(-1.53, -13.15) * translate({0, 3.5, 0}));
    place(street, "lane/air_conditioner_2", "building", cooler, right_wall(1.5, -5.3) * translate({0, 3.45, 0}));
    const auto meter = add_meshes(street, "meter_box", meter_box(palette));
    place(street, "lane/meter_box_1", "building", meter, on_left(1.95, -11.0, -1.54));
    place(street, "lane/meter_box_2", "building", meter, on_right(1.9, -3.3));
    place_once(street, "lane/bench", "static", bench(f), on_right(-0.03, -10.1, 1.46));
    place_once(street, "lane/umbrella_stand", "static", umbrella_stand(f), standing(-1.2, -8.75));
    place_once(street, "lane/crates", "static", crates(f), standing(1.18, -17.0, 96));
    const auto pail = add_meshes(street, "bucket", bucket(f));
    place(street, "lane/bucket_1", "static", pail, standing(1.22, -7.55, 15));
    place(street, "lane/bucket_2", "static", pail, standing(-1.2, -11.35, 50));

    place_once(street, "lane/utility_pole", "pole", utility_pole(palette), translate({1.28, -0.05, -18.35}));
    Assembly cables;
    for (const float x : {-0.65f, -0.3f, 0.3f, 0.65f}) {
        add_cable(cables, palette, {1.28f + x, 7.52f, -18.21f}, {0.4f + x, 7.4f, 10}, 0.55f);
        add_cable(cables, palette, {1.28f + x, 6.82f, -18.21f}, {0.1f + 2 * x, 6.3f, -24}, 0.15f);
    }
    add_cable(cables, palette, {1.2f, 6.2f, -18.2f}, {-1.3f, 4.6f, -9.8f}, 0.35f, 0.011f);
    add_cable(cables, palette, {1.2f, 6.1f, -18.2f}, {-1.3f, 4.9f, -16.4f}, 0.15f);
    add_cable(cables, palette, {1.2f, 6.2f, -18.2f}, {1.3f, 4.6f, -7.0f}, 0.3f, 0.011f);
    add_cable(cables, palette, {1.3f, 4.6f, -7.0f}, {-1.3f, 5.0f, -4.4f}, 0.25f);
    add_cable(cables, palette, {1.2f, 5.9f, -18.2f}, {-1.0f, 4.4f, -21.2f}, 0.12f);
    // A water pipe along the near wall and up, white where the paint holds.
    const std::vector<Vec3> pipe = {{-1.4f, 1.92f, -0.1f}, {-1.4f, 1.92f, -4.05f}, {-1.4f, 0.05f, -4.05f}};
    add_tube(cables[f.painted_metal], rounded(pipe, 0.12f, 5), 0.026f, 10);
    place_once(street, "lane/cables", "static", cables);
}

}  // namespace

void add_furniture(Street& street, const Finishes& f) {
    add_lamps(street, f);
    add_signs(street, f);
    add_plants(street, f);
    add_props(street, f);
}

}  // namespace pluvia::lane
