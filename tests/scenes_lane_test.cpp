// The lane is whole: sizes, attributes, measures of what is lit, the same every time, and its file holds all of it.
#include "renderer/scene/gltf.h"
#include "scenes/builders.h"
#include "tests/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

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

TEST_CASE("the lane has some tens of thousands of triangles and passes the scene's own check") {
    size_t placed = 0;
    for (const Instance& instance : lane().instances) placed += lane().meshes[instance.mesh].triangles.size();
    CAPTURE(placed);
    CHECK(placed >= 30000);
    CHECK(placed <= 150000);
    CHECK_NOTHROW(check(lane(), "lane"));
}

TEST_CASE("every picture of the lane is whole and used by a material, every material by a mesh") {
    std::vector<bool> used(lane().textures.size());
    for (const Material& m : lane().materials)
        Material::for_each_slot(m, [&](const TextureSlot& slot, const char*) {
            if (slot.used()) used.at(size_t(slot.texture)) = true;
        });
    CHECK(std::count(used.begin(), used.end(), false) == 0);
    for (size_t i = 0; i < lane().materials.size(); ++i) {
        CAPTURE(lane().materials[i].name);
        CHECK(std::any_of(lane().meshes.begin(), lane().meshes.end(),
                          [&](const Mesh& m) { return m.material == int(i); }));
    }
    for (const Texture& texture : lane().textures) {
        REQUIRE(texture.image >= 0);
        const Image<Rgba8>& image = lane().images.at(size_t(texture.image));
        CHECK(image.pixels.size() == size_t(image.width) * size_t(image.height));
        CHECK(image.width <= 1024);
    }
}

TEST_CASE("no vertex of the lane is out of order") {
    // Normals are sums and quotients of a dozen roundings of 6e-8.
    constexpr float unit_tolerance = 1e-5f;
    for (const Mesh& mesh : lane().meshes) {
        CAPTURE(mesh.name);
        REQUIRE(mesh.normals.size() == mesh.positions.size());
        REQUIRE(mesh.uvs.size() == mesh.positions.size());
        REQUIRE(mesh.colors.size() == mesh.positions.size());
        size_t bad_positions = 0, bad_normals = 0, bad_uvs = 0, bad_colors = 0;
        for (size_t i = 0; i < mesh.positions.size(); ++i) {
            bad_positions += !is_finite(mesh.positions[i]);
            bad_normals += !(std::abs(length(mesh.normals[i]) - 1) <= unit_tolerance);
            bad_uvs += !std::isfinite(mesh.uvs[i].x) || !std::isfinite(mesh.uvs[i].y);
            bad_colors += !is_finite(mesh.colors[i]) || max_component(mesh.colors[i]) > 1.2f;
        }
        CHECK(bad_positions == 0);
        CHECK(bad_normals == 0);
        CHECK(bad_uvs == 0);
        CHECK(bad_colors == 0);
    }
}

TEST_CASE("every triangle of the lane has an area, faces as its normals do, and spans its picture") {
    for (const Mesh& mesh : lane().meshes) {
        CAPTURE(mesh.name);
        size_t without_area = 0, turned = 0, without_uv = 0;
        for (const auto& [a, b, c] : mesh.triangles) {
            const Vec3 n = cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
            without_area += !(length(n) > 0);
            turned += !(dot(n, mesh.normals[a] + mesh.normals[b] + mesh.normals[c]) > 0);
            const Vec2 u = mesh.uvs[b] - mesh.uvs[a], v = mesh.uvs[c] - mesh.uvs[a];
            without_uv += u.x * v.y - u.y * v.x == 0;
        }
        CHECK(without_area == 0);
        CHECK(turned == 0);
        CHECK(without_uv == 0);
    }
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
    const TemporaryFolder folder;
    save_glb(lane(), folder / "a.glb");
    save_glb(build_lane(), folder / "b.glb");
    const std::string bytes = read_file(folder / "a.glb");
    CHECK(bytes == read_file(folder / "b.glb"));
    CHECK(bytes.size() < 25e6);

    const Scene back = load_gltf(folder / "a.glb");
    CHECK(back.warnings.empty());
    REQUIRE(back.meshes.size() == lane().meshes.size());
    std::map<std::string, const Mesh*> meshes_back;  // the loader numbers meshes as its nodes come
    for (const Mesh& mesh : back.meshes) meshes_back[mesh.name] = &mesh;
    for (const Mesh& a : lane().meshes) {
        CAPTURE(a.name);
        REQUIRE(meshes_back.count(a.name) == 1);
        const Mesh& b = *meshes_back[a.name];
        CHECK((a.positions == b.positions && a.normals == b.normals && a.uvs == b.uvs && a.colors == b.colors &&
               a.triangles == b.triangles && a.material == b.material));
    }
    REQUIRE(back.materials.size() >= lane().materials.size());  // the loader adds a default one
    for (size_t i = 0; i < lane().materials.size(); ++i) {
        const Material &a = lane().materials[i], &b = back.materials[i];
        const bool same = a.name == b.name && a.base_color == b.base_color && a.roughness == b.roughness &&
                          a.alpha_mode == b.alpha_mode && a.base_color_texture == b.base_color_texture;
        CHECK_MESSAGE(same, a.name);
        // Strength and colour are multiplied in single precision.
        CHECK(luminance(b.emission) == doctest::Approx(luminance(a.emission)).epsilon(1e-6));
    }
    REQUIRE(back.images.size() == lane().images.size());
    for (size_t i = 0; i < back.images.size(); ++i) CHECK(back.images[i].pixels == lane().images[i].pixels);
    CHECK(back.lights.size() == lane().lights.size());
    REQUIRE(back.cameras.size() == lane().cameras.size());
    for (size_t i = 0; i < back.cameras.size(); ++i) {
        CHECK(back.cameras[i].name == lane().cameras[i].name);
        CHECK(back.cameras[i].vertical_fov == lane().cameras[i].vertical_fov);
    }
    REQUIRE(back.instances.size() == lane().instances.size());
    std::vector<std::pair<uint32_t, std::string>> ids, ids_back;  // the file groups instances by path
    for (const Instance& i : lane().instances) ids.emplace_back(i.id, lane().meshes[i.mesh].name);
    for (const Instance& i : back.instances) ids_back.emplace_back(i.id, back.meshes[i.mesh].name);
    std::sort(ids.begin(), ids.end());
    std::sort(ids_back.begin(), ids_back.end());
    CHECK(ids == ids_back);
}
