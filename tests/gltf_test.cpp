// What a glTF file says against what the scene holds: transforms, geometry, lights, cameras. Materials and pictures are
// in gltf_material_test.cpp, files that must be refused in gltf_refusal_test.cpp.
#include "renderer/scene/gltf.h"

#include "renderer/core/error.h"
#include "renderer/scene/camera.h"
#include "tests/gltf_draft.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

using namespace pluvia;

namespace {

/// Where the file puts a point of an instance.
Vec3d file_point(const Scene& scene, int instance, Vec3d p) {
    return scene.instances[instance].scene_from_object.point(p) + scene.origin;
}

void check_near(Vec3d a, Vec3d b, double tolerance) {
    INFO(a.x, " ", a.y, " ", a.z, " and ", b.x, " ", b.y, " ", b.z);
    CHECK(length(a - b) <= tolerance);
}

/// Three vertices of 20 bytes: position as floats, colour as normalised bytes, and four bytes of something else.
std::string interleaved_vertices() {
    std::string bytes;
    for (int i = 0; i < 3; ++i) {
        const float position[3] = {float(i), float(10 * i), float(100 * i)};
        const uint8_t color[4] = {0, 51, uint8_t(255 * (i == 2)), 255};
        bytes.append(reinterpret_cast<const char*>(position), 12)
            .append(reinterpret_cast<const char*>(color), 4)
            .append("????");
    }
    return bytes;
}

}  // namespace

TEST_CASE("nested transforms a million metres away are composed without loss") {
    GltfDraft draft;
    const int mesh = draft.add_triangle_mesh();
    // A quarter turn about z, its quaternion of length 2.8, then a scale of 2; the child undoes most of the distance.
    const int child =
        draft.add("nodes", {{"mesh", mesh}, {"translation", {-500000.125, 0.001, 0}}, {"scale", {1, 3, 1}}});
    draft.add_root(
        {{"translation", {0, 1000000.25, 0}}, {"rotation", {0, 0, 2, 2}}, {"scale", {2, 2, 2}}, {"children", {child}}});
    const Scene scene = load(draft);
    // Right to left: scale 3 in y, move, scale 2, turn (x, y) to (-y, x), move. 1e-8: some ulps of doubles near 1e6.
    check_near(file_point(scene, 0, {0, 0, 0}), {-0.002, 0, 0}, 1e-8);
    check_near(file_point(scene, 0, {1, 0, 0}), {-0.002, 2, 0}, 1e-8);
    check_near(file_point(scene, 0, {0, 1, 0}), {-6.002, 0, 0}, 1e-8);
}

TEST_CASE("a node's matrix is read column by column") {
    GltfDraft draft;
    draft.add_root(
        {{"mesh", draft.add_triangle_mesh()}, {"matrix", {0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1}}});
    const Scene scene = load(draft);
    check_near(file_point(scene, 0, {1, 0, 0}), {5, 8, 7}, 1e-12);
    check_near(file_point(scene, 0, {0, 1, 0}), {2, 6, 7}, 1e-12);
    check_near(file_point(scene, 0, {0, 0, 1}), {5, 6, 11}, 1e-12);
}

TEST_CASE("an instance is named by its path, and its id does not depend on other nodes") {
    GltfDraft draft;
    const int mesh = draft.add_triangle_mesh();
    const int lamp = draft.add("nodes", {{"name", "lamp"}, {"mesh", mesh}});
    const int unnamed = draft.add("nodes", {{"mesh", mesh}, {"children", {lamp}}});
    draft.add_root({{"name", "street"}, {"children", {unnamed}}});
    const Scene scene = load(draft);
    REQUIRE(scene.instances.size() == 2);
    CHECK(scene.instances[0].name == "street/node_1");
    CHECK(scene.instances[1].name == "street/node_1/lamp");
    CHECK(scene.instances[1].id == instance_id("street/node_1/lamp"));
    CHECK(scene.instances[0].id != scene.instances[1].id);

    draft.add_root({{"name", "tree"}, {"mesh", mesh}});
    std::rotate(draft.root["scenes"][0]["nodes"].begin(), draft.root["scenes"][0]["nodes"].begin() + 1,
                draft.root["scenes"][0]["nodes"].end());
    const Scene with_tree = load(draft);
    REQUIRE(with_tree.instances.size() == 3);
    CHECK(with_tree.instances[0].name == "tree");
    CHECK(with_tree.instances[2].id == scene.instances[1].id);
}

TEST_CASE("a mesh that two nodes share is held once, one part per primitive") {
    GltfDraft draft;
    const int mesh = draft.add_triangle_mesh();
    auto& primitives = draft.root["meshes"][mesh]["primitives"];
    primitives.push_back(Json(primitives[0]));
    draft.add_triangle_mesh();  // used by no node
    for (const char* name : {"a", "b"}) draft.add_root({{"name", name}, {"mesh", mesh}});
    const Scene scene = load(draft);
    CHECK(scene.meshes.size() == 2);
    REQUIRE(scene.instances.size() == 4);
    CHECK(scene.instances[0].mesh == scene.instances[2].mesh);
    CHECK(scene.instances[1].mesh == scene.instances[3].mesh);
    CHECK(scene.instances[0].mesh != scene.instances[1].mesh);
    CHECK(scene.instances[0].id == scene.instances[1].id);
}

TEST_CASE("indices of one, two and four bytes and no indices give the same triangles") {
    GltfDraft draft;
    const int position = draft.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3");
    const std::vector<int> indices = {draft.add_values<uint8_t>({0, 1, 2, 3, 4, 5}, "SCALAR", gltf_ubyte),
                                      draft.add_values<uint16_t>({0, 1, 2, 3, 4, 5}, "SCALAR", gltf_ushort),
                                      draft.add_values<uint32_t>({0, 1, 2, 3, 4, 5}, "SCALAR", gltf_uint)};
    Json primitives = Json::array({{{"attributes", {{"POSITION", position}}}}});
    for (const int i : indices) primitives.push_back({{"attributes", {{"POSITION", position}}}, {"indices", i}});
    draft.add_root({{"mesh", draft.add("meshes", {{"primitives", primitives}})}});
    const Scene scene = load(draft);
    REQUIRE(scene.meshes.size() == 4);
    for (const Mesh& mesh : scene.meshes)
        CHECK(mesh.triangles == std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {3, 4, 5}});
}

TEST_CASE("texture coordinates and colours as normalised integers become fractions") {
    GltfDraft draft;
    const int uv8 = draft.add_values<uint8_t>({0, 255, 51, 0, 255, 102, 0, 0}, "VEC2", gltf_ubyte, true);
    draft.root["accessors"][uv8]["count"] = 3;
    const int uv16 = draft.add_values<uint16_t>({0, 65535, 13107, 0, 65535, 26214}, "VEC2", gltf_ushort, true);
    const int rgb16 = draft.add_values<uint16_t>({0, 13107, 65535, 0, 0, 0, 65535, 0, 0}, "VEC3", gltf_ushort, true);
    const int rgba8 =
        draft.add_values<uint8_t>({0, 51, 255, 255, 0, 0, 0, 0, 255, 0, 0, 102}, "VEC4", gltf_ubyte, true);
    const int first = draft.add_triangle_mesh({{"attributes", {{"TEXCOORD_0", uv8}, {"COLOR_0", rgb16}}}});
    const int second = draft.add_triangle_mesh({{"attributes", {{"TEXCOORD_0", uv16}, {"COLOR_0", rgba8}}}});
    draft.add_root({{"mesh", first}}), draft.add_root({{"mesh", second}});
    const Scene scene = load(draft);
    REQUIRE(scene.meshes.size() == 2);
    for (const Mesh& mesh : scene.meshes) {
        CHECK(mesh.uvs == std::vector<Vec2>{{0, 1}, {0.2f, 0}, {1, 0.4f}});
        CHECK(mesh.colors == std::vector<Rgb>{{0, 0.2f, 1}, {0, 0, 0}, {1, 0, 0}});
    }
    CHECK(scene.meshes[0].alphas.empty());
    CHECK(scene.meshes[1].alphas == std::vector<float>{1, 0, 0.4f});
}

TEST_CASE("interleaved attributes are read with their stride") {
    GltfDraft draft;
    const int view = draft.add_view(interleaved_vertices(), 20);
    const int position = draft.add_accessor(view, 3, "VEC3", gltf_float),
              color = draft.add_accessor(view, 3, "VEC4", gltf_ubyte, true, 12);
    const Json primitive = {{"attributes", {{"POSITION", position}, {"COLOR_0", color}}}};
    draft.add_root({{"mesh", draft.add("meshes", {{"primitives", Json::array({primitive})}})}});
    const Scene scene = load(draft);
    CHECK(scene.meshes[0].positions == std::vector<Vec3>{{0, 0, 0}, {1, 10, 100}, {2, 20, 200}});
    CHECK(scene.meshes[0].colors == std::vector<Rgb>{{0, 0.2f, 0}, {0, 0.2f, 0}, {0, 0.2f, 1}});
    CHECK(scene.meshes[0].alphas == std::vector<float>{1, 1, 1});
}

TEST_CASE("punctual lights keep their candela and lux, and shine along their node's -z") {
    GltfDraft draft = triangle_draft();
    draft.root["extensionsUsed"] = {"KHR_lights_punctual"};
    const Json spot = {{"innerConeAngle", 0.25}, {"outerConeAngle", 0.5}};
    draft.root["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 100}, {"color", {1, 0.5, 0.25}}},
        {{"type", "spot"}, {"name", "torch"}, {"intensity", 40}, {"spot", spot}},
        {{"type", "directional"}},
        {{"type", "spot"}, {"spot", Json::object()}, {"range", 10}}};
    for (int i = 0; i < 4; ++i)  // turned by a quarter about y: -z becomes -x
        draft.add_root({{"name", "light_" + std::to_string(i)},
                        {"translation", {i, 2, 3}},
                        {"rotation", {0, std::sqrt(0.5), 0, std::sqrt(0.5)}},
                        {"scale", {2, 2, 2}},
                        {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    const Scene scene = load(draft);
    REQUIRE(scene.lights.size() == 4);
    CHECK(scene.lights[0].kind == PunctualLight::Kind::point);
    CHECK(scene.lights[0].intensity == Rgb(100, 50, 25));
    CHECK(scene.lights[0].name == "light_0");
    CHECK(scene.lights[1].kind == PunctualLight::Kind::spot);
    CHECK(scene.lights[1].name == "torch");
    CHECK(scene.lights[1].intensity == Rgb(40));
    CHECK(scene.lights[1].inner_cone_angle == 0.25f);
    CHECK(scene.lights[1].outer_cone_angle == 0.5f);
    CHECK(scene.lights[2].kind == PunctualLight::Kind::directional);
    CHECK(scene.lights[2].intensity == Rgb(1));  // the extension's default, lux
    CHECK(scene.lights[3].inner_cone_angle == 0);
    CHECK(scene.lights[3].outer_cone_angle == float(std::numbers::pi / 4));
    for (int i = 0; i < 4; ++i) {
        check_near(scene.lights[i].position + scene.origin, Vec3d(i, 2, 3), 1e-12);
        check_near(Vec3d(scene.lights[i].direction), {-1, 0, 0}, 1e-6);  // single precision
    }
    CHECK(warns(scene, "light \"light_3\": its range is ignored"));
}

TEST_CASE("cameras keep their field of view and are named by the camera, else by the node") {
    GltfDraft draft = triangle_draft();
    draft.root["cameras"] = {
        {{"type", "perspective"}, {"name", "wide"}, {"perspective", {{"yfov", 1.2}, {"znear", 0.1}}}},
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.4}, {"znear", 0.1}, {"aspectRatio", 3}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}}}};
    for (int i = 0; i < 3; ++i)
        draft.add_root({{"name", "node_camera_" + std::to_string(i)}, {"camera", i}, {"translation", {0, 0, i + 1}}});
    const Scene scene = load(draft);
    REQUIRE(scene.cameras.size() == 2);
    CHECK(scene.cameras[0].name == "wide");
    CHECK(scene.cameras[0].vertical_fov == 1.2);
    CHECK(scene.cameras[1].name == "node_camera_1");
    CHECK(scene.cameras[1].vertical_fov == 0.4);
    CHECK(warns(scene, "camera \"node_camera_2\": orthographic projection"));
    CHECK(find_camera(scene, "").name == "wide");
    CHECK(find_camera(scene, "1").name == "node_camera_1");
    const View view = make_view(scene.cameras[1], {});
    check_near(view.position + scene.origin, {0, 0, 2}, 1e-12);
    check_near(view.back, {0, 0, 1}, 1e-12);
}

TEST_CASE("the default scene is the one shown, the first where the file names none") {
    GltfDraft draft = triangle_draft();
    const int other = draft.add("nodes", {{"name", "other"}, {"mesh", 0}});
    draft.root["scenes"].push_back({{"nodes", {other}}});
    CHECK(load(draft).instances[0].name == "triangle");
    draft.root["scene"] = 1;
    CHECK(load(draft).instances[0].name == "other");
    draft.root.erase("scene");
    CHECK(load(draft).instances[0].name == "triangle");
}

TEST_CASE("a scene without a camera is shown whole") {
    GltfDraft draft = triangle_draft();
    draft.add_root({{"mesh", 0}, {"translation", {300, -20, 7}}, {"scale", {1, 50, 3}}});
    const Scene scene = load(draft);
    const Bounds box = bounds(scene);
    for (const int width : {512, 1024}) {
        const View view = make_view(find_camera(scene, ""), {.width = width, .height = 512});
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3d p(corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                          corner & 4 ? box.upper.z : box.lower.z);
            const Vec3d v = view.view_from_world(p);
            REQUIRE(v.z > 0);
            const Vec2 pixel = view.pixel_from_view(Vec3(v));
            INFO(pixel.x, " ", pixel.y);
            CHECK((pixel.x >= 0 && pixel.x <= float(width) && pixel.y >= 0 && pixel.y <= 512));
        }
    }
}

TEST_CASE("a street ten thousand kilometres away loses nothing to single precision") {
    GltfDraft draft = triangle_draft();
    draft.root["nodes"][0]["translation"] = {1e7, 0, -1e7};
    draft.add_root({{"mesh", 0}, {"translation", {1e7 + 0.125, 30, -1e7}}});
    const Scene scene = load(draft);
    check_near(scene.origin, {1e7 + 0.5625, 15.5, -1e7}, 1e-8);
    for (const Instance& instance : scene.instances) CHECK(length(instance.scene_from_object.translation) < 20);
    check_near(file_point(scene, 1, {}), {1e7 + 0.125, 30, -1e7}, 1e-8);  // doubles near 1e7 have steps of 2e-9
    Scene again = scene;
    rebase(again);
    check_near(again.origin, scene.origin, 1e-8);
}

TEST_CASE("the same content as .gltf and as .glb gives the same scene") {
    GltfDraft draft = triangle_draft();
    const TemporaryFolder folder;
    const Scene text = load_gltf(write(folder, "street.gltf", draft.gltf()));
    const Scene binary = load_gltf(write(folder, "street.glb", draft.glb()));
    CHECK(content_hash(text) == content_hash(binary));
    CHECK(text.name == "street");
    CHECK(binary.name == "street");
    CHECK(text.warnings.empty());
    CHECK(binary.warnings.empty());
    draft.root["nodes"][0]["translation"] = {1, 0, 0};
    CHECK(content_hash(load_gltf(write(folder, "street.glb", draft.glb()))) != content_hash(binary));
}

TEST_CASE("what a file asks for and does not get is named in a warning") {
    GltfDraft draft = triangle_draft();
    draft.root["extensionsUsed"] = {"KHR_materials_iridescence", "KHR_materials_ior"};
    auto& primitives = draft.root["meshes"][0]["primitives"];
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
    primitives.push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 1}});
    const Scene scene = load(draft);
    CHECK(scene.meshes.size() == 1);
    for (const char* text :
         {"KHR_materials_iridescence", "primitive 1 is made of points", "primitive 2 is made of lines"}) {
        CAPTURE(text);
        CHECK(warns(scene, text));
    }
    CHECK(scene.warnings.size() == 3);
    primitives.push_back({{"mode", 4}});
    CHECK(warns(load(draft), "'attributes' property is missing"));
}
