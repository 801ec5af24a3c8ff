// The lane is whole: sizes, attributes, measures of what is lit, the same every time, and its file holds all of it.
#include "scenes/builders.h"
#include "tests/scene_checks.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace pluvia;

namespace {

/// Built once: a second costs as much as all checks.
const Scene& lane() {
    static const Scene scene = build_lane();
    return scene;
}

const Material& material_named(const Scene& scene, const std::string& name) {
    const auto found =
        std::find_if(scene.materials.begin(), scene.materials.end(), [&](const Material& m) { return m.name == name; });
    REQUIRE_MESSAGE(found != scene.materials.end(), name);
    return *found;
}

}  // namespace

TEST_CASE("the lane has half a million to five million triangles and passes the scene's own check") {
    const size_t placed = placed_triangles(lane());
    CAPTURE(placed);
    CHECK(placed >= 500000);
    CHECK(placed <= 5000000);
    CHECK_NOTHROW(check(lane(), "lane"));
}

TEST_CASE("pictures, vertices and triangles of the lane are in order") {
    check_pictures(lane());
    check_vertices(lane());
    check_triangles(lane());
}

TEST_CASE("what stands in the lane has its class") {
    check_classes(lane(), {"building", "wall", "fence", "pole", "vegetation", "sidewalk", "terrain", "static"});
}

TEST_CASE("the lane's cameras stand in it and look along it") {
    const auto camera = [](const std::string& name) {
        const auto found =
            std::find_if(lane().cameras.begin(), lane().cameras.end(), [&](const Camera& c) { return c.name == name; });
        REQUIRE_MESSAGE(found != lane().cameras.end(), name);
        return *found;
    };
    for (const char* name : {"front", "mid", "side", "low"}) {
        const Camera c = camera(name);
        CAPTURE(name);
        CHECK(std::abs(c.scene_from_camera.translation.x) < 1.4);
        CHECK(c.scene_from_camera.column_z.z > 0.8);  // back of the camera is towards +z
        CHECK(c.scene_from_camera.column_y.y > 0.9);
        CHECK(c.vertical_fov >= 0.5);
        CHECK(c.vertical_fov <= 0.7);
    }
    CHECK(camera("front").scene_from_camera.translation.y == 1.6);
    CHECK(camera("low").scene_from_camera.translation.y == 0.4);
}

TEST_CASE("what is lit in the lane has the luminance of its kind") {
    struct Range {
        const char* name;
        float low, high;
    };
    // cd/m2: windows 50 to 200, paper lanterns 300 to 1500, lit signs as bright as lanterns at most, lamp glass 3000 to
    // 8000.
    for (const auto& [name, low, high] : {Range{"lit_window", 50, 200},
                                          {"warm_window", 50, 200},
                                          {"white_lantern", 300, 1500},
                                          {"red_lantern", 300, 1500},
                                          {"lit_sign", 100, 600},
                                          {"lit_sign_tall", 100, 600},
                                          {"lit_sign_box", 100, 600},
                                          {"lamp_glass", 3000, 8000}}) {
        const float nits = luminance(material_named(lane(), name).emission);
        CAPTURE(name);
        CHECK(nits >= low);
        CHECK(nits <= high);
    }
    for (const Material& m : lane().materials) CHECK(luminance(m.emission) <= 8000);
}

TEST_CASE("building the lane twice gives the same file, and the file holds the same lane") {
    check_cameras(lane(), {"front", "mid", "side", "low"});
    check_file(lane(), build_lane(), 60e6);
}
