// Animations, skins and morph targets: where a file puts vertices, cameras and lights at a point of time.
#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "tests/gltf_draft.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace pluvia;

namespace {

Scene load_at(const GltfDraft& draft, double time, double exposure_time = 1.0 / 60) {
    const TemporaryFolder folder;
    return load_gltf(write(folder, "draft.gltf", draft.gltf()), {.time = time, .exposure_time = exposure_time});
}

/// Adds an animation of one channel. times in seconds.
void animate(GltfDraft& draft, int node, const std::string& path, const std::string& interpolation,
             const std::vector<float>& times, const std::vector<float>& values) {
    const std::string type = path == "weights" ? "SCALAR" : path == "rotation" ? "VEC4" : "VEC3";
    const int input = draft.add_floats(times, "SCALAR"), output = draft.add_floats(values, type);
    draft.add("animations", {{"name", "walk"},
                             {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}}});
}

Vec3d moved(const Scene& scene, Vec3d p, int instance = 0) {
    return scene.instances[instance].scene_from_object.point(p) + scene.origin;
}

/// Where vertex 1 of the mesh, (1, 0, 0) in the file, is.
Vec3d second_vertex(const Scene& scene) {
    return moved(scene, Vec3d(scene.meshes[0].positions[1]));
}

void check_near(Vec3d a, Vec3d b, double tolerance = 1e-6) {  // single precision of keys
    INFO(a.x, " ", a.y, " ", a.z, " and ", b.x, " ", b.y, " ", b.z);
    CHECK(length(a - b) <= tolerance);
}

std::string refusal(const GltfDraft& draft) {
    try {
        load_at(draft, 0);
    } catch (const Error& e) {
        CHECK(e.code() == ExitCode::input);
        return e.what();
    }
    return "";
}

/// A triangle with two joints, of which the second holds vertex 1 alone and rests at (1, 0, 0).
GltfDraft skinned_draft() {
    GltfDraft draft;
    const int joints = draft.add_values<uint8_t>({0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, "VEC4", gltf_ubyte);
    const int weights = draft.add_floats({1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, "VEC4");
    const int mesh = draft.add_triangle_mesh({{"attributes", {{"JOINTS_0", joints}, {"WEIGHTS_0", weights}}}});
    const int matrices = draft.add_floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,  //
                                           1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1},
                                          "MAT4");
    draft.root["accessors"][matrices]["count"] = 2;
    const int hand = draft.add("nodes", {{"name", "hand"}, {"translation", {1, 0, 0}}});
    const int arm = draft.add_root({{"name", "arm"}, {"children", {hand}}});
    draft.add("skins", {{"joints", {arm, hand}}, {"inverseBindMatrices", matrices}});
    // The place of a skinned node does not count: the joints place its mesh.
    draft.add_root({{"name", "person"}, {"mesh", mesh}, {"skin", 0}, {"translation", {50, 60, 70}}});
    return draft;
}

}  // namespace

TEST_CASE("linear, step and cubic keys are interpolated as the specification says, and held outside") {
    GltfDraft draft = triangle_draft();
    SUBCASE("linear") {
        animate(draft, 0, "translation", "LINEAR", {1, 3}, {0, 0, 0, 4, 8, -2});
        check_near(moved(load_at(draft, 0), {}), {0, 0, 0});
        check_near(moved(load_at(draft, 1.5), {}), {1, 2, -0.5});
        check_near(moved(load_at(draft, 3), {}), {4, 8, -2});
        check_near(moved(load_at(draft, 99), {}), {4, 8, -2});
    }
    SUBCASE("step") {
        animate(draft, 0, "translation", "STEP", {1, 2, 3}, {1, 0, 0, 2, 0, 0, 3, 0, 0});
        check_near(moved(load_at(draft, 0.5), {}), {1, 0, 0});
        check_near(moved(load_at(draft, 1.999), {}), {1, 0, 0});
        check_near(moved(load_at(draft, 2), {}), {2, 0, 0});
        check_near(moved(load_at(draft, 9), {}), {3, 0, 0});
    }
    SUBCASE("cubic") {  // in-tangent, value, out-tangent; the keys' tangents make x = t^2 between 0 and 2
        animate(draft, 0, "translation", "CUBICSPLINE", {0, 2}, {9, 9, 9, 0, 0, 0, 0, 0, 0, 4, 0, 0, 4, 0, 0, 9, 9, 9});
        for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) check_near(moved(load_at(draft, t), {}), {t * t, 0, 0});
        check_near(moved(load_at(draft, 5), {}), {4, 0, 0});
    }
}

TEST_CASE("turns follow the shorter arc at even speed") {
    GltfDraft draft = triangle_draft();
    // A quarter turn about z, whose second key is stored with the opposite sign.
    const float h = std::sqrt(0.5f);
    animate(draft, 0, "rotation", "LINEAR", {0, 3}, {0, 0, 0, 1, 0, 0, -h, -h});
    for (const double t : {0.0, 1.0, 2.0, 3.0}) {
        const double angle = std::numbers::pi / 2 * t / 3;
        check_near(second_vertex(load_at(draft, t)), {std::cos(angle), std::sin(angle), 0});
    }
}

TEST_CASE("children move with an animated parent, and size is animated too") {
    GltfDraft draft;
    const int child = draft.add("nodes", {{"mesh", draft.add_triangle_mesh()}, {"translation", {0, 0, 5}}});
    const int parent = draft.add_root({{"children", {child}}, {"scale", {9, 9, 9}}});
    animate(draft, parent, "scale", "LINEAR", {0, 1}, {1, 1, 1, 3, 1, 2});
    animate(draft, parent, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 10, 0});
    check_near(second_vertex(load_at(draft, 1)), {3, 10, 10});
    check_near(second_vertex(load_at(draft, 0.5)), {2, 5, 7.5});
}

TEST_CASE("the scene's own zero is the same at every frame of an animation") {
    GltfDraft draft = triangle_draft();
    draft.root["nodes"][0]["translation"] = {1e6, 0, 0};
    animate(draft, 0, "translation", "LINEAR", {0, 1}, {1e6, 0, 0, 1e6 + 64, 0, 0});
    const Scene first = load_at(draft, 0), last = load_at(draft, 1);
    CHECK(first.origin == last.origin);
    check_near(moved(last, {}) - moved(first, {}), {64, 0, 0}, 1e-8);
    CHECK(std::abs(last.instances[0].scene_from_object.translation.x) < 100);
}

TEST_CASE("a camera's velocity is that of its node over the exposure") {
    GltfDraft draft = triangle_draft();
    draft.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    const int car = draft.add_root({{"name", "car"}, {"camera", 0}});
    const auto velocity = [&](double time) {
        const Scene scene = load_at(draft, time);
        REQUIRE(scene.cameras.size() == 1);
        CHECK(scene.cameras[0].angular_velocity == Vec3d());
        return scene.cameras[0].velocity;
    };
    CHECK(velocity(0.5) == Vec3d());
    animate(draft, car, "translation", "LINEAR", {0, 1, 2}, {0, 0, 0, 0, 0, -10, 0, 0, -30});
    check_near(velocity(0.5), {0, 0, -10}, 1e-4);
    check_near(velocity(1), {0, 0, -15}, 1e-4);  // half of the exposure on each side
    check_near(velocity(0), {0, 0, -10}, 1e-4);  // what is before the first key does not count
    CHECK(velocity(5) == Vec3d());
}

TEST_CASE("a camera turns as fast as its node, whatever the node above is turned and stretched by") {
    GltfDraft draft = triangle_draft();
    draft.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    const int eye = draft.add("nodes", {{"camera", 0}, {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}}});
    const int car = draft.add_root({{"children", {eye}}, {"scale", {2, 2, 2}}});
    // A twelfth of a turn a second about the vertical.
    const float s = std::sin(std::numbers::pi_v<float> / 12), c = std::cos(std::numbers::pi_v<float> / 12);
    animate(draft, car, "rotation", "LINEAR", {0, 1}, {0, 0, 0, 1, 0, s, 0, c});
    check_near(load_at(draft, 0.5).cameras[0].angular_velocity, {0, std::numbers::pi / 6, 0}, 1e-4);
    check_near(load_at(draft, 0.5).cameras[0].velocity, {});
    CHECK(load_at(draft, 7).cameras[0].angular_velocity == Vec3d());
}

TEST_CASE("lights move with their nodes") {
    GltfDraft draft = triangle_draft();
    draft.root["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "point"}}}}}}};
    const int lamp = draft.add_root({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    animate(draft, lamp, "translation", "LINEAR", {0, 1}, {0, 0, 0, 2, 0, 0});
    const Scene scene = load_at(draft, 0.25);
    check_near(scene.lights[0].position + scene.origin, {0.5, 0, 0});
}

TEST_CASE("morph targets move positions and normals by their weights") {
    GltfDraft draft;
    const int up = draft.add_floats({0, 0, 0, 0, 0, 2, 0, 0, 0}, "VEC3"),
              side = draft.add_floats({0, 0, 0, 0, 1, 0, 0, 0, 0}, "VEC3"),
              normal = draft.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3"),
              tilt = draft.add_floats({0, 0, 0, 1, 0, 0, 0, 0, 0}, "VEC3");
    const Json targets = {{{"POSITION", up}, {"NORMAL", tilt}}, {{"POSITION", side}}};
    const int mesh = draft.add_triangle_mesh({{"attributes", {{"NORMAL", normal}}}, {"targets", targets}});
    draft.root["meshes"][mesh]["weights"] = {0.5, 0};
    const int a = draft.add_root({{"mesh", mesh}}), b = draft.add_root({{"mesh", mesh}, {"weights", {0, 3}}});
    Scene scene = load_at(draft, 0);
    REQUIRE(scene.meshes.size() == 2);
    CHECK(scene.meshes[0].positions[1] == Vec3(1, 0, 1));
    const float k = 1 / std::sqrt(1.25f);
    check_near(Vec3d(scene.meshes[0].normals[1]), {0.5 * k, 0, k});
    CHECK(scene.meshes[1].positions[1] == Vec3(1, 3, 0));
    animate(draft, a, "weights", "LINEAR", {0, 1}, {0, 0, 1, 1});
    animate(draft, b, "weights", "LINEAR", {0, 1}, {0, 0, 1, 1});
    scene = load_at(draft, 0.25);
    CHECK(scene.meshes.size() == 1);  // shared again: the weights are the same
    CHECK(scene.meshes[0].positions[1] == Vec3(1, 0.25f, 0.5f));
}

TEST_CASE("a skin moves each vertex with its joints, wherever the skinned node is") {
    GltfDraft draft = skinned_draft();
    const auto vertex = [&](double time, int k) {
        const Scene scene = load_at(draft, time);
        return moved(scene, Vec3d(scene.meshes[0].positions[k]));
    };
    for (int k = 0; k < 3; ++k) check_near(vertex(0, k), Vec3d(k == 1, k == 2, 0));
    animate(draft, 1, "translation", "LINEAR", {0, 1}, {0, 0, 0, 0, 0, 1000000});  // the arm
    animate(draft, 0, "translation", "LINEAR", {0, 1}, {1, 0, 0, 1, 0.5, 0});      // the hand
    check_near(vertex(1, 0), {0, 0, 1e6});
    check_near(vertex(1, 1), {1, 0.5, 1e6});
    check_near(vertex(0.5, 1), {1, 0.25, 5e5});
}

TEST_CASE("a vertex between two joints stands at their weighted mean") {
    GltfDraft draft = skinned_draft();
    const size_t weights = size_t(draft.root["bufferViews"][1]["byteOffset"]);
    const float half[4] = {1, 1, 0, 0};  // not normalised: only the ratio counts
    draft.bytes.replace(weights + 16, 16, reinterpret_cast<const char*>(half), 16);
    draft.bytes[size_t(draft.root["bufferViews"][0]["byteOffset"]) + 4] = 0;
    draft.root["nodes"][0]["translation"] = {1, 8, 0};
    const Scene scene = load_at(draft, 0);
    check_near(second_vertex(scene), {1, 4, 0});
}

TEST_CASE("of two animations that move the same, the first does and a warning says so") {
    GltfDraft draft = triangle_draft();
    animate(draft, 0, "translation", "LINEAR", {0}, {1, 0, 0});
    animate(draft, 0, "translation", "LINEAR", {0}, {2, 0, 0});
    const Scene scene = load_at(draft, 0);
    check_near(moved(scene, {}), {1, 0, 0});
    CHECK(warns(scene, "only the first has an effect"));
}

TEST_CASE("animations, skins and morph targets that make no sense are refused") {
    const auto check_refused = [](const GltfDraft& draft, const std::string& words) {
        const std::string message = refusal(draft);
        CAPTURE(message);
        CHECK(message.find(words) != std::string::npos);
    };
    const auto animated = [](const std::vector<float>& times, const std::vector<float>& values,
                             const std::string& interpolation = "LINEAR") {
        GltfDraft draft = triangle_draft();
        animate(draft, 0, "translation", interpolation, times, values);
        return draft;
    };
    check_refused(animated({0, 2, 1}, {0, 0, 0, 0, 0, 0, 0, 0, 0}), "times do not rise (got 1 after 2 in element 2)");
    check_refused(animated({1, 1}, {0, 0, 0, 0, 0, 0}), "times do not rise");
    check_refused(animated({-1, 1}, {0, 0, 0, 0, 0, 0}), "times do not rise");
    check_refused(animated({0, NAN}, {0, 0, 0, 0, 0, 0}), "not finite");
    check_refused(animated({0, 1}, {0, 0, 0, INFINITY, 0, 0}), "not finite");
    check_refused(animated({0, 1}, {0, 0, 0}), "wrong length");
    check_refused(animated({0, 1}, {0, 0, 0, 0, 0, 0}, "CUBICSPLINE"), "wrong length");
    check_refused(animated({0, 1}, {0, 0, 0, 0, 0, 0}, "BEZIER"), "BEZIER");
    check_refused(animated({}, {}), "no keys");
    GltfDraft draft = animated({0}, {0, 0, 0});
    draft.root["animations"][0]["channels"][0]["target"]["node"] = 7;
    check_refused(draft, "animation 0 \"walk\" channel 0: node does not exist (got 7");
    draft = animated({0}, {0, 0, 0});
    draft.root["animations"][0]["channels"][0]["sampler"] = 1;
    check_refused(draft, "sampler does not exist (got 1");

    draft = skinned_draft();
    draft.root["skins"][0]["joints"] = {1, 77};
    check_refused(draft, "joint 1 is not a node of the scene");
    draft.root["skins"][0]["joints"] = {1};
    check_refused(draft, "vertex 1 names a joint that its skin does not have");
    draft.root["skins"][0]["joints"] = Json::array();
    check_refused(draft, "no joints");
    draft = skinned_draft();
    draft.root["nodes"][2]["skin"] = 5;
    check_refused(draft, "skin does not exist (got 5");
    draft = skinned_draft();
    draft.root["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
    check_refused(draft, "no JOINTS_0");

    draft = GltfDraft();
    const int two = draft.add_floats({0, 0, 0, 0, 0, 0}, "VEC3");
    const int mesh = draft.add_triangle_mesh({{"targets", {{{"POSITION", two}}}}});
    draft.add_root({{"mesh", mesh}, {"weights", {1}}});
    check_refused(draft, "morph target 0: POSITION has the wrong length (got 2, expected 3)");
}
