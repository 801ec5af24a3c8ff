// The plans of the city streets.
#include "scenes/builders.h"
#include "scenes/city.h"

namespace pluvia {
namespace {

constexpr float seconds = 12;  // that cameras walk

CarShape taxi() {
    CarShape shape = saloon();
    shape.taxi_sign = true;
    return shape;
}

/// The views of a street whose walls are at x = -wall and wall.
std::vector<Camera> city_cameras(double wall) {
    return {look_at("front", {0.25, 1.75, 22}, {0, 2.7, -30}, 35, {0, 0, -3}, seconds),
            look_at("back", {-0.8, 1.75, -20}, {-0.2, 2.6, 30}, 35, {0, 0, 3}, seconds),
            look_at("sideleft", {0.42 * wall, 1.7, 21}, {-wall, 3.3, 7}, 30, {0, 0, -2}, seconds),
            look_at("sideright", {-0.42 * wall, 1.7, 8}, {wall, 3.3, -6}, 30, {0, 0, -2}, seconds)};
}

}  // namespace

Scene build_citystreet() {
    return build_city({.name = "citystreet",
                       .left = "DBCAFEHIGdbJe",
                       .right = "ejGhDaFcBIAbE",
                       .cars = {{"car_silver", saloon(), true, -6.5},
                                {"car_red", hatchback(), true, -13.2},
                                {"car_black", estate(), true, -26},
                                {"car_blue", saloon(), true, -38.5},
                                {"car_yellow", taxi(), false, -30.5},
                                {"car_white", hatchback(), false, -36.8},
                                {"car_green", estate(), false, -44.5},
                                {"car_black", saloon(), false, -57},
                                {"car_silver", hatchback(), true, -52},
                                {"car_blue", hatchback(), false, 31},
                                {"car_red", saloon(), true, 36}},
                       .cameras = {look_at("front", {0.25, 1.75, 22}, {0, 2.7, -30}, 35, {0, 0, -3}, seconds),
                                   look_at("far", {-0.6, 2.6, 37}, {0.2, 3.2, -40}, 50, {0, 0, -4}, seconds),
                                   look_at("back", {-1.0, 1.75, -20}, {-0.2, 2.6, 30}, 35, {0, 0, 3}, seconds),
                                   look_at("sideleft", {3.9, 1.7, 21}, {-9, 3.3, 7}, 30, {0, 0, -2}, seconds),
                                   look_at("sideright", {-3.9, 1.7, 8}, {9, 3.3, -6}, 30, {0, 0, -2}, seconds),
                                   look_at("sideinner", {4.1, 1.75, 12.6}, {-9, 3.3, 10.9}, 30, {0, 0, -2}, seconds)}});
}

Scene build_avenue() {
    constexpr Road wide = {.half_width = 7.2f, .near = 40, .far = -72, .crown = 0.12f, .pavement = 6.2f, .seed = 5};
    return build_city({.name = "avenue",
                       .road = wide,
                       .left = "EFaCeEAFEaCH",
                       .right = "AECFaeEFaECH",
                       .far = "EFaCEFH",
                       .extra_storeys = 2,
                       .trees = 6,
                       .lamp_pitch = 17,
                       .cars = {{"car_yellow", taxi(), true, 9},
                                {"car_black", saloon(), true, -3},
                                {"car_white", estate(), true, -9.5},
                                {"car_silver", saloon(), true, -33},
                                {"car_blue", hatchback(), true, -46},
                                {"car_yellow", taxi(), false, -22},
                                {"car_red", estate(), false, -16},
                                {"car_silver", saloon(), false, -40},
                                {"car_black", estate(), false, -58}},
                       .cameras = city_cameras(wide.wall())});
}

Scene build_terrace() {
    constexpr Road narrow = {.half_width = 3.1f, .near = 40, .far = -72, .crown = 0.07f, .pavement = 3.9f, .seed = 7};
    return build_city({.name = "terrace",
                       .road = narrow,
                       .left = "BJhBbHJBjbHBBJh",
                       .right = "jBHbJBhBJHbBjHB",
                       .far = "BHJbjBhB",
                       .behind = "JBHbjB",
                       .trees = 10,
                       .lamp_pitch = 34,
                       .cars = {{"car_green", estate(), true, 2},
                                {"car_silver", hatchback(), true, -18},
                                {"car_red", hatchback(), true, -44}},
                       .cameras = city_cameras(narrow.wall())});
}

Scene build_brickyard() {
    constexpr Road plain = {
        .half_width = 3.9f, .near = 40, .far = -72, .crown = 0.06f, .kerb_height = 0.12f, .pavement = 2.6f, .seed = 11};
    return build_city({.name = "brickyard",
                       .road = plain,
                       .left = "DdHDGdhDdGDHd",
                       .right = "dDGhDdDHgDdDh",
                       .far = "DHdGDhD",
                       .behind = "dDHGdD",
                       .extra_storeys = 1,
                       .trees = 0,
                       .lamp_pitch = 28,
                       .cars = {{"car_black", estate(), false, -12}, {"car_white", estate(), true, -27}},
                       .cameras = city_cameras(plain.wall())});
}

}  // namespace pluvia
