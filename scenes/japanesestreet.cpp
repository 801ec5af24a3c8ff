// The plans of the Japanese shopping streets.
#include "scenes/arcade.h"
#include "scenes/assembly.h"
#include "scenes/builders.h"

namespace pluvia {
namespace {

constexpr float seconds = 12;  // that cameras walk

/// The views of a street whose walls are at x = -wall and wall.
std::vector<Camera> arcade_cameras(double wall) {
    return {look_at("front", {0.1, 1.6, 19}, {-0.1, 2.6, -20}, 35, {0, 0, -2.4}, seconds),
            look_at("back", {0.3, 1.6, -40}, {0, 2.6, 10}, 35, {0, 0, 2.4}, seconds),
            look_at("sideleft", {0.5 * wall, 1.6, 12}, {-wall, 2.9, 2}, 30, {0, 0, -1.8}, seconds),
            look_at("sideright", {-0.5 * wall, 1.6, -4}, {wall, 2.9, -14}, 30, {0, 0, -1.8}, seconds)};
}

}  // namespace

Scene build_japanesestreet() {
    return build_arcade({.name = "japanesestreet",
                         .left = "ACBEDFGHCAEBD",
                         .right = "FBEGHADCFBGEH",
                         .cameras = {look_at("camera1", {0.1, 1.6, 19.5}, {-0.1, 2.5, -20}, 35, {0, 0, -2.4}, seconds),
                                     look_at("camera2", {1.9, 1.6, 12}, {-3.9, 2.9, 1.5}, 30, {0, 0, -1.8}, seconds),
                                     look_at("camera3", {0.5, 1.6, -44}, {0, 2.6, 10}, 35, {0, 0, 2.4}, seconds),
                                     look_at("camera4", {-1.9, 1.6, 3}, {3.9, 2.9, -7.5}, 30, {0, 0, -1.8}, seconds),
                                     look_at("camera5", {-0.3, 1.6, -9}, {0.3, 2.9, -50}, 40, {0, 0, -2.4}, seconds),
                                     look_at("camera6", {1.9, 1.6, -19}, {-3.9, 2.8, -29.5}, 30, {0, 0, -1.8}, seconds),
                                     look_at("camera7", {-1.1, 0.8, 14}, {0.6, 1.8, -14}, 35, {0, 0, -1.6}, seconds),
                                     look_at("camera8", {0.9, 2.5, 2}, {-0.4, 2.6, -44}, 50, {0, 0, -3}, seconds),
                                     look_at("camera9", {-0.7, 1.6, -28}, {0.3, 2.5, 16}, 35, {0, 0, 2.4}, seconds),
                                     look_at("camera10", {1.0, 1.6, -2}, {0.2, 2.7, -44}, 35, {0, 0, -2.4}, seconds)}});
}

Scene build_backstreet() {
    constexpr float wall = 2.3f;
    return build_arcade({.name = "backstreet",
                         .wall = wall,
                         .kerb = 1.7f,
                         .left = "DBGDHBDGBDHBGD",
                         .right = "BDGHDBGDBHDGBD",
                         .far = "DBGDHBDGB",
                         .signs = 1.4f,
                         .lantern_pitch = 15,
                         .cameras = arcade_cameras(wall)});
}

Scene build_stationstreet() {
    constexpr float wall = 6.4f;
    return build_arcade({.name = "stationstreet",
                         .wall = wall,
                         .kerb = 4.6f,
                         .left = "ACFECAFHCFAE",
                         .right = "FCAHECFACEAF",
                         .extra_storeys = 2,
                         .signs = 3.2f,
                         .poles = false,
                         .cameras = arcade_cameras(wall)});
}

}  // namespace pluvia
