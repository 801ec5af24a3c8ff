// glTF files in: what the specification says, and one clear error for what is broken.
#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/gltf.h"
#include "tests/temporary_folder.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cstring>

namespace pluvia {
namespace {

using Json = nlohmann::json;

std::string base64(const std::string& bytes) {
    static const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t v = 0;
        for (size_t k = 0; k < 3; ++k) v = v << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0);
        for (int k = 0; k < 4; ++k) text += i + size_t(k) > bytes.size() ? '=' : digits[v >> (18 - 6 * k) & 63];
    }
    return text;
}

template <class T>
std::string bytes_of(std::initializer_list<T> values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.begin(), bytes.size());
    return bytes;
}

/// A file with one triangle of vertices (0,0,0), (1,0,0), (0,1,0), to be changed by each test.
Json triangle_file() {
    const std::string positions = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}), indices = bytes_of<uint16_t>({0, 1, 2});
    Json j;
    j["asset"]["version"] = "2.0";
    j["scene"] = 0;
    j["scenes"] = {{{"nodes", {0}}}};
    j["nodes"] = {{{"name", "part"}, {"mesh", 0}}};
    j["meshes"] = {{{"name", "triangle"}, {"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}};
    j["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
                      {{"bufferView", 1}, {"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}}};
    j["bufferViews"] = {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 36}},
                        {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 6}}};
    j["buffers"] = {{{"byteLength", 42}, {"uri", "data:application/octet-stream;base64," + base64(positions + indices)}}};
    return j;
}

/// Adds bytes as a buffer, view and accessor; returns the accessor's index.
int add_accessor(Json& j, const std::string& bytes, int component_type, const char* type, int count, bool normalized = false) {
    j["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
    j["bufferViews"].push_back({{"buffer", j["buffers"].size() - 1}, {"byteLength", bytes.size()}});
    j["accessors"].push_back({{"bufferView", j["bufferViews"].size() - 1}, {"componentType", component_type},
                              {"count", count}, {"type", type}, {"normalized", normalized}});
    return int(j["accessors"].size()) - 1;
}

Scene load(const Json& j) {
    const TemporaryFolder folder;
    write_file(folder / "scene.gltf", j.dump());
    return load_gltf(folder / "scene.gltf");
}

/// The message of the Error with which loading fails; its code is that of unreadable input and it names the file.
std::string refusal(const std::string& path) {
    try {
        load_gltf(path);
    } catch (const Error& e) {
        CHECK(e.code() == ExitCode::input);
        CHECK(std::string(e.what()).find(path) != std::string::npos);
        return e.what();
    }
    return "";
}
std::string refusal(const Json& j) {
    const TemporaryFolder folder;
    write_file(folder / "scene.gltf", j.dump());
    return refusal(folder / "scene.gltf");
}

bool mentions(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }
bool warns(const Scene& scene, const std::string& word) {
    return std::any_of(scene.warnings.begin(), scene.warnings.end(), [&](const auto& w) { return mentions(w, word); });
}
/// Where a corner of an instance stands in the file's coordinates.
Vec3d place(const Scene& scene, size_t instance, int vertex) {
    const Instance& i = scene.instances[instance];
    return i.scene_from_object.point(Vec3d(scene.meshes[i.mesh].positions[vertex])) + scene.origin;
}
void check_close(Vec3d a, Vec3d b) { CHECK(length(a - b) < 1e-9 * (1 + length(b))); }

}  // namespace

TEST_CASE("nodes compose translation, rotation and scale in double, parents first") {
    Json j = triangle_file();
    j["nodes"] = Json::parse(R"([
        {"name": "root", "translation": [1000000, 0, 0], "children": [1]},
        {"name": "arm", "rotation": [0, 0, 2, 2], "scale": [2, 3, 4], "children": [2]},
        {"name": "hand", "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0.25,0,0,1], "mesh": 0}])");
    const Scene scene = load(j);
    REQUIRE(scene.instances.size() == 1);
    CHECK(scene.instances[0].name == "root/arm/hand");
    CHECK(scene.instances[0].id == instance_id("root/arm/hand"));
    // (x, y) -> scaled (2x, 3y) -> turned by 90 degrees about z (-3y, 2x), whatever the quaternion's length.
    check_close(place(scene, 0, 0), {1e6, 0.5, 0});
    check_close(place(scene, 0, 1), {1e6, 2.5, 0});
    check_close(place(scene, 0, 2), {1e6 - 3, 0.5, 0});
    // The scene's own coordinates are small.
    CHECK(length(scene.instances[0].scene_from_object.translation) < 10);
}

TEST_CASE("a mesh used by several nodes is one mesh with several instances") {
    Json j = triangle_file();
    j["nodes"].push_back({{"name", "other"}, {"mesh", 0}, {"translation", {0, 0, 5}}});
    j["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load(j);
    CHECK(scene.meshes.size() == 1);
    REQUIRE(scene.instances.size() == 2);
    CHECK(scene.instances[0].id != scene.instances[1].id);
}

TEST_CASE("indices of every width, normalised texture coordinates and colours are read") {
    Json j = triangle_file();
    Json& primitive = j["meshes"][0]["primitives"][0];
    primitive["indices"] = add_accessor(j, bytes_of<uint8_t>({2, 1, 0, 0}), 5121, "SCALAR", 3);
    primitive["attributes"]["TEXCOORD_0"] =
        add_accessor(j, bytes_of<uint16_t>({0, 65535, 65535, 0, 32768, 0}), 5123, "VEC2", 3, true);
    primitive["attributes"]["COLOR_0"] =
        add_accessor(j, bytes_of<uint8_t>({255, 0, 51, 255, 0, 255, 0, 51, 0, 0, 0, 0}), 5121, "VEC4", 3, true);
    const Mesh mesh = load(j).meshes[0];
    CHECK(mesh.triangles[0] == std::array<uint32_t, 3>{2, 1, 0});
    CHECK(mesh.uvs[0] == Vec2{0, 1});
    CHECK(mesh.uvs[2].x == doctest::Approx(0.5).epsilon(1e-4));
    CHECK(mesh.colors[0] == Rgb(1, 0, 0.2f));
    CHECK(mesh.alphas == std::vector<float>{1, 0.2f, 0});
    j["meshes"][0]["primitives"][0]["indices"] = add_accessor(j, bytes_of<uint32_t>({1, 2, 0}), 5125, "SCALAR", 3);
    CHECK(load(j).meshes[0].triangles[0] == std::array<uint32_t, 3>{1, 2, 0});
    j["meshes"][0]["primitives"][0].erase("indices");
    CHECK(load(j).meshes[0].triangles[0] == std::array<uint32_t, 3>{0, 1, 2});
}

TEST_CASE("interleaved attributes are read with their stride") {
    Json j = triangle_file();
    const std::string bytes = bytes_of<float>({0, 0, 0, 0, 0, 1, 5, 0, 0, 0, 0, 1, 0, 6, 0, 0, 0, 1});
    j["buffers"].push_back({{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
    j["bufferViews"].push_back({{"buffer", 1}, {"byteLength", bytes.size()}, {"byteStride", 24}});
    j["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    j["accessors"].push_back({{"bufferView", 2}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    j["meshes"][0]["primitives"][0]["attributes"] = {{"POSITION", 2}, {"NORMAL", 3}};
    const Mesh mesh = load(j).meshes[0];
    CHECK(mesh.positions[2] == Vec3(0, 6, 0));
    CHECK(mesh.normals[1] == Vec3(0, 0, 1));
}

TEST_CASE("materials have the specification's defaults, and factors of the extensions that are read") {
    Json j = triangle_file();
    const Scene bare = load(j);
    CHECK(bare.materials[bare.meshes[0].material].metallic == 1);
    CHECK(bare.materials[bare.meshes[0].material].base_color == Rgb(1));
    j["materials"] = Json::parse(R"([{"name": "m", "alphaMode": "BLEND", "doubleSided": true, "emissiveFactor": [1, 0.5, 0],
        "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0, "roughnessFactor": 0.05},
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 300}, "KHR_materials_ior": {"ior": 1.33},
        "KHR_materials_specular": {"specularFactor": 0.25}, "KHR_materials_transmission": {"transmissionFactor": 0.9}}}])");
    j["meshes"][0]["primitives"][0]["material"] = 0;
    const Material m = load(j).materials[0];
    CHECK(m.alpha_mode == AlphaMode::blend);
    CHECK(m.double_sided);
    CHECK(m.emission == Rgb(300, 150, 0));
    CHECK(m.base_color == Rgb(0.1f, 0.2f, 0.3f));
    CHECK(m.alpha == 0.4f);
    CHECK(m.ior == 1.33f);
    CHECK(m.specular == 0.25f);
    CHECK(m.transmission == 0.9f);
}

TEST_CASE("lights have their units and shine along -z of their node") {
    Json j = triangle_file();
    j["extensionsUsed"] = {"KHR_lights_punctual"};
    j["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([
        {"type": "spot", "intensity": 40, "color": [1, 0.5, 0.25], "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.4}},
        {"type": "directional", "intensity": 1000}, {"type": "point", "intensity": 7, "range": 3}])");
    for (int k = 0; k < 3; ++k) {
        j["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", k}}}}},
                              {"rotation", {std::sqrt(0.5), 0, 0, -std::sqrt(0.5)}}, {"translation", {0, 3, 0}}});
        j["scenes"][0]["nodes"].push_back(k + 1);
    }
    const Scene scene = load(j);
    REQUIRE(scene.lights.size() == 3);
    CHECK(scene.lights[0].kind == PunctualLight::Kind::spot);
    CHECK(scene.lights[0].intensity == Rgb(40, 20, 10));
    CHECK(scene.lights[0].outer_cone_angle == doctest::Approx(0.4));
    CHECK(length(scene.lights[0].direction - Vec3(0, -1, 0)) < 1e-6f);
    check_close(scene.lights[0].position + scene.origin, {0, 3, 0});
    CHECK(scene.lights[1].kind == PunctualLight::Kind::directional);
    CHECK(scene.lights[2].kind == PunctualLight::Kind::point);
    CHECK(warns(scene, "range"));
}

TEST_CASE("a file without a camera is framed whole, a camera keeps its vertical field of view") {
    Json j = triangle_file();
    const Scene scene = load(j);
    const Camera camera = find_camera(scene, "");
    const View view = make_view(camera, {.width = 200, .height = 100});
    for (int k = 0; k < 3; ++k) {
        const Vec3d v = view.view_from_world(place(scene, 0, k) - scene.origin);
        CHECK(v.z > 0);
        const Vec2 pixel = view.pixel_from_view(Vec3(v));
        CHECK((pixel.x > 0 && pixel.x < 200 && pixel.y > 0 && pixel.y < 100));
    }
    j["cameras"] = Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}])");
    j["nodes"].push_back({{"name", "eye"}, {"camera", 0}});
    j["scenes"][0]["nodes"].push_back(1);
    const Scene filmed = load(j);
    REQUIRE(filmed.cameras.size() == 1);
    CHECK(find_camera(filmed, "eye").vertical_fov == doctest::Approx(0.8));
    CHECK(find_camera(filmed, "0").name == "eye");
    CHECK_THROWS_AS(find_camera(filmed, "elsewhere"), Error);
    for (const int width : {100, 400})
        CHECK(make_view(filmed.cameras[0], {.width = width, .height = 100}).focal_pixels ==
              doctest::Approx(50 / std::tan(0.4)));
}

TEST_CASE("pictures are read from beside the file and from inside it") {
    const TemporaryFolder folder;
    const auto png = encode_png(Image<Rgba8>(2, 2, Rgba8{10, 20, 30, 255}));
    const std::string bytes(reinterpret_cast<const char*>(png.data()), png.size());
    write_file(folder / "paint.png", bytes);
    Json j = triangle_file();
    j["images"] = {{{"uri", "paint.png"}}, {{"uri", "data:image/png;base64," + base64(bytes)}}};
    j["samplers"] = Json::parse(R"([{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}])");
    j["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}, {"source": 1}])");
    write_file(folder / "scene.gltf", j.dump());
    const Scene scene = load_gltf(folder / "scene.gltf");
    REQUIRE(scene.images.size() == 2);
    for (const auto& image : scene.images) CHECK(image.at(1, 1) == Rgba8{10, 20, 30, 255});
    CHECK(scene.textures[0].wrap_u == Wrap::clamp);
    CHECK(scene.textures[0].wrap_v == Wrap::mirror);
    CHECK(scene.textures[0].nearest);
    CHECK(scene.textures[1].wrap_u == Wrap::repeat);
    // A picture that is cut off is refused by name, and so is one that is not there.
    write_file(folder / "paint.png", bytes.substr(0, bytes.size() / 2));
    CHECK_THROWS_AS(load_gltf(folder / "scene.gltf"), Error);
    std::filesystem::remove(folder / "paint.png");
    CHECK(mentions(refusal(folder / "scene.gltf"), "paint.png"));
}

TEST_CASE("what is saved is loaded again") {
    Scene scene = make_court(lambert({0.1f, 0.5f, 0.9f}));
    scene.lights.push_back({.name = "lamp", .intensity = Rgb(5, 4, 3), .position = {1, 2, 3}});
    scene.cameras.push_back({"eye", translate({0, 1, 2}), 0.7});
    scene.materials[1].emission = Rgb(300, 200, 100);
    const TemporaryFolder folder;
    save_glb(scene, folder / "court.glb");
    const Scene loaded = load_gltf(folder / "court.glb");
    REQUIRE(loaded.instances.size() == scene.instances.size());
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        CHECK(loaded.instances[i].name == scene.instances[i].name);
        CHECK(loaded.meshes[i].triangles == scene.meshes[i].triangles);
        for (int k = 0; k < 3; ++k) check_close(place(loaded, i, k), place(scene, i, k));
    }
    CHECK(luminance(loaded.materials[1].emission) == doctest::Approx(luminance(scene.materials[1].emission)));
    CHECK(loaded.materials[0].specular == 0);
    CHECK(loaded.lights[0].intensity == scene.lights[0].intensity);
    CHECK(loaded.cameras[0].vertical_fov == doctest::Approx(0.7));
}

TEST_CASE("broken files are refused with the place of the fault") {
    const auto broken = [](auto change) {
        Json j = triangle_file();
        change(j);
        return refusal(j);
    };
    CHECK(mentions(broken([](Json& j) { j["accessors"][0]["count"] = 4; }), "accessor 0"));
    CHECK(mentions(broken([](Json& j) { j["accessors"][0]["count"] = 2147483647; }), "accessor 0"));
    CHECK(mentions(broken([](Json& j) { j["accessors"][0]["byteOffset"] = 4000000000u; }), "accessor 0"));
    CHECK(mentions(broken([](Json& j) { j["bufferViews"][0]["byteLength"] = 4000; }), "buffer"));
    CHECK(mentions(broken([](Json& j) { j["bufferViews"][1]["byteOffset"] = 41; }), "buffer"));
    CHECK(mentions(broken([](Json& j) { j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 9; }), "triangle"));
    CHECK(mentions(broken([](Json& j) { j["meshes"][0]["primitives"][0]["material"] = 3; }), "material"));
    CHECK(mentions(broken([](Json& j) { j["nodes"][0]["mesh"] = 3; }), "mesh"));
    CHECK(mentions(broken([](Json& j) { j["scenes"][0]["nodes"] = {7}; }), "node"));
    CHECK(mentions(broken([](Json& j) { j["nodes"][0]["children"] = {0}; }), "node"));
    CHECK(mentions(broken([](Json& j) { j["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }), "KHR_draco_mesh_compression"));
    CHECK(mentions(broken([](Json& j) {
              j["meshes"][0]["primitives"][0]["indices"] = add_accessor(j, bytes_of<uint16_t>({0, 1, 3}), 5123, "SCALAR", 3);
          }), "vertex"));
    CHECK(mentions(broken([](Json& j) {
              const float nan = std::nanf("");
              j["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
                  add_accessor(j, bytes_of<float>({0, 0, 0, nan, 0, 0, 0, 1, 0}), 5126, "VEC3", 3);
          }), "not finite"));
    CHECK(mentions(broken([](Json& j) {
              j["cameras"] = Json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0, "znear": 0.1}}])");
              j["nodes"][0]["camera"] = 0;
          }), "yfov"));
    CHECK(broken([](Json& j) { j.erase("scenes"), j.erase("scene"); }) != "");
}

TEST_CASE("no prefix of a file, and no file of another kind, is taken for a scene") {
    const TemporaryFolder folder;
    CHECK(mentions(refusal(folder / "absent.glb"), "not a file"));
    write_file(folder / "text.glb", "This is a letter, not a scene.");
    CHECK(refusal(folder / "text.glb") != "");
    write_file(folder / "scene.obj", "v 0 0 0");
    CHECK(mentions(refusal(folder / "scene.obj"), "expected .glb or .gltf"));
    Scene scene;
    add_quad(scene, {}, {1, 0, 0}, {0, 1, 0}, lambert(Rgb(0.5f)));
    save_glb(scene, folder / "quad.glb");
    const std::string whole = read_file(folder / "quad.glb");
    for (size_t length = 0; length < whole.size(); ++length) {
        write_file(folder / "cut.glb", whole.substr(0, length));
        CAPTURE(length);
        CHECK(refusal(folder / "cut.glb") != "");
    }
    const std::string text = triangle_file().dump();
    for (size_t length = 0; length < text.size(); length += 7) {
        write_file(folder / "cut.gltf", text.substr(0, length));
        CHECK(refusal(folder / "cut.gltf") != "");
    }
}

TEST_CASE("what a file uses and is rendered without is named") {
    Json j = triangle_file();
    j["extensionsUsed"] = {"KHR_materials_iridescence", "KHR_texture_transform"};
    j["animations"] = Json::parse(R"([{"channels": [], "samplers": []}])");
    j["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
    const Scene scene = load(j);
    CHECK(warns(scene, "KHR_materials_iridescence"));
    CHECK(warns(scene, "KHR_texture_transform"));
    CHECK(warns(scene, "animations"));
    CHECK(warns(scene, "not made of triangles"));
    CHECK(scene.meshes.size() == 1);
}

}  // namespace pluvia
