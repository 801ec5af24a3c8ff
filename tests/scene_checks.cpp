#include "tests/scene_checks.h"

#include "renderer/scene/gltf.h"
#include "tests/temporary_folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace pluvia {

size_t placed_triangles(const Scene& scene) {
    size_t placed = 0;
    for (const Instance& instance : scene.instances) placed += scene.meshes[size_t(instance.mesh)].triangles.size();
    return placed;
}

void check_pictures(const Scene& scene) {
    std::vector<bool> used(scene.textures.size());
    for (const Material& m : scene.materials)
        Material::for_each_slot(m, [&](const TextureSlot& slot, const char*) {
            if (slot.used()) used.at(size_t(slot.texture)) = true;
        });
    CHECK(std::count(used.begin(), used.end(), false) == 0);
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        CAPTURE(scene.materials[i].name);
        CHECK(
            std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const Mesh& m) { return m.material == int(i); }));
    }
    for (const Texture& texture : scene.textures) {
        REQUIRE(texture.image >= 0);
        const Image<Rgba8>& image = scene.images.at(size_t(texture.image));
        CHECK(image.pixels.size() == size_t(image.width) * size_t(image.height));
        CHECK(image.width <= 1024);
    }
}

void check_vertices(const Scene& scene) {
    // Normals are sums and quotients of a dozen roundings of 6e-8.
    constexpr float unit_tolerance = 1e-5f;
    for (const Mesh& mesh : scene.meshes) {
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

void check_triangles(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
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

void check_cameras(const Scene& scene, const std::vector<std::string>& names) {
    std::vector<std::string> found;
    for (const Camera& camera : scene.cameras) {
        CAPTURE(camera.name);
        found.push_back(camera.name);
        // 30 to 50 mm on a picture 18 mm high.
        CHECK(camera.vertical_fov <= 2 * std::atan(9 / 29.999));
        CHECK(camera.vertical_fov >= 2 * std::atan(9 / 50.001));
        CHECK(camera.scene_from_camera.column_y.y > 0.9);
        REQUIRE(camera.path.size() >= 2);
        CHECK(length(camera.path.front().position - camera.scene_from_camera.translation) == 0);
        const double speed = length(camera.path.back().position - camera.path.front().position) /
                             double(camera.path.back().time - camera.path.front().time);
        CHECK(speed > 0.05);
        CHECK(speed < 2);  // one walks
    }
    CHECK(found == names);
}

void check_classes(const Scene& scene, const std::vector<std::string>& expected) {
    // Names of the Cityscapes classes (labels.py of cityscapesScripts) that a street without people may have.
    static const std::set<std::string> known = {
        "road",       "sidewalk", "building", "wall",    "fence",      "pole",   "traffic light", "traffic sign",
        "vegetation", "terrain",  "car",      "bicycle", "motorcycle", "static", "dynamic",       "ground"};
    std::map<std::string, int> count;
    std::map<uint32_t, std::string> class_of;
    for (const Instance& instance : scene.instances) {
        CAPTURE(instance.name);
        CHECK(known.count(instance.semantic) == 1);
        ++count[instance.semantic];
        const auto [entry, is_new] = class_of.try_emplace(instance.id, instance.semantic);
        CHECK(entry->second == instance.semantic);
    }
    for (const std::string& name : expected) {
        CAPTURE(name);
        CHECK(count[name] > 0);
    }
}

void check_lamps(const Scene& scene, size_t least, float brightest) {
    size_t lamps = 0;
    for (const Material& m : scene.materials) {
        CAPTURE(m.name);
        const float nits = luminance(m.emission);
        CHECK(nits <= brightest);
        if (m.emits()) CHECK(nits >= 1);
    }
    for (const Instance& i : scene.instances)
        lamps += scene.materials[size_t(scene.meshes[size_t(i.mesh)].material)].lamp;
    CHECK(lamps >= least);
}

void check_file(const Scene& scene, const Scene& again, double most_bytes) {
    const TemporaryFolder folder;
    save_glb(scene, folder / "a.glb");
    save_glb(again, folder / "b.glb");
    const std::string bytes = read_file(folder / "a.glb");
    CHECK(bytes == read_file(folder / "b.glb"));
    CHECK(double(bytes.size()) < most_bytes);

    const Scene back = load_gltf(folder / "a.glb");
    CHECK(back.warnings.empty());
    REQUIRE(back.meshes.size() == scene.meshes.size());
    std::map<std::string, const Mesh*> meshes_back;  // the loader numbers meshes as its nodes come
    for (const Mesh& mesh : back.meshes) meshes_back[mesh.name] = &mesh;
    for (const Mesh& a : scene.meshes) {
        CAPTURE(a.name);
        REQUIRE(meshes_back.count(a.name) == 1);
        const Mesh& b = *meshes_back[a.name];
        CHECK((a.positions == b.positions && a.normals == b.normals && a.uvs == b.uvs && a.colors == b.colors &&
               a.triangles == b.triangles && a.material == b.material));
    }
    REQUIRE(back.materials.size() >= scene.materials.size());  // the loader adds a default one
    for (size_t i = 0; i < scene.materials.size(); ++i) {
        const Material &a = scene.materials[i], &b = back.materials[i];
        const bool same = a.name == b.name && a.base_color == b.base_color && a.roughness == b.roughness &&
                          a.alpha_mode == b.alpha_mode && a.base_color_texture == b.base_color_texture;
        CHECK_MESSAGE(same, a.name);
        // Strength and colour are multiplied in single precision.
        CHECK(luminance(b.emission) == doctest::Approx(luminance(a.emission)).epsilon(1e-6).scale(1e-20));
    }
    REQUIRE(back.images.size() == scene.images.size());
    for (size_t i = 0; i < back.images.size(); ++i) CHECK(back.images[i].pixels == scene.images[i].pixels);
    CHECK(back.lights.size() == scene.lights.size());
    REQUIRE(back.cameras.size() == scene.cameras.size());
    for (size_t i = 0; i < back.cameras.size(); ++i) {
        CHECK(back.cameras[i].name == scene.cameras[i].name);
        CHECK(back.cameras[i].vertical_fov == scene.cameras[i].vertical_fov);
        // A moving camera's node holds its rotation as a quaternion, and its place in single precision.
        const Transform &a = scene.cameras[i].scene_from_camera, &b = back.cameras[i].scene_from_camera;
        CHECK(length(a.column_z - b.column_z) < 1e-12);
        CHECK(length(a.column_y - b.column_y) < 1e-12);
        CHECK(length(a.translation - (b.translation + back.origin)) < 1e-5);
    }
    REQUIRE(back.instances.size() == scene.instances.size());
    std::vector<std::tuple<uint32_t, std::string, std::string>> ids, ids_back;  // the file groups instances by path
    for (const Instance& i : scene.instances) ids.emplace_back(i.id, scene.meshes[i.mesh].name, i.semantic);
    for (const Instance& i : back.instances) ids_back.emplace_back(i.id, back.meshes[i.mesh].name, i.semantic);
    std::sort(ids.begin(), ids.end());
    std::sort(ids_back.begin(), ids_back.end());
    CHECK(ids == ids_back);
}

}  // namespace pluvia
