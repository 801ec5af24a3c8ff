#include "scenes/traffic_rooms.h"

#include "renderer/core/error.h"

#include <functional>
#include <map>

namespace pluvia {
namespace {

/// Out along -z at x = out, back at x = back, and round both ends within a box from half_width to each side.
struct Circuit {
    double out, back;
    double near, far;                   // z where the lanes end
    double near_end, far_end;           // z of the boxes' ends
    double half_width;                  // of the boxes
    double height, end_height = -0.02;  // of lanes and boxes
};

std::vector<Vec3d> corners(const Circuit& c) {
    const double middle = (c.out + c.back) / 2, side = c.out > c.back ? c.half_width : -c.half_width, shift = 3;
    const double a = middle + side, b = middle - side, y = c.height, end = c.end_height;
    return {{c.out, y, c.near},       {c.out, y, c.far},       {a, end, c.far - shift}, {a, end, c.far_end},
            {b, end, c.far_end},      {b, end, c.far - shift}, {c.back, y, c.far},      {c.back, y, c.near},
            {b, end, c.near + shift}, {b, end, c.near_end},    {a, end, c.near_end},    {a, end, c.near + shift}};
}

/// Along a pavement at x and back behind the houses, where nobody sees it: round the block. down: along -z at x.
Track block(double x, double height, double near, double far, bool down, int count) {
    constexpr double kerb = 0.9, behind = 18;
    const double hidden = x > 0 ? x + behind : x - behind, low = -0.02;
    std::vector<Vec3d> way = {
        {x, height, near - kerb}, {x, height, far + kerb}, {x, low, far + 0.4}, {x, low, far},
        {hidden, low, far},       {hidden, low, near},     {x, low, near},      {x, low, near - 0.4}};
    if (!down) way = {way.rbegin(), way.rend()};
    return {way, {.radius = 0.4, .speed = x > 0 ? 1.3 : 1.2, .acceleration = 5}, count};
}

Room city(double out, double back, std::vector<double> walks, double pavement, bool small_cars) {
    Room room;
    room.cars = {corners({.out = out,
                          .back = back,
                          .near = 39.5,
                          .far = -69.5,
                          .near_end = 48,
                          .far_end = -80.5,
                          .half_width = 3.5,
                          .height = 0.05}),
                 {.radius = 3.5, .speed = 6, .acceleration = 1.8},
                 11};
    room.small_cars = small_cars;
    for (size_t i = 0; i < walks.size(); ++i)
        for (const double side : {-1.0, 1.0})
            room.walks.push_back(block(side * walks[i], pavement, 40.6, -72.8, (side > 0) == (i == 0), 12));
    return room;
}

/// A street for those who walk, through which a camera goes as a bicycle does.
Room arcade(double walk, double lane, double half_width, double speed) {
    Room room;
    room.camera = {corners({.out = lane,
                            .back = -lane,
                            .near = 22,
                            .far = -50,
                            .near_end = 28,
                            .far_end = -56,
                            .half_width = half_width,
                            .height = 0}),
                   {.radius = half_width, .speed = speed, .acceleration = 1}};
    for (const double side : {-1.0, 1.0}) room.walks.push_back(block(side * walk, 0.01, 24.6, -52.6, side > 0, 9));
    return room;
}

Room stationstreet() {
    Room room = arcade(3.95, 1.3, 2.7, 5);
    room.cars = Track{corners({.out = -1.3,  // on the left, as in Japan
                               .back = 1.3,
                               .near = 20.5,
                               .far = -49,
                               .near_end = 29.5,
                               .far_end = -57.5,
                               .half_width = 2.7,
                               .height = 0}),
                      {.radius = 2.7, .speed = 4, .acceleration = 1.5},
                      7};
    room.small_cars = true;
    return room;
}

/// All in one file, since the lane is no wider: people, and a camera among them.
Room lane() {
    Room room;
    const Circuit circuit = {.out = 0.6,
                             .back = -0.35,
                             .near = 4,
                             .far = -18,
                             .near_end = 8,
                             .far_end = -20.2,
                             .half_width = 0.475,
                             .height = 0.01,
                             .end_height = 0.01};
    room.camera = {corners(circuit), {.radius = 0.45, .speed = 1, .acceleration = 2}};
    room.walks = {{corners(circuit), room.camera.route, 4}};
    return room;
}

}  // namespace

Room traffic_room(const std::string& street) {
    // Lanes between parked cars, walks between trees at the kerb and what stands along the walls: see city_parts.cpp.
    static const std::map<std::string, std::function<Room()>> rooms = {
        {"lane", lane},
        {"citystreet", [] { return city(1.3, -1.3, {6.35}, 0.17, false); }},
        {"avenue",
         [] {
             return city(1.6, -1.6, {9.3, 10.5}, 0.17, false);
         }},
        {"terrace", [] { return city(1.6, -0.15, {5.05}, 0.17, true); }},
        {"brickyard", [] { return city(0.92, -0.92, {5.35}, 0.14, true); }},
        {"japanesestreet", [] { return arcade(2.1, 0.7, 1.5, 2.5); }},
        {"backstreet", [] { return arcade(1.0, 0.15, 0.7, 2); }},
        {"stationstreet", stationstreet},
    };
    const auto found = rooms.find(street);
    if (found == rooms.end())
        throw usage_error("traffic", "has no room in the scene \"" + street + "\" (expected one of pluvia scenes)");
    return found->second();
}

}  // namespace pluvia
