#include "scenes/traffic_rooms.h"

#include "renderer/core/error.h"

#include <functional>
#include <map>
#include <utility>

namespace pluvia {
namespace {

/// Out along -z at x = out, back at x = back, and round at both ends within boxes whose sides are at other x.
struct Circuit {
    double out, back;
    double near, far;          // z where the lanes end
    double near_end, far_end;  // z of the boxes' ends
    double box_out, box_back;  // x of their sides; who turns within a car's length swings out first
    double shift = 3;          // metres along z from a lane to a box
    double height = 0, end_height = -0.02;
};

std::vector<Vec3d> corners(const Circuit& c) {
    const double a = c.box_out, b = c.box_back, y = c.height, end = c.end_height;
    const double near = c.near + c.shift, far = c.far - c.shift;
    return {{c.out, y, c.near},  {c.out, y, c.far},    {a, end, far},        {a, end, c.far_end},
            {b, end, c.far_end}, {b, end, far},        {c.back, y, c.far},   {c.back, y, c.near},
            {b, end, near},      {b, end, c.near_end}, {a, end, c.near_end}, {a, end, near}};
}

constexpr double kerb = 0.9;  // metres from a pavement's end to the way along the crossing street

/// Along a pavement and back behind the houses, where nobody sees it: round the block. side: 1 right, -1 left; walk:
/// from near to far, as on the right; near, far: z of the ways along the crossing streets. down: along -z.
Track block(int side, std::vector<Vec3d> walk, double near, double far, bool down, int count) {
    constexpr double behind = 18, low = -0.02;
    const double first = walk.front().x, last = walk.back().x;
    walk.insert(walk.end(), {{last, low, far + 0.4},
                             {last, low, far},
                             {last + behind, low, far},
                             {last + behind, low, near},
                             {first, low, near},
                             {first, low, near - 0.4}});
    for (Vec3d& corner : walk) corner.x *= side;
    if (!down) walk = {walk.rbegin(), walk.rend()};
    return {walk, {.radius = 0.4, .speed = side > 0 ? 1.3 : 1.2, .acceleration = 5}, count};
}

constexpr double city_near = 40.6, city_far = -74.9;

std::vector<Vec3d> straight(double x, double height) {
    return {{x, height, city_near - kerb}, {x, height, city_far + kerb}};
}

/// left, right: ways on the pavements, as block() takes them.
Room city(double out, double back, bool small_cars, const std::vector<Vec3d>& left, const std::vector<Vec3d>& right) {
    Room room;
    room.cars = {corners({.out = out,
                          .back = back,
                          .near = 35,
                          .far = -66.5,
                          .near_end = 47.8,
                          .far_end = -80.3,
                          .box_out = out + 2,
                          .box_back = back,
                          .shift = 8,
                          .height = 0.05}),
                 {.radius = 8, .speed = 6, .acceleration = 1.8},
                 11};
    room.small_cars = small_cars;
    room.walks = {block(-1, left, city_near, city_far, false, 12), block(1, right, city_near, city_far, true, 12)};
    return room;
}

Room city(double out, double back, double walk) {
    return city(out, back, false, straight(walk, 0.17), straight(walk, 0.17));
}

/// Round sandwich boards.
Room terrace() {
    const auto aside = [](double z, double x) {
        std::vector<Vec3d> way = straight(5.05, 0.17);
        way.insert(way.begin() + 1,
                   {{5.05, 0.17, z + 1.8}, {x, 0.17, z + 0.8}, {x, 0.17, z - 0.8}, {5.05, 0.17, z - 1.8}});
        return way;
    };
    return city(1.65, -0.2, true, aside(13, 4.35), aside(-5, 4.65));
}

/// On the left only, at the edge of the carriageway, since pavements are too full to walk on; over the pavement past a
/// parked car and at the ends. On the right a stoop leaves no way between itself and a parked car.
Room brickyard() {
    std::vector<Vec3d> walk;
    for (const auto& [z, x] : std::initializer_list<std::pair<double, double>>{{city_near - kerb, 4.9},
                                                                               {36.4, 4.9},
                                                                               {35.2, 3.3},
                                                                               {-20.9, 3.3},
                                                                               {-21.7, 5.1},
                                                                               {-28.4, 5.1},
                                                                               {-30.2, 3.3},
                                                                               {-60, 3.3},
                                                                               {-61.2, 4.9},
                                                                               {city_far + kerb, 4.9}})
        walk.push_back({x, x < 3.9 ? 0.06 : 0.14, z});
    Room room = city(0.92, -0.92, true, walk, walk);
    room.walks.pop_back();
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
                            .box_out = half_width,
                            .box_back = -half_width}),
                   {.radius = half_width, .speed = speed, .acceleration = 1}};
    constexpr double near = 26.2, far = -54.2;
    for (const int side : {-1, 1})
        room.walks.push_back(
            block(side, {{walk, 0.01, near - kerb}, {walk, 0.01, far + kerb}}, near, far, side > 0, 9));
    return room;
}

Room stationstreet() {
    Room room = arcade(4.05, 1.3, 2.4, 5);
    room.cars = Track{corners({.out = -1.3,  // on the left, as in Japan
                               .back = 1.3,
                               .near = 20.5,
                               .far = -49,
                               .near_end = 29.5,
                               .far_end = -57.5,
                               .box_out = -2.4,
                               .box_back = 2.4}),
                      {.radius = 2.4, .speed = 4, .acceleration = 1.5},
                      7};
    room.small_cars = true;
    return room;
}

/// All in one file, since there is no room for more: people, and a camera among them.
Room one_file(const std::vector<Vec3d>& way, double speed, int count) {
    Room room;
    room.camera = {way, {.radius = 0.45, .speed = speed, .acceleration = 2}};
    room.walks = {{way, room.camera.route, count}};
    return room;
}

/// Round signs and pots.
Room lane() {
    constexpr double y = 0.01, out = 0.6, back = -0.37, past_pot = 0.2, past_sign = -0.08;
    return one_file({{out, y, 6.5},
                     {out, y, -9},
                     {past_pot, y, -10},
                     {past_pot, y, -12.8},
                     {out, y, -13.8},
                     {out, y, -19.6},
                     {back, y, -19.6},
                     {back, y, -9.8},
                     {past_sign, y, -8.8},
                     {past_sign, y, -6.6},
                     {back, y, -5.6},
                     {back, y, 6.5}},
                    1, 4);
}

Room backstreet() {
    return one_file({{0.55, 0, 27}, {0.55, 0, -55}, {-0.55, 0, -55}, {-0.55, 0, 27}}, 1.2, 10);
}

}  // namespace

Room traffic_room(const std::string& street) {
    // Lanes between parked cars, walks between trees at the kerb and what stands along the walls: see city_parts.cpp.
    static const std::map<std::string, std::function<Room()>> rooms = {
        {"lane", lane},
        {"citystreet", [] { return city(1.35, -1.35, 6.35); }},
        {"avenue", [] { return city(1.6, -1.6, 9.3); }},
        {"terrace", terrace},
        {"brickyard", brickyard},
        {"japanesestreet", [] { return arcade(2.1, 0.7, 1.5, 2.5); }},
        {"backstreet", backstreet},
        {"stationstreet", stationstreet},
    };
    const auto found = rooms.find(street);
    if (found == rooms.end())
        throw usage_error("traffic", "has no room in the scene \"" + street + "\" (expected one of pluvia scenes)");
    return found->second();
}

}  // namespace pluvia
