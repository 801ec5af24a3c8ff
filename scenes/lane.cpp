// The plan of the lane: which houses stand where, the ground and the cameras. What stands before the houses is placed
// in lane_furniture.cpp. The lane runs from z = 6 to z = -21.3 and is 3 m wide (x from -1.5 to 1.5); the view ends at a
// house across it, where the lane turns right.
#include "scenes/lane.h"
#include "scenes/builders.h"

#include <utility>

namespace pluvia {
namespace lane {
namespace {

void add_houses(Street& street, const Finishes& f) {
    add_house(street, f,
              {.name = "house_left_1",
               .scene_from_facade = left_wall(-1.5, 5),
               .width = 6,
               .ground = "BBBBBB",
               .upper = "bbpbpb",
               .boards = f.red_wood,
               .posts = f.brown_wood,
               .walls = f.ochre_plaster,
               .eave_height = 5.4f,
               .lower_roof_depth = 0,
               .downpipes = {5.9f}});
    add_garden_wall(street, f, "garden_wall", 3.2f, 2.15f, left_wall(-1.48, -1));
    add_house(street, f,
              {.name = "house_left_back",
               .scene_from_facade = left_wall(-4.6, 0.5),
               .width = 4.7f,
               .ground = "BBBB",
               .upper = "pvvp",
               .boards = f.grey_wood,
               .posts = f.dark_wood,
               .walls = f.ochre_plaster,
               .lower_roof_depth = 0});
    add_house(street, f,
              {.name = "house_left_2",
               .scene_from_facade = left_wall(-1.5, -4.2),
               .width = 5.4f,
               .ground = "bklDlb",
               .upper = "pwwspp",
               .boards = f.dark_wood,
               .posts = f.dark_wood,
               .walls = f.ochre_plaster,
               .eave_height = 5.35f,
               .downpipes = {0.15f}});
    add_house(street, f,
              {.name = "house_left_3",
               .scene_from_facade = left_wall(-1.56, -9.6),
               .width = 6.3f,
               .ground = "sslsgds",
               .upper = "pmmpmmp",
               .boards = f.grey_wood,
               .posts = f.brown_wood,
               .walls = f.white_plaster,
               .eave_height = 5.3f,
               .lower_roof_depth = 0.65f,
               .downpipes = {6.15f}});
    add_house(street, f,
              {.name = "house_left_4",
               .scene_from_facade = left_wall(-1.44, -15.9),
               .width = 5.4f,
               .ground = "bldllb",
               .upper = "pspwwp",
               .boards = f.red_wood,
               .posts = f.dark_wood,
               .walls = f.ochre_plaster,
               .eave_height = 5.1f});
    add_house(street, f,
              {.name = "house_right_1",
               .scene_from_facade = right_wall(1.5, -1),
               .width = 6.3f,
               .ground = "bbkbbBB",
               .upper = "pvpppvp",
               .boards = f.red_wood,
               .posts = f.dark_wood,
               .walls = f.ochre_plaster,
               .eave_height = 5.15f,
               .lower_roof_depth = 0.7f,
               .downpipes = {0.12f}});
    add_house(street, f,
              {.name = "house_right_2",
               .scene_from_facade = right_wall(1.54, -7.3),
               .width = 6.3f,
               .ground = "bdlbggb",
               .upper = "pvpwpvp",
               .boards = f.brown_wood,
               .posts = f.dark_wood,
               .walls = f.ochre_plaster,
               .eave_height = 4.85f,
               .downpipes = {3.5f}});
    add_house(street, f,
              {.name = "house_right_3",
               .scene_from_facade = right_wall(1.46, -12.7),
               .width = 5.4f,
               .ground = "blDlkb",
               .upper = "pwsswp",
               .boards = f.dark_wood,
               .posts = f.brown_wood,
               .walls = f.white_plaster,
               .eave_height = 5.2f,
               .lower_roof_depth = 0.7f,
               .downpipes = {5.25f}});
    add_house(street, f,
              {.name = "house_right_4",
               .scene_from_facade = right_wall(1.52, -18.1),
               .width = 5.4f,
               .ground = "slsdsb",
               .upper = "pmmpmm",
               .boards = f.grey_wood,
               .posts = f.dark_wood,
               .walls = f.white_plaster,
               .eave_height = 4.9f,
               .downpipes = {0.15f}});
    add_house(street, f,
              {.name = "house_end",
               .scene_from_facade = end_wall(-1.9, -21.4),
               .width = 8.8f,
               .ground = "slsdlbklbb",
               .upper = "pmmpwwpmmp",
               .boards = f.brown_wood,
               .posts = f.dark_wood,
               .walls = f.white_plaster,
               .eave_height = 4.7f,
               .lower_roof_depth = 0.6f,
               .downpipes = {1.5f}});
    add_house(street, f,
              {.name = "house_corner",
               .scene_from_facade = right_wall(6.9, -21.6),
               .width = 3.7f,
               .ground = "sdls",
               .upper = "pwwp",
               .boards = f.grey_wood,
               .posts = f.dark_wood,
               .walls = f.ochre_plaster});
    add_house(street, f,
              {.name = "house_behind",
               .scene_from_facade = facing_away(4, 10),
               .width = 8,
               .ground = "ssgdss",
               .upper = "pwppwp",
               .boards = f.grey_wood,
               .posts = f.dark_wood,
               .walls = f.white_plaster,
               .lower_roof_depth = 0});
}

void add_ground(Street& street, const Finishes& f) {
    add_paving(street, f, {.name = "paving", .half_width = 1.5f, .near = 9, .far = -21.35f, .scene_from_paving = {}});
    add_paving(street, f,
               {.name = "side_paving",
                .half_width = 1.55f,
                .near = 0,
                .far = -5.3f,
                .scene_from_paving = translate({1.5, 0.001, -19.75}) * rotate_y(-std::numbers::pi / 2)});
    Assembly block;  // bare ground under houses and gardens
    const Vec3 a = {-30, -0.13f, 40}, b = {30, -0.13f, 40}, c = {30, -0.13f, -50}, d = {-30, -0.13f, -50};
    add_quad(block[f.soil], {a, b, c, d}, {0, 0}, {60, -90});
    place_once(street, "lane/block", "terrain", block);
}

void add_cameras(Scene& scene) {
    // Slow walks of 12 s: the street must pass the lens as it does for a person.
    scene.cameras = {look_at("front", {0.3, 1.6, 1.6}, {-0.15, 2.0, -13}, 35, {-0.03, 0, -1.2}, 12),
                     look_at("mid", {0.15, 1.35, -2.6}, {-0.05, 1.95, -14}, 35, {0, 0, -1.2}, 12),
                     look_at("side", {1.05, 1.6, -3.6}, {-1.5, 1.75, -9.3}, 30, {0, 0, -0.8}, 12),
                     look_at("low", {-0.15, 0.4, -4.2}, {0.15, 0.8, -12}, 35, {0.02, 0, -0.8}, 12)};
}

}  // namespace
}  // namespace lane

Scene build_lane() {
    Street street;
    street.scene.name = "lane";
    const lane::Finishes finishes = lane::add_finishes(street);
    lane::add_ground(street, finishes);
    lane::add_houses(street, finishes);
    lane::add_furniture(street, finishes);
    lane::add_cameras(street.scene);
    check(street.scene, "lane");
    return std::move(street.scene);
}

}  // namespace pluvia
