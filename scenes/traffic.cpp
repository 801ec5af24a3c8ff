#include "scenes/traffic.h"

#include "scenes/car.h"
#include "scenes/person.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"

#include <cmath>
#include <map>

namespace pluvia {
namespace {

/// Where there is room to move in a street: along z, at these x and heights.
struct Track {
    double x, y;
    int direction;  // of cars: +1 towards +z; people go both ways
};
struct Room {
    std::vector<Track> lanes, walks;
    double near = 30, far = -60;  // z between which people start
    int people = 5;               // on each walk
};

Room room_of(const std::string& street) {
    // Lanes between parked cars, walks between trees at the kerb and what stands along the walls: see city_parts.cpp.
    const auto city = [](double lane, double walk) {
        return Room{{{-lane, 0.05, 1}, {lane, 0.05, -1}}, {{-walk, 0.17, 0}, {walk, 0.17, 0}}};
    };
    const auto arcade = [](double x) { return Room{{}, {{-x, 0.01, 0}, {x, 0.01, 0}}, 6, -34, 5}; };
    const std::map<std::string, Room> rooms = {
        {"citystreet", city(1.4, 6.5)},
        {"avenue", city(2.2, 9.5)},
        {"terrace", {{{1.75, 0.05, -1}}, {{-5.05, 0.17, 0}, {5.05, 0.17, 0}}}},
        {"brickyard", {{{-0.8, 0.05, 1}}, {{-5.3, 0.14, 0}, {5.3, 0.14, 0}}}},
        {"japanesestreet", arcade(2.1)},
        {"backstreet", arcade(1.0)},
        {"stationstreet", arcade(2.4)},
    };
    const auto found = rooms.find(street);
    if (found == rooms.end())
        throw usage_error("traffic",
                          "has no room in the scene \"" + street + "\" (expected a street wider than the lane)");
    return found->second;
}

/// A rigid placement that turns by `pitch` around the x axis of what faces `heading` around y.
Transform placed(Vec3d at, double heading, double pitch = 0) {
    return translate(at) * rotate_y(heading) * rotate(std::sin(pitch / 2), 0, 0, std::cos(pitch / 2));
}

class Traffic {
public:
    explicit Traffic(Scene& scene)
        : street_{std::move(scene), {}}, palette_(street_), room_(room_of(street_.scene.name)) {}

    std::vector<NodeMotion> add() {
        int number = 0;
        for (const Track& lane : room_.lanes) add_cars(lane, number);
        number = 0;
        for (const Track& walk : room_.walks) add_people(walk, number);
        if (!room_.lanes.empty()) add_camera(room_.lanes.back());
        check(street_.scene, street_.scene.name);
        return std::move(motions_);
    }
    Scene scene() { return std::move(street_.scene); }

private:
    static constexpr int cars_in_row = 4;
    static constexpr double car_speed = 5, car_gap = 19;  // m/s, metres

    /// A row that enters by the crossing street at one end and stays between both for traffic_seconds.
    void add_cars(const Track& lane, int& number) {
        static const char* const paints[] = {"car_silver", "car_black", "car_red", "car_white", "car_blue"};
        for (int k = 0; k < cars_in_row; ++k, ++number) {
            const double way = car_gap * k + chance_(0, 4), z = lane.direction > 0 ? -70 + way : 46 - way;
            const CarShape shape = number % 3 == 0 ? hatchback() : number % 3 == 1 ? saloon() : estate();
            const std::string name = street_.scene.name + "/driving_" + std::to_string(number);
            add_moving(name, "", "car", car(palette_, shape, paints[number % 5]), {0, traffic_seconds}, [&](double t) {
                return placed({lane.x, lane.y, z + lane.direction * car_speed * t}, lane.direction > 0 ? 0 : pi);
            });
        }
    }

    void add_people(const Track& walk, int& number) {
        for (int i = 0; i < room_.people; ++i, ++number) {
            const int direction = (number + i) % 2 == 0 ? 1 : -1;
            const double speed = chance_(1.0f, 1.5f), stride = 1.3 + 0.1 * speed;  // m/s, metres a pair of steps
            const double share = (i + chance_(0.1f, 0.9f)) / room_.people;
            const Vec3d start(walk.x + chance_(-0.25f, 0.25f), walk.y, room_.near + share * (room_.far - room_.near));
            const double heading = direction > 0 ? 0 : pi, phase = chance_(0, 2 * pi);
            PersonLook look;
            look.coat = color(0.02f, 0.35f), look.trousers = color(0.02f, 0.12f), look.umbrella = color(0.03f, 0.6f);
            look.hair = Rgb(chance_(0.01f, 0.12f)), look.has_umbrella = number % 4 != 3;
            const std::string name = street_.scene.name + "/walking_" + std::to_string(number);
            const auto at = [&](double t) { return start + Vec3d(0, 0, direction * speed * t); };
            add_moving(name + "/body", name, "person", person_body(palette_, look), {0, traffic_seconds},
                       [&](double t) { return placed(at(t), heading); });
            std::vector<float> times;
            for (int k = 0; k <= 120; ++k) times.push_back(traffic_seconds * float(k) / 120);
            const Assembly leg = person_leg(palette_, look);
            for (const int side : {-1, 1})
                add_moving(name + (side < 0 ? "/leg_right" : "/leg_left"), name, "person", leg, times, [&](double t) {
                    const double swing = side * 0.42 * std::sin(2 * pi * speed / stride * t + phase);
                    const Vec3d hip = at(t) + rotate_y(heading).vector({side * hip_offset, hip_height, 0});
                    return placed(hip, heading, swing);
                });
        }
    }

    /// Between the last cars of a row, at the height of eyes.
    void add_camera(const Track& lane) {
        const double z = lane.direction > 0 ? -58.5 : 34.5;
        const Vec3d at(lane.x - 0.35 * lane.direction, 1.35, z), ahead = at + Vec3d(0, 0.04, lane.direction * 30);
        street_.scene.cameras.push_back(
            look_at("drive", at, ahead, 30, {0, 0, lane.direction * car_speed * traffic_seconds}, traffic_seconds));
    }

    template <class Place>
    void add_moving(const std::string& path, const std::string& object, const std::string& semantic,
                    const Assembly& assembly, const std::vector<float>& times, Place place_at) {
        NodeMotion motion{path, object, times, {}};
        for (const float t : times) motion.scene_from_object.push_back(place_at(t));
        place_once(street_, path, semantic, assembly, motion.scene_from_object[0]);
        motions_.push_back(std::move(motion));
    }

    Rgb color(float least, float most) { return {chance_(least, most), chance_(least, most), chance_(least, most)}; }

    Street street_;
    Palette palette_;
    Room room_;
    Chance chance_{0x7aff1c};
    std::vector<NodeMotion> motions_;
};

}  // namespace

std::vector<NodeMotion> add_traffic(Scene& scene) {
    Traffic traffic(scene);
    std::vector<NodeMotion> motions = traffic.add();
    scene = traffic.scene();
    return motions;
}

}  // namespace pluvia
