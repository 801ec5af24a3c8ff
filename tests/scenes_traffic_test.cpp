// Traffic of the streets: what moves, where, and as which object.
#include "renderer/scene/gltf.h"
#include "renderer/scene/label_objects.h"
#include "renderer/scene/taxonomy.h"
#include "scenes/builders.h"
#include "scenes/traffic.h"
#include "tests/error_of.h"
#include "tests/scene_checks.h"
#include "tests/temporary_folder.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

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
    const Loaded start = at(folder / "a.glb", 0), later = at(folder / "a.glb", 2), end = at(folder / "a.glb", 30);
    REQUIRE(start.scene.instances.size() == busy.scene.instances.size());
    std::map<int, int> objects_of_class;
    for (size_t i = 0; i < start.objects.objects.size(); ++i) {
        CHECK(start.objects.objects[i].id == later.objects.objects[i].id);
        ++objects_of_class[start.objects.objects[i].class_id];
    }
    // A body and two legs are one person.
    CHECK(objects_of_class[class_id("person")] == 10);
    CHECK(objects_of_class[class_id("car")] == 3 + 4);  // parked and driving
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
        REQUIRE(std::abs(way.z) == doctest::Approx(drives ? 10 : 2.5).epsilon(drives ? 1e-3 : 0.25).scale(0));
        REQUIRE(std::abs(way.x) < 0.01);
        // Within the street: its ends are the crossing streets.
        const double z = end.scene.instances[i].scene_from_object.translation.z + end.scene.origin.z;
        REQUIRE((z > -82 && z < 50));
        // Above the ground and not far from it: cars stand on it, hips are in the air.
        REQUIRE(instance.scene_from_object.translation.y + start.scene.origin.y < 1.1);
    }
    CHECK(moved > 40);
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
            const double s = leg.times[k] / body.times.back();
            const Vec3d at =
                body.scene_from_object[0].translation * (1 - s) + body.scene_from_object[1].translation * s;
            const Vec3d hip = leg.scene_from_object[k].translation - at;
            REQUIRE(hip.y == doctest::Approx(0.88).epsilon(1e-5));
            REQUIRE(std::hypot(hip.x, hip.z) == doctest::Approx(0.1).epsilon(1e-4).scale(0));
            const double forward = -leg.scene_from_object[k].column_y.z;
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

TEST_CASE("a street without room for traffic is refused by name") {
    Scene lane;
    lane.name = "lane";
    CHECK(std::string(error_of([&] { add_traffic(lane); }).what()).find("\"lane\"") != std::string::npos);
}

}  // namespace pluvia
