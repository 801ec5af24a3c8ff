// Traffic of the streets: what moves, where, and as which object.
#include "renderer/accel/ray_scene.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/label_objects.h"
#include "renderer/scene/lamps.h"
#include "renderer/scene/taxonomy.h"
#include "scenes/builders.h"
#include "scenes/route.h"
#include "scenes/traffic.h"
#include "tests/error_of.h"
#include "tests/scene_checks.h"
#include "tests/temporary_folder.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace pluvia {
namespace {

struct Busy {
    Scene scene;
    std::vector<NodeMotion> motions;
    Busy() : scene(build_terrace()), motions(add_traffic(scene)) {}
};

struct Loaded {
    Scene scene;
    SceneObjects objects;
};
Loaded at(const std::string& path, double time) {
    GltfContents contents;
    Loaded loaded{load_gltf(path, {.time = time, .pictures = false}, &contents), {}};
    loaded.objects = label_objects(loaded.scene, contents.labelled_paths, {});
    return loaded;
}

}  // namespace

TEST_CASE("people and cars of a street are objects that move through it, and nothing else moves") {
    const Busy busy;
    check_triangles(busy.scene);
    check_vertices(busy.scene);
    const TemporaryFolder folder;
    save_glb(busy.scene, folder / "a.glb", busy.motions);
    const Loaded start = at(folder / "a.glb", 0), later = at(folder / "a.glb", 2);
    REQUIRE(start.scene.instances.size() == busy.scene.instances.size());
    std::map<int, int> objects_of_class;
    for (size_t i = 0; i < start.objects.objects.size(); ++i) {
        CHECK(start.objects.objects[i].id == later.objects.objects[i].id);
        ++objects_of_class[start.objects.objects[i].class_id];
    }
    // A body and two legs are one person.
    CHECK(objects_of_class[class_id("person")] == 2 * 12);
    CHECK(objects_of_class[class_id("car")] == 3 + 11);  // parked and driving
    size_t moved = 0;
    for (size_t i = 0; i < start.scene.instances.size(); ++i) {
        const Instance& instance = start.scene.instances[i];
        const Vec3d way =
            later.scene.instances[i].scene_from_object.translation - instance.scene_from_object.translation;
        const bool moves = instance.name.find("/walking_") != std::string::npos ||
                           instance.name.find("/driving_") != std::string::npos;
        CAPTURE(instance.name);
        if (!moves) {
            REQUIRE(length(way) == 0);
            continue;
        }
        ++moved;
        const bool drives = instance.name.find("/driving_") != std::string::npos;
        REQUIRE(length(way) > (drives ? 3 : 0.5));
        REQUIRE(length(way) < (drives ? 12.1 : 3.2));
        // Above the ground and not far from it: cars stand on it, hips are in the air.
        REQUIRE(instance.scene_from_object.translation.y + start.scene.origin.y < 1.1);
    }
    CHECK(moved > 40);
}

TEST_CASE("cars that drive have lamps that go with them and are off by day, and parked cars have none") {
    const Busy busy;
    const TemporaryFolder folder;
    save_glb(busy.scene, folder / "a.glb", busy.motions);
    Scene start = at(folder / "a.glb", 0).scene, later = at(folder / "a.glb", 2).scene;
    const auto car_of = [](const Scene& scene, const std::string& path) {
        const auto found = std::find_if(scene.instances.begin(), scene.instances.end(),
                                        [&](const Instance& i) { return i.name == path; });
        REQUIRE(found != scene.instances.end());
        return found->scene_from_object;
    };
    REQUIRE(start.lights.size() == 11 * 4);
    REQUIRE(later.lights.size() == start.lights.size());
    for (size_t i = 0; i < start.lights.size(); ++i) {
        const PunctualLight &now = start.lights[i], &then = later.lights[i];
        const std::string path = now.name.substr(0, now.name.rfind('/'));
        CAPTURE(now.name);
        CHECK(now.lamp);
        CHECK(length(then.position - now.position) > 3);
        const Transform car_now = inverse(car_of(start, path)), car_then = inverse(car_of(later, path));
        const Vec3d place = car_now.point(now.position), aim = car_now.vector(Vec3d(now.direction));
        CHECK(length(place - car_then.point(then.position)) < 1e-5);  // a metre's rounding to single precision
        CHECK(length(aim - car_then.vector(Vec3d(then.direction))) < 1e-5);
        // At the nose of the car, shining forwards and down, on the side that the name says.
        CHECK(place.z > 1.5);
        CHECK(std::abs(place.x) > 0.3);
        CHECK((place.x > 0) == (now.name.find("left") != std::string::npos));
        CHECK(place.y > 0.5);
        CHECK(aim.z > 0.9);
        CHECK(aim.y < 0);
    }
    const auto shines = [](const Scene& scene, const std::string& kind) {
        std::set<std::string> materials;
        for (const Instance& instance : scene.instances) {
            const Material& m = scene.materials[size_t(scene.meshes[size_t(instance.mesh)].material)];
            if (instance.name.find(kind) != std::string::npos && m.emits()) materials.insert(m.name);
        }
        return materials;
    };
    CHECK(shines(start, "/driving_") == std::set<std::string>{"head_lamp_glow", "tail_lamp_glow"});
    CHECK(shines(start, "/car_").empty());
    switch_off_lamps(start);
    CHECK(start.lights.empty());
    CHECK(shines(start, "/driving_").empty());
}

TEST_CASE("legs swing about hips that go along with their body") {
    const Busy busy;
    std::map<std::string, const NodeMotion*> by_path;
    for (const NodeMotion& motion : busy.motions) by_path[motion.path] = &motion;
    const NodeMotion& body = *by_path.at("terrace/walking_0/body");
    for (const char* side : {"left", "right"}) {
        const NodeMotion& leg = *by_path.at(std::string("terrace/walking_0/leg_") + side);
        double least = 1, most = -1;
        for (size_t k = 0; k < leg.times.size(); ++k) {
            const Vec3d hip = leg.scene_from_object[k].translation - body.scene_from_object[k].translation;
            REQUIRE(hip.y == doctest::Approx(0.88).epsilon(1e-5));
            REQUIRE(std::hypot(hip.x, hip.z) == doctest::Approx(0.1).epsilon(1e-4).scale(0));
            const double forward = -dot(leg.scene_from_object[k].column_y, body.scene_from_object[k].column_z);
            least = std::min(least, forward), most = std::max(most, forward);
        }
        CHECK(least < -0.3);
        CHECK(most > 0.3);
    }
}

TEST_CASE("motion is read back as it was written, also where rotations change their quaternion's sign") {
    Scene scene;
    add_box(scene, {-1, 0, -1}, {1, 1, 1}, lambert(Rgb(0.5f)));
    scene.instances[0].name = "yard/wheel";
    scene.origin = {10, 0, 20};
    NodeMotion motion{"yard/wheel", "", {}, {}};
    for (int k = 0; k <= 16; ++k) {  // two turns
        const double angle = 0.25 * 3.14159265358979 * k;
        motion.times.push_back(0.5f * float(k));
        motion.scene_from_object.push_back(translate({0.1 * k, 1, 0}) *
                                           rotate(0, std::sin(angle / 2), 0, std::cos(angle / 2)));
    }
    scene.instances[0].scene_from_object = motion.scene_from_object[0];
    const TemporaryFolder folder;
    save_glb(scene, folder / "a.glb", {motion});
    for (const double time : {0.0, 0.5, 2.0, 3.25, 7.0, 8.0, 9.0}) {
        const Scene back = load_gltf(folder / "a.glb", {.time = time});
        const double k = std::min(time / 0.5, 16.0), angle = 0.25 * 3.14159265358979 * k;
        const Transform& t = back.instances[0].scene_from_object;
        CAPTURE(time);
        CHECK(length(t.translation + back.origin - Vec3d(10 + 0.1 * k, 1, 20)) < 1e-5);
        CHECK(length(t.column_x - Vec3d(std::cos(angle), 0, -std::sin(angle))) < 1e-5);
    }
}

TEST_CASE("a file holds a camera that turns as it drives") {
    const Busy busy;
    const TemporaryFolder folder;
    save_glb(busy.scene, folder / "a.glb", busy.motions);
    const NodeMotion& drive = busy.motions.back();
    REQUIRE(drive.path == "drive");
    double turned = 0;
    for (const double time : {0.0, 12.3, 20.0, 21.5, 30.0, 60.0, 99.9}) {
        const Scene back = load_gltf(folder / "a.glb", {.time = time, .pictures = false});
        const auto camera =
            std::find_if(back.cameras.begin(), back.cameras.end(), [](const Camera& c) { return c.name == "drive"; });
        REQUIRE(camera != back.cameras.end());
        const Transform& expected = drive.scene_from_object[size_t(std::lround(time * 10))];
        CHECK(length(camera->scene_from_camera.translation + back.origin - expected.translation) < 1e-3);
        CHECK(length(camera->scene_from_camera.column_z - expected.column_z) < 1e-4);
    }
    for (const Transform& key : drive.scene_from_object)
        turned = std::max(turned, length(key.column_z - drive.scene_from_object[0].column_z));
    CHECK(turned > 1.9);  // it drives both ways
}

TEST_CASE("what goes round a route keeps to its speed and its lane, and brakes before corners") {
    const Route::Settings settings = {.radius = 4, .speed = 6, .acceleration = 1.8};
    const Route route({{2, 0, 30}, {2, 0, -30}, {-2, 1, -36}, {-6, 1, -36}, {-2, 0, 30}}, settings);
    const double period = route.period(), step = period / 4000;
    double fastest = 0, slowest = 1e9, braking = 0, across = 0;
    for (int i = 0; i < 4000; ++i) {
        const RoutePlace a = route.at((i - 1) * step), b = route.at(i * step), c = route.at((i + 1) * step);
        const Vec3d way = c.position - a.position;
        const double speed = length(way) / (2 * step);
        fastest = std::max(fastest, speed), slowest = std::min(slowest, speed);
        // Over 0.25 s, since a corner is a polygon of steps of 0.1 m and radii begin at once.
        const auto speed_at = [&](double t) {
            return length(route.at(t + step).position - route.at(t).position) / step;
        };
        braking = std::max(braking, std::abs(speed_at(i * step + 0.25) - speed_at(i * step)) / 0.25);
        across = std::max(across, speed * std::abs(route.at(i * step + 0.25).heading - b.heading) / 0.25);
        CAPTURE(i);
        // One faces where one goes.
        REQUIRE(way.x / std::hypot(way.x, way.z) == doctest::Approx(std::sin(b.heading)).epsilon(0.05));
        REQUIRE(way.z / std::hypot(way.x, way.z) == doctest::Approx(std::cos(b.heading)).epsilon(0.05));
        REQUIRE(length(route.at(i * step + period).position - b.position) < 1e-6);
    }
    CHECK(fastest < 6.1);  // edges that climb are a little longer than flat
    CHECK(fastest > 5.9);
    CHECK(slowest < 3);
    CHECK(braking < 2.2);  // 1.8, and what climbing edges and polygons add
    CHECK(braking > 1.2);
    CHECK(across < 2.2);
    CHECK(across > 1.2);
    CHECK(std::abs(route.at(period).heading - route.at(0).heading) == doctest::Approx(2 * 3.14159265358979));
}

namespace {

/// What moves, seen from above: a car is a rectangle, a person and the camera are round.
struct Mover {
    const NodeMotion* motion;
    double half_width, half_length;
};

std::vector<Mover> movers(const Scene& scene, const std::vector<NodeMotion>& motions) {
    std::vector<Mover> list;
    for (const NodeMotion& motion : motions) {
        if (motion.path == "drive" || motion.path.ends_with("/body")) list.push_back({&motion, 0.28, 0.28});
        if (motion.path.find("/driving_") == std::string::npos) continue;
        Mover car{&motion, 0, 0};
        for (const Instance& instance : scene.instances)
            if (instance.name == motion.path)
                for (const Vec3 p : scene.meshes[size_t(instance.mesh)].positions) {
                    car.half_length = std::max(car.half_length, double(std::abs(p.z)));
                    // Mirrors stand out above other cars' bonnets.
                    if (p.y < 0.8f) car.half_width = std::max(car.half_width, double(std::abs(p.x)));
                }
        list.push_back(car);
    }
    return list;
}

/// Whether points of a's outline lie in b.
bool reaches_into(const Mover& a, const Mover& b, size_t key) {
    const Transform &in = a.motion->scene_from_object[key], &of = b.motion->scene_from_object[key];
    if (length(in.translation - of.translation) > 7) return false;
    for (int i = 0; i < 24; ++i) {
        const double s = i % 6 / 5.0 * 2 - 1;
        const Vec3d corner[] = {{a.half_width, 0, s * a.half_length},
                                {-a.half_width, 0, s * a.half_length},
                                {s * a.half_width, 0, a.half_length},
                                {s * a.half_width, 0, -a.half_length}};
        const Vec3d p = in.point(corner[i / 6]) - of.translation;
        if (std::abs(dot(p, of.column_x)) < b.half_width && std::abs(dot(p, of.column_z)) < b.half_length) return true;
    }
    return false;
}

/// Nothing that moves in a street meets what stands there, or what else moves.
void check_collisions(const std::string& name) {
    const auto builder = std::find_if(builders().begin(), builders().end(), [&](auto& b) { return b.name == name; });
    REQUIRE(builder != builders().end());
    const Scene still = builder->build();
    Scene busy = still;
    const std::vector<NodeMotion> motions = add_traffic(busy);
    const std::vector<Mover> all = movers(busy, motions);
    std::map<std::string, std::string> met;  // who met whom, and when first
    const auto note = [&](const std::string& who, const std::string& whom, size_t key) {
        met.try_emplace(who.substr(name.size() * (who != "drive")) + " and " + whom,
                        fmt::format("{:.1f} s", 0.1 * double(key)));
    };
    for (size_t key = 0; key < all[0].motion->times.size(); key += 2)
        for (const Mover& a : all)
            for (const Mover& b : all)
                if (&a != &b && reaches_into(a, b, key)) note(a.motion->path, b.motion->path, key);
    const RayScene street(still);
    Counters counters;
    for (const Mover& mover : all) {
        const bool is_camera = mover.motion->path == "drive", is_car = mover.half_length > 0.5;
        const double street_side = std::abs(mover.motion->scene_from_object[0].translation.x) + 1;
        for (size_t key = 1; key < mover.motion->times.size(); ++key) {
            const Transform &from = mover.motion->scene_from_object[key - 1],
                            &to = mover.motion->scene_from_object[key];
            // Behind the houses nobody sees who walks through them.
            if (!is_car && !is_camera && std::abs(to.translation.x) > street_side + 8) continue;
            const auto blocked = [&](Vec3d a, Vec3d b) {
                const double far = length(b - a);
                if (far < 1e-6) return;
                Ray ray{Vec3(a), Vec3((b - a) * (1 / far))};
                ray.t_max = float(far);
                RayHit hit;
                if (street.closest_hit(ray, {.at_half = true}, hit, counters))
                    note(mover.motion->path, still.instances[size_t(hit.point.instance)].name, key);
            };
            for (const double height : is_camera ? std::vector<double>{0}
                                       : is_car  ? std::vector<double>{0.3, 0.7}
                                                 : std::vector<double>{0.35, 0.9, 1.5}) {
                const auto at = [&](const Transform& t, double side) {
                    return t.point({side * mover.half_width, height, 0});
                };
                for (const double side : {-1.0, 0.0, 1.0}) blocked(at(from, side), at(to, side));
                blocked(at(to, -1), at(to, 1));
            }
        }
    }
    for (const auto& [who, when] : met) FAIL_CHECK(name << ": " << who << " at " << when);
}

}  // namespace

TEST_CASE("nothing that moves meets what stands in the street or what else moves") {
    for (const char* name : {"lane", "citystreet", "stationstreet"}) check_collisions(name);
}

TEST_CASE("nothing that moves in the other streets meets anything" * doctest::skip()) {
    for (const char* name : {"avenue", "terrace", "brickyard", "japanesestreet", "backstreet"}) check_collisions(name);
}

TEST_CASE("a street without room for traffic is refused by name") {
    Scene yard;
    yard.name = "yard";
    CHECK(std::string(error_of([&] { add_traffic(yard); }).what()).find("\"yard\"") != std::string::npos);
}

}  // namespace pluvia
