#include "scenes/assembly.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pluvia {

int add_texture(Scene& scene, Image<Rgba8> image, Wrap wrap) {
    scene.images.push_back(std::move(image));
    scene.textures.push_back({.image = int(scene.images.size()) - 1, .wrap_u = wrap, .wrap_v = wrap});
    return int(scene.textures.size()) - 1;
}

MapTextures add_textures(Scene& scene, SurfaceMaps maps, Wrap wrap) {
    MapTextures textures;
    textures.base_color = add_texture(scene, std::move(maps.base_color), wrap);
    textures.metallic_roughness = add_texture(scene, std::move(maps.metallic_roughness), wrap);
    textures.normal = add_texture(scene, std::move(maps.normal), wrap);
    return textures;
}

int add_finish(Street& street, Material material, const MapTextures& textures, Vec2 picture_size) {
    const auto fill = [](TextureSlot& slot, int texture) {
        if (!slot.used()) slot = texture;
    };
    fill(material.base_color_texture, textures.base_color);
    fill(material.metallic_roughness_texture, textures.metallic_roughness);
    fill(material.normal_texture, textures.normal);
    street.scene.materials.push_back(std::move(material));
    street.finishes.push_back({int(street.scene.materials.size()) - 1, picture_size});
    return int(street.finishes.size()) - 1;
}

std::vector<int> add_meshes(Street& street, const std::string& name, const Assembly& assembly) {
    std::vector<int> meshes;
    for (const auto& [index, shape] : assembly.shapes) {
        if (shape.triangles.empty()) continue;
        const Finish& finish = street.finishes[size_t(index)];
        Mesh mesh;
        mesh.name = name + " " + street.scene.materials[size_t(finish.material)].name;
        mesh.positions = shape.positions;
        mesh.normals = shape.normals;
        // In steps that a byte holds, so that the file needs four bytes a vertex for them and not twelve.
        const auto stepped = [](float v) { return std::round(255 * std::clamp(v, 0.0f, 1.0f)) / 255; };
        for (const Rgb c : shape.colors) mesh.colors.push_back({stepped(c.r), stepped(c.g), stepped(c.b)});
        mesh.triangles = shape.triangles;
        mesh.material = finish.material;
        for (const Vec2 uv : shape.uvs)
            mesh.uvs.push_back({uv.x / finish.picture_size.x, uv.y / finish.picture_size.y});
        street.scene.meshes.push_back(std::move(mesh));
        meshes.push_back(int(street.scene.meshes.size()) - 1);
    }
    return meshes;
}

void place(Street& street, const std::string& path, const std::string& semantic, const std::vector<int>& meshes,
           const Transform& scene_from_object) {
    for (const int mesh : meshes)
        street.scene.instances.push_back({path, instance_id(path), mesh, scene_from_object, false, semantic});
}

void place_once(Street& street, const std::string& path, const std::string& semantic, const Assembly& assembly,
                const Transform& scene_from_object) {
    place(street, path, semantic, add_meshes(street, path.substr(path.rfind('/') + 1), assembly), scene_from_object);
}

void append(Assembly& assembly, const Assembly& part, const Transform& assembly_from_part) {
    for (const auto& [finish, shape] : part.shapes) append(assembly[finish], shape, assembly_from_part);
}

Camera look_at(const std::string& name, Vec3d position, Vec3d target, double focal_length_mm, Vec3d travel,
               float seconds) {
    const Vec3d back = normalize(position - target), right = normalize(cross(Vec3d(0, 1, 0), back));
    Camera camera = {name, {right, cross(back, right), back, position}, 2 * std::atan(9 / focal_length_mm), {}};
    if (seconds > 0) camera.path = {{0, position}, {seconds, position + travel}};
    return camera;
}

Transform rotate_y(double radians) {
    return rotate(0, std::sin(radians / 2), 0, std::cos(radians / 2));
}

}  // namespace pluvia
