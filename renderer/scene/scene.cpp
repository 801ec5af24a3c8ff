#include "renderer/scene/scene.h"

#include "renderer/core/error.h"
#include "renderer/core/random.h"

#include <fmt/format.h>

namespace pluvia {

uint32_t instance_id(const std::string& path) {
    uint64_t h = 0;
    for (const unsigned char c : path) h = hash_key(h, c);
    return std::max(uint32_t(1), uint32_t(h));
}

Bounds bounds(const Scene& scene) {
    Bounds box;
    for (const Instance& instance : scene.instances)
        for (const Vec3 p : scene.meshes[instance.mesh].positions) box.add(instance.scene_from_object.point(Vec3d(p)));
    return box;
}

void rebase(Scene& scene) {
    const Bounds box = bounds(scene);
    if (!box.empty()) rebase(scene, (box.lower + box.upper) * 0.5);
}

void rebase(Scene& scene, Vec3d centre) {
    for (Instance& instance : scene.instances) instance.scene_from_object.translation += -centre;
    for (PunctualLight& light : scene.lights) light.position += -centre;
    for (Camera& camera : scene.cameras) camera.scene_from_camera.translation += -centre;
    scene.origin += centre;
}

Camera framing_camera(const Scene& scene) {
    const Bounds box = bounds(scene);
    Camera camera;
    camera.name = "framing";
    if (box.empty()) return camera;
    // A little from above and aside, as one photographs a model; the whole bounding sphere fits into the height.
    const Vec3d centre = (box.lower + box.upper) * 0.5;
    const double radius = 0.5 * length(box.upper - box.lower);
    const Vec3d back = normalize(Vec3d(0.6, 0.35, 1.0));
    const Vec3d right = normalize(cross(Vec3d(0, 1, 0), back));
    const double distance = std::max(radius, 1e-3) / std::sin(camera.vertical_fov / 2);
    camera.scene_from_camera = {right, cross(back, right), back, centre + back * distance};
    return camera;
}

namespace {

void check_index(int index, size_t size, const std::string& where, const std::string& what) {
    if (index < -1 || index >= int(size))
        throw input_error(where, fmt::format("{} is out of range (got {}, expected below {})", what, index, size));
}

void check_mesh(const Scene& scene, const Mesh& mesh, const std::string& where) {
    const std::string mesh_where = fmt::format("{}: mesh \"{}\"", where, mesh.name);
    const auto check_size = [&](size_t size, const char* attribute) {
        if (size != 0 && size != mesh.positions.size())
            throw input_error(mesh_where, fmt::format("{} has the wrong length (got {}, expected {})", attribute, size,
                                                      mesh.positions.size()));
    };
    check_size(mesh.normals.size(), "NORMAL");
    check_size(mesh.uvs.size(), "TEXCOORD_0");
    check_size(mesh.uvs1.size(), "TEXCOORD_1");
    check_size(mesh.tangents.size(), "TANGENT");
    check_size(mesh.colors.size(), "COLOR_0");
    check_size(mesh.alphas.size(), "COLOR_0 alpha");
    for (const auto& triangle : mesh.triangles)
        for (const uint32_t vertex : triangle)
            if (vertex >= mesh.positions.size())
                throw input_error(mesh_where, fmt::format("a triangle refers to a vertex that is not there (got {}, "
                                                          "expected below {})",
                                                          vertex, mesh.positions.size()));
    for (const Vec3 p : mesh.positions)
        if (!is_finite(p)) throw input_error(mesh_where, "a vertex position is not finite (expected numbers)");
    if (mesh.material < 0) throw input_error(mesh_where, "has no material");
    check_index(mesh.material, scene.materials.size(), mesh_where, "material");
}

}  // namespace

void check(const Scene& scene, const std::string& where) {
    for (const Texture& texture : scene.textures) check_index(texture.image, scene.images.size(), where, "image");
    for (const Material& m : scene.materials)
        Material::for_each_slot(m, [&](const TextureSlot& slot, const char* name) {
            check_index(slot.texture, scene.textures.size(), fmt::format("{}: material \"{}\"", where, m.name), name);
        });
    for (const Mesh& mesh : scene.meshes) check_mesh(scene, mesh, where);
    for (const Instance& instance : scene.instances) {
        const std::string node_where = fmt::format("{}: node \"{}\"", where, instance.name);
        if (instance.mesh < 0) throw input_error(node_where, "has no mesh");
        check_index(instance.mesh, scene.meshes.size(), node_where, "mesh");
        const Transform& t = instance.scene_from_object;
        if (!is_finite(t.translation) || !std::isfinite(t.determinant()))
            throw input_error(node_where, "its transform is not finite (expected numbers)");
    }
}

}  // namespace pluvia
