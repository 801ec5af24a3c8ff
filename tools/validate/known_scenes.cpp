#include "tools/validate/known_scenes.h"

#include <cmath>

namespace pluvia {
namespace {

int add_mesh(Scene& scene, Mesh mesh, const Material& material) {
    mesh.material = int(scene.materials.size());
    scene.materials.push_back(material);
    scene.meshes.push_back(std::move(mesh));
    Instance instance;
    instance.mesh = int(scene.meshes.size()) - 1;
    instance.name = "part_" + std::to_string(instance.mesh);
    instance.id = instance_id(instance.name);
    scene.instances.push_back(instance);
    return int(scene.instances.size()) - 1;
}

}  // namespace

Material lambert(Rgb albedo) {
    Material m;
    m.base_color = albedo;
    m.metallic = m.specular = 0;
    return m;
}

Material emitter(Rgb radiance) {
    Material m = lambert(Rgb(0));
    m.emission = radiance;
    return m;
}

int add_quad(Scene& scene, Vec3 corner, Vec3 u, Vec3 v, const Material& material) {
    Mesh mesh;
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return add_mesh(scene, mesh, material);
}

int add_box(Scene& scene, Vec3 a, Vec3 b, const Material& material) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z);
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return add_mesh(scene, mesh, material);
}

int add_sphere(Scene& scene, Vec3 centre, float radius, int segments, const Material& material) {
    Mesh mesh;
    const int rings = segments / 2;
    for (int i = 0; i <= rings; ++i)
        for (int k = 0; k < segments; ++k) {
            const float theta = pi * float(i) / float(rings), phi = 2 * pi * float(k) / float(segments);
            mesh.positions.push_back(
                centre +
                Vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)) * radius);
        }
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < segments; ++k) {
            const uint32_t next = uint32_t((k + 1) % segments);
            const uint32_t a = uint32_t(i * segments) + uint32_t(k), b = uint32_t(i * segments) + next;
            const uint32_t c = a + uint32_t(segments), d = b + uint32_t(segments);
            if (i > 0) mesh.triangles.push_back({a, b, d});
            if (i < rings - 1) mesh.triangles.push_back({a, d, c});
        }
    return add_mesh(scene, mesh, material);
}

Scene make_plane(const Material& material) {
    Scene scene;
    add_quad(scene, {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, material);
    return scene;
}

Scene make_court(const Material& material) {
    Scene scene;
    add_quad(scene, {-6, 0, 4}, {12, 0, 0}, {0, 0, -12}, material);
    add_quad(scene, {-6, 0, -8}, {12, 0, 0}, {0, 5, 0}, material);
    add_quad(scene, {6, 0, 4}, {0, 0, -12}, {0, 5, 0}, material);
    add_box(scene, {-3, 0, -5}, {-1, 2, -3}, material);
    return scene;
}

View look_at(Vec3d eye, Vec3d target, int width, int height, double focal_pixels) {
    View view;
    view.width = width, view.height = height, view.focal_pixels = focal_pixels;
    view.position = eye;
    view.back = normalize(eye - target);
    const Vec3d up = std::abs(view.back.y) > 0.99 ? Vec3d(0, 0, -1) : Vec3d(0, 1, 0);
    view.right = normalize(cross(up, view.back));
    view.up = cross(view.back, view.right);
    return view;
}

View court_view(int width, int height) {
    return look_at({1, 1.6, 3.5}, {0, 1.4, -4}, width, height, 1.2 * width);
}

}  // namespace pluvia
