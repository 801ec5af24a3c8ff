#include "scenes/traffic.h"

#include "scenes/car.h"
#include "scenes/car_lamps.h"
#include "scenes/person.h"
#include "scenes/route.h"
#include "scenes/traffic_rooms.h"

#include "renderer/core/units.h"

#include <cmath>

namespace pluvia {
namespace {

/// A rigid placement that turns by `pitch` around the x axis of what faces `heading` around y.
Transform placed(Vec3d at, double heading, double pitch = 0) {
    return translate(at) * rotate_y(heading) * rotate(std::sin(pitch / 2), 0, 0, std::cos(pitch / 2));
}

/// When keys are: close enough for corners, and at the frames of 10 a second.
const std::vector<float>& key_times() {
    static const std::vector<float> times = [] {
        std::vector<float> list;
        for (int k = 0; k <= 10 * int(traffic_seconds); ++k) list.push_back(float(k) / 10);
        return list;
    }();
    return times;
}

CarShape narrow(CarShape shape) {
    shape.width = 1.5f, shape.length *= 0.85f;
    for (float* z : {&shape.cabin_front, &shape.cabin_rear, &shape.roof_front, &shape.roof_rear}) *z *= 0.85f;
    return shape;
}

class Traffic {
public:
    explicit Traffic(Scene& scene)
        : street_{std::move(scene), {}}, palette_(street_), room_(traffic_room(street_.scene.name)) {}

    std::vector<NodeMotion> add() {
        if (room_.cars) add_cars(*room_.cars);
        int number = 0;
        for (const Track& walk : room_.walks) add_people(walk, number);
        add_camera(room_.cars ? *room_.cars : room_.camera);
        check(street_.scene, street_.scene.name);
        return std::move(motions_);
    }
    Scene scene() { return std::move(street_.scene); }

private:
    /// All but the first place, which is the camera's.
    void add_cars(const Track& track) {
        static const char* const paints[] = {"car_silver", "car_black", "car_red", "car_white", "car_blue"};
        const Route route(track.corners, track.route);
        for (int k = 1; k <= track.count; ++k) {
            const double start = route.period() * k / (track.count + 1) + chance_(-0.4f, 0.4f);
            CarShape shape = k % 3 == 0 ? hatchback() : k % 3 == 1 ? saloon() : estate();
            if (room_.small_cars) shape = narrow(shape);
            shape.lamps_on = true;
            const std::string name = street_.scene.name + "/driving_" + std::to_string(k - 1);
            add_moving(name, "", "car", car(palette_, shape, paints[k % 5]), [&](double t) {
                const RoutePlace at = route.at(start + t);
                return placed(at.position, at.heading);
            });
            add_beams(name, shape, motions_.back().scene_from_object[0]);
        }
    }

    void add_beams(const std::string& path, const CarShape& shape, const Transform& scene_from_car) {
        for (PunctualLight light : dipped_beams(shape)) {
            light.name = path + "/" + light.name;
            light.position = scene_from_car.point(light.position);
            light.direction = Vec3(scene_from_car.vector(Vec3d(light.direction)));
            street_.scene.lights.push_back(light);
        }
    }

    void add_people(const Track& track, int& number) {
        const Route route(track.corners, track.route);
        for (int i = 0; i < track.count; ++i, ++number) {
            const double speed = track.route.speed, stride = 1.3 + 0.1 * speed;  // m/s, metres a pair of steps
            // In a file that a camera goes along with, between it and the next.
            const double start = route.period() * (i + 0.5 + chance_(-0.3f, 0.3f)) / track.count;
            const double phase = chance_(0, 2 * pi);
            PersonLook look;
            look.coat = color(0.02f, 0.35f), look.trousers = color(0.02f, 0.12f), look.umbrella = color(0.03f, 0.6f);
            look.hair = Rgb(chance_(0.01f, 0.12f)), look.has_umbrella = number % 4 != 3;
            const std::string name = street_.scene.name + "/walking_" + std::to_string(number);
            const auto at = [&](double t) { return route.at(start + t); };
            add_moving(name + "/body", name, "person", person_body(palette_, look),
                       [&](double t) { return placed(at(t).position, at(t).heading); });
            const Assembly leg = person_leg(palette_, look);
            for (const int side : {-1, 1})
                add_moving(name + (side < 0 ? "/leg_right" : "/leg_left"), name, "person", leg, [&](double t) {
                    const RoutePlace place = at(t);
                    const double swing = side * 0.42 * std::sin(2 * pi * speed / stride * t + phase);
                    const Vec3d hip =
                        place.position + rotate_y(place.heading).vector({side * hip_offset, hip_height, 0});
                    return placed(hip, place.heading, swing);
                });
        }
    }

    /// At the height of a driver's eyes.
    void add_camera(const Track& track) {
        const Route route(track.corners, track.route);
        const auto eye = [&](double t) { return route.at(t).position + Vec3d(0, 1.35, 0); };
        const auto ahead = [&](double t) {
            const double heading = route.at(t).heading;
            return eye(t) + Vec3d(std::sin(heading), 0, std::cos(heading));
        };
        NodeMotion motion{"drive", "", key_times(), {}};
        for (const float t : key_times())
            motion.scene_from_object.push_back(look_at("drive", eye(t), ahead(t), 30).scene_from_camera);
        street_.scene.cameras.push_back(look_at("drive", eye(0), ahead(0), 30));
        motions_.push_back(std::move(motion));
    }

    template <class Place>
    void add_moving(const std::string& path, const std::string& object, const std::string& semantic,
                    const Assembly& assembly, Place place_at) {
        NodeMotion motion{path, object, key_times(), {}};
        for (const float t : key_times()) motion.scene_from_object.push_back(place_at(t));
        place_once(street_, path, semantic, assembly, motion.scene_from_object[0]);
        motions_.push_back(std::move(motion));
    }

    Rgb color(float least, float most) { return {chance_(least, most), chance_(least, most), chance_(least, most)}; }

    Street street_;
    Palette palette_;
    const Room room_;
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
