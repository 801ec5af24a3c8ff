// A scene with one of everything goes through a .glb file and comes back as it was.
#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "tests/temporary_folder.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace pluvia;

namespace {

/// Two instances of one triangle far from zero, every material setting off its default, every kind of light.
Scene scene_of_everything() {
    Scene scene;
    scene.name = "everything";
    scene.origin = {1.0e6, 250, -2.0e6};
    scene.images.emplace_back(2, 2, Rgba8{10, 20, 30, 40});
    scene.textures = {{.image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::mirror, .nearest = true}, {.image = 0}};
    Material m;
    m.name = "all";
    m.base_color = {0.1f, 0.2f, 0.3f};
    m.alpha = 0.4f;
    m.metallic = 0.25f, m.roughness = 0.05f;
    m.specular = 0.6f, m.ior = 1.33f, m.transmission = 0.7f;
    m.emission = {900, 300, 0.5f};
    m.base_color_texture = 0, m.metallic_roughness_texture = 1, m.normal_texture = 1, m.emission_texture = 0;
    m.specular_color = {0.5f, 2, 0.25f};
    m.clearcoat = 0.5f, m.clearcoat_roughness = 0.25f, m.clearcoat_normal_scale = 2;
    m.clearcoat_texture = 0, m.clearcoat_roughness_texture = m.clearcoat_normal_texture = 1;
    m.sheen_color = {0.25f, 0.5f, 0.75f}, m.sheen_roughness = 0.5f;
    m.sheen_color_texture = 0, m.sheen_roughness_texture = 1;
    m.anisotropy = 0.75f, m.anisotropy_rotation = 0.5f, m.anisotropy_texture = 1;
    m.unlit = true;
    m.specular_texture = 1, m.specular_color_texture = 0, m.transmission_texture = 1;
    m.normal_texture.uv_set = m.specular_texture.uv_set = 1;
    for (TextureSlot* slot : {&m.base_color_texture, &m.specular_color_texture}) {
        slot->has_transform = true;
        slot->transform = uv_transform({0.25f, -1}, 0.5f, {2, -3});
    }
    m.normal_scale = 0.5f;
    m.alpha_mode = AlphaMode::mask, m.alpha_cutoff = 0.3f;
    m.double_sided = true;
    scene.materials = {m, Material{.name = "plain", .emission = Rgb(0.25f), .alpha_mode = AlphaMode::blend}};
    Material body;  // of no mesh: the triangle below has edges
    body.name = "body", body.transmission = 1;
    body.thickness = 0.25f, body.attenuation_color = {0.5f, 0.75f, 1}, body.attenuation_distance = 2;
    scene.materials.push_back(body);
    Mesh mesh;
    mesh.name = "triangle";
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.1f}};
    mesh.normals = {{0, 0, 1}, {0, 0.6f, 0.8f}, {0, 0, 1}};
    mesh.uvs = {{0, 1}, {1, 1}, {0, -3.5f}};
    mesh.uvs1 = {{0.5f, 0}, {2, 1}, {0.25f, 0.75f}};
    mesh.tangents = {{{1, 0, 0}, -1}, {{1, 0, 0}, -1}, {{1, 0, 0}, -1}};
    mesh.colors = {Rgb(0.1f), Rgb(0.2f), {0.3f, 0.4f, 0.5f}};
    mesh.alphas = {0.5f, 1, 0.25f};
    mesh.triangles = {{0, 1, 2}};
    mesh.material = 0;
    scene.meshes = {mesh};
    mesh.name = "bare", mesh.material = 1;
    mesh.normals.clear(), mesh.uvs.clear(), mesh.uvs1.clear(), mesh.tangents.clear(), mesh.colors.clear(),
        mesh.alphas.clear();
    scene.meshes.push_back(mesh);
    for (const std::string name : {"street/block/house_1", "street/block/house_2", "alone"})
        scene.instances.push_back({name, instance_id(name), name == "alone" ? 1 : 0,
                                   translate({3.0 + double(name.size()), 1, 2}) * rotate(0.1, 0.2, 0.3, 0.9)});
    scene.lights = {{.name = "point", .intensity = {80, 40, 10}, .position = {1, 2, 3}},
                    {.name = "spot",
                     .kind = PunctualLight::Kind::spot,
                     .intensity = Rgb(0.5f),
                     .position = {3, 2, 1},
                     .direction = {0.6f, -0.8f, 0},
                     .inner_cone_angle = 0.2f,
                     .outer_cone_angle = 0.4f},
                    {.name = "sun",
                     .kind = PunctualLight::Kind::directional,
                     .intensity = Rgb(1e5f),
                     .position = {},
                     .direction = {0, -1, 0}}};
    scene.cameras = {{"eye", translate({0, 1.6, 5}) * rotate(0, 0.1, 0, 1), 0.7}};
    return scene;
}

bool close(double a, double b) {
    return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b));
}
// The strength of a colour is split off and multiplied back in single precision: two roundings.
bool close(Rgb a, Rgb b) {
    return close(a.r, b.r) && close(a.g, b.g) && close(a.b, b.b);
}
// Coordinates a million metres from zero keep 1e-10 m in double; the sums of origin and translation round twice.
bool close(Vec3d a, Vec3d b) {
    return length(a - b) < 1e-8;
}

void check_slots(const Material& a, const Material& b) {
    std::vector<TextureSlot> expected;
    Material::for_each_slot(a, [&](const TextureSlot& slot, const char*) { expected.push_back(slot); });
    size_t i = 0;
    Material::for_each_slot(b, [&](const TextureSlot& slot, const char* name) {
        CAPTURE(name);
        const TextureSlot& e = expected[i++];
        CHECK(slot.texture == e.texture);
        CHECK(slot.uv_set == e.uv_set);
        CHECK(slot.has_transform == e.has_transform);
        // Written as angle and scale: a few roundings.
        for (const Vec2 uv : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}}) {
            CHECK(std::abs(slot.transform(uv).x - e.transform(uv).x) < 1e-6f);
            CHECK(std::abs(slot.transform(uv).y - e.transform(uv).y) < 1e-6f);
        }
    });
}

}  // namespace

TEST_CASE("a scene comes back from its .glb with every setting of its materials") {
    const TemporaryFolder folder;
    const Scene scene = scene_of_everything();
    save_glb(scene, folder / "a.glb");
    const Scene back = load_gltf(folder / "a.glb");
    CHECK(back.warnings.empty());
    REQUIRE(back.materials.size() >= 3);
    for (int i = 0; i < 3; ++i) {
        const Material &a = scene.materials[i], &b = back.materials[i];
        CAPTURE(a.name);
        CHECK(a.name == b.name);
        CHECK(a.base_color == b.base_color);
        CHECK(a.alpha == b.alpha);
        CHECK(a.metallic == b.metallic);
        CHECK(a.roughness == b.roughness);
        CHECK(a.specular == b.specular);
        CHECK(a.ior == b.ior);
        CHECK(a.transmission == b.transmission);
        CHECK(close(a.emission, b.emission));
        CHECK(a.specular_color == b.specular_color);
        CHECK(a.thickness == b.thickness);
        CHECK(a.attenuation_color == b.attenuation_color);
        CHECK(a.attenuation_distance == b.attenuation_distance);
        CHECK(a.clearcoat == b.clearcoat);
        CHECK(a.clearcoat_roughness == b.clearcoat_roughness);
        CHECK(a.clearcoat_normal_scale == b.clearcoat_normal_scale);
        CHECK(a.sheen_color == b.sheen_color);
        CHECK(a.anisotropy == b.anisotropy);
        CHECK(a.anisotropy_rotation == b.anisotropy_rotation);
        CHECK(a.sheen_roughness == b.sheen_roughness);
        CHECK(a.unlit == b.unlit);
        check_slots(a, b);
        CHECK(a.normal_scale == b.normal_scale);
        CHECK(a.alpha_mode == b.alpha_mode);
        CHECK(a.alpha_cutoff == b.alpha_cutoff);
        CHECK(a.double_sided == b.double_sided);
    }
    REQUIRE(back.textures.size() == 2);
    CHECK(back.textures[0].wrap_u == Wrap::clamp);
    CHECK(back.textures[0].wrap_v == Wrap::mirror);
    CHECK(back.textures[0].nearest);
    CHECK(back.textures[1].wrap_u == Wrap::repeat);
    CHECK_FALSE(back.textures[1].nearest);
    REQUIRE(back.images.size() == 1);
    CHECK(back.images[0].pixels == scene.images[0].pixels);
}

TEST_CASE("meshes come back bit by bit and stay shared, and instances keep their paths, ids and places") {
    const TemporaryFolder folder;
    const Scene scene = scene_of_everything();
    save_glb(scene, folder / "a.glb");
    const Scene back = load_gltf(folder / "a.glb");
    REQUIRE(back.meshes.size() == 2);
    for (int i = 0; i < 2; ++i) {
        const Mesh &a = scene.meshes[i], &b = back.meshes[i];
        CHECK(a.name == b.name);
        CHECK(a.positions == b.positions);
        CHECK(a.normals == b.normals);
        CHECK(a.uvs == b.uvs);
        CHECK(a.uvs1 == b.uvs1);
        CHECK(a.colors == b.colors);
        CHECK(a.alphas == b.alphas);
        CHECK(a.triangles == b.triangles);
        CHECK(a.material == b.material);
        REQUIRE(a.tangents.size() == b.tangents.size());
        for (size_t k = 0; k < a.tangents.size(); ++k) {
            CHECK(a.tangents[k].direction == b.tangents[k].direction);
            CHECK(a.tangents[k].sign == b.tangents[k].sign);
        }
    }
    REQUIRE(back.instances.size() == 3);
    for (int i = 0; i < 3; ++i) {
        const Instance &a = scene.instances[i], &b = back.instances[i];
        CHECK(a.name == b.name);
        CHECK(a.id == b.id);
        CHECK(a.mesh == b.mesh);
        CHECK(a.scene_from_object.column_y == b.scene_from_object.column_y);
        CHECK(close(a.scene_from_object.translation + scene.origin, b.scene_from_object.translation + back.origin));
    }
}

TEST_CASE("lights and cameras come back with their measures") {
    const TemporaryFolder folder;
    const Scene scene = scene_of_everything();
    save_glb(scene, folder / "a.glb");
    const Scene back = load_gltf(folder / "a.glb");
    REQUIRE(back.lights.size() == 3);
    for (int i = 0; i < 3; ++i) {
        const PunctualLight &a = scene.lights[i], &b = back.lights[i];
        CAPTURE(a.name);
        CHECK(a.name == b.name);
        CHECK(a.kind == b.kind);
        CHECK(close(a.intensity, b.intensity));
        CHECK(close(a.position + scene.origin, b.position + back.origin));
        if (a.kind != PunctualLight::Kind::point)
            CHECK(length(a.direction - b.direction) < 1e-6f);  // one rounding each way
        if (a.kind != PunctualLight::Kind::spot) continue;
        CHECK(a.inner_cone_angle == b.inner_cone_angle);
        CHECK(a.outer_cone_angle == b.outer_cone_angle);
    }
    REQUIRE(back.cameras.size() == 1);
    CHECK(back.cameras[0].name == "eye");
    CHECK(back.cameras[0].vertical_fov == scene.cameras[0].vertical_fov);
    CHECK(back.cameras[0].scene_from_camera.column_z == scene.cameras[0].scene_from_camera.column_z);
    CHECK(close(back.cameras[0].scene_from_camera.translation + back.origin,
                scene.cameras[0].scene_from_camera.translation + scene.origin));
}

TEST_CASE("the same scene gives the same bytes and leaves no temporary file") {
    const TemporaryFolder folder;
    save_glb(scene_of_everything(), folder / "a.glb");
    save_glb(scene_of_everything(), folder / "b.glb");
    CHECK(read_file(folder / "a.glb") == read_file(folder / "b.glb"));
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 2);
}

TEST_CASE("a scene with a mesh without triangles is refused by name") {
    const TemporaryFolder folder;
    Scene scene = scene_of_everything();
    scene.meshes[1].triangles.clear();
    CHECK_THROWS_WITH_AS(save_glb(scene, folder / "a.glb"), doctest::Contains("mesh \"bare\""), Error);
    CHECK_FALSE(std::filesystem::exists(folder / "a.glb"));
}

TEST_CASE("a camera's path is an animation in the file: it is where its keys say, with their velocity") {
    const TemporaryFolder folder;
    Scene scene = scene_of_everything();
    scene.origin = {0, 0, 0};
    Camera& eye = scene.cameras[0];
    const Vec3d start = eye.scene_from_camera.translation;
    eye.path = {{0, start}, {2, start + Vec3d(0, 0, -3)}};
    save_glb(scene, folder / "walk.glb");
    GltfContents contents;
    const Scene back = load_gltf(folder / "walk.glb", {.time = 1}, &contents);
    REQUIRE(back.cameras.size() == 1);
    const Transform& placed = back.cameras[0].scene_from_camera;
    // Keys are in single precision; the rotation is one of doubles.
    CHECK(length(placed.translation + back.origin - (start + Vec3d(0, 0, -1.5))) < 1e-6);
    CHECK(length(placed.column_z - eye.scene_from_camera.column_z) < 1e-12);
    CHECK(length(back.cameras[0].velocity - Vec3d(0, 0, -1.5)) < 1e-5);
    REQUIRE(contents.animations.size() == 1);
    CHECK(contents.animations[0].duration == 2);
}

TEST_CASE("classes come back from the extras of nodes, and colours that bytes hold exactly come back exactly") {
    const TemporaryFolder folder;
    Scene scene = scene_of_everything();
    scene.instances[0].semantic = scene.instances[1].semantic = "building";
    scene.instances[2].semantic = "traffic sign";
    scene.instances[2].lamp = true;
    Mesh& bare = scene.meshes[1];
    bare.colors = {Rgb(0), {float(1) / 255, float(128) / 255, float(254) / 255}, Rgb(1)};
    save_glb(scene, folder / "classes.glb");
    const Scene back = load_gltf(folder / "classes.glb");
    REQUIRE(back.instances.size() == 3);
    for (const Instance& instance : back.instances) {
        CAPTURE(instance.name);
        CHECK(instance.semantic == (instance.name == "alone" ? "traffic sign" : "building"));
        CHECK(instance.lamp == (instance.name == "alone"));
    }
    for (const Mesh& mesh : back.meshes)
        if (mesh.name == "bare") CHECK(mesh.colors == bare.colors);
    // Objects of one class are counted.
    const std::string bytes = read_file(folder / "classes.glb");
    CHECK(bytes.find(R"("instance":1,"semantic":"building")") != std::string::npos);
    CHECK(bytes.find(R"("instance":0,"pluvia":{"lamp":true},"semantic":"traffic sign")") != std::string::npos);
}
