#include "renderer/scene/surface.h"

#include "renderer/scene/texture.h"

namespace pluvia {
namespace {

struct Triangle {
    const Mesh& mesh;
    const std::array<uint32_t, 3>& corner;
    float b0, b1, b2;

    Triangle(const Scene& scene, const SurfacePoint& point)
        : mesh(scene.meshes[scene.instances[point.instance].mesh]),
          corner(mesh.triangles[point.triangle]),
          b0(1 - point.b1 - point.b2),
          b1(point.b1),
          b2(point.b2) {}

    template <class T>
    T interpolate(const std::vector<T>& values) const {
        return values[corner[0]] * b0 + values[corner[1]] * b1 + values[corner[2]] * b2;
    }
    /// The zero vector where the mesh lacks the set.
    const std::vector<Vec2>& uv_set(const TextureSlot& slot) const { return slot.uv_set == 0 ? mesh.uvs : mesh.uvs1; }
    Vec2 uv(const TextureSlot& slot) const {
        const auto& set = uv_set(slot);
        const Vec2 uv = set.empty() ? Vec2() : interpolate(set);
        return slot.has_transform ? slot.transform(uv) : uv;
    }
};

/// Direction in which u grows over the triangle, in object space, and the handedness of the uv map.
/// Where a file brings no tangents this is what its normal maps were baked with, but for smoothing over vertices.
Tangent tangent_from_uvs(const Triangle& t, const TextureSlot& slot, Vec3 edge1, Vec3 edge2) {
    const auto& set = t.uv_set(slot);
    Vec2 a = set[t.corner[1]] - set[t.corner[0]], b = set[t.corner[2]] - set[t.corner[0]];
    if (slot.has_transform)
        a = slot.transform(a) - slot.transform.offset, b = slot.transform(b) - slot.transform.offset;
    const float determinant = a.x * b.y - a.y * b.x;
    const float sign = determinant < 0 ? -1.0f : 1.0f;
    return {(edge1 * b.y - edge2 * a.y) * sign, -sign};  // v points down in the picture, the bitangent up
}

/// Unit shading normal in the scene, on the side of the geometric normal.
Vec3 shading_normal(const Scene& scene, const Triangle& t, const Transform& scene_from_object, Vec3 geometric_normal,
                    bool mirrored, Counters& counters) {
    const Material& material = scene.materials[t.mesh.material];
    if (t.mesh.normals.empty() && !material.normal_texture.used()) return geometric_normal;
    Vec3 n = geometric_normal;
    if (!t.mesh.normals.empty()) {
        n = normalize(Vec3(scene_from_object.normal(Vec3d(t.interpolate(t.mesh.normals)))));
        if (mirrored) n = -n;
        if (!is_finite(n)) n = geometric_normal;  // normals that cancel or are zero in the file
        if (dot(n, geometric_normal) < 0) n = -n;
    }
    if (!material.normal_texture.used() || t.uv_set(material.normal_texture).empty()) return n;

    counters.count(Feature::normal_map);
    const Vec3 p0 = t.mesh.positions[t.corner[0]];
    const Tangent tangent =
        t.mesh.tangents.empty()
            ? tangent_from_uvs(t, material.normal_texture, t.mesh.positions[t.corner[1]] - p0,
                               t.mesh.positions[t.corner[2]] - p0)
            : Tangent{t.mesh.tangents[t.corner[0]].direction * t.b0 + t.mesh.tangents[t.corner[1]].direction * t.b1 +
                          t.mesh.tangents[t.corner[2]].direction * t.b2,
                      t.mesh.tangents[t.corner[0]].sign};
    Vec3 x = Vec3(scene_from_object.vector(Vec3d(tangent.direction)));
    x = normalize(x - n * dot(x, n));
    if (!is_finite(x)) return n;  // a triangle whose uv coordinates do not span it
    // The file's bitangent belongs to the front; n may have been turned to the back or mirrored.
    const Vec3 front = Vec3(
        scene_from_object.normal(Vec3d(cross(t.mesh.positions[t.corner[1]] - p0, t.mesh.positions[t.corner[2]] - p0))));
    const float side = dot(front, n) < 0 ? -1.0f : 1.0f;
    const Vec3 y = cross(n, x) * (tangent.sign * side);
    const Vec3 stored = lookup_linear(scene, material.normal_texture.texture, t.uv(material.normal_texture));
    const float sx = (stored.x * 2 - 1) * material.normal_scale, sy = (stored.y * 2 - 1) * material.normal_scale;
    const Vec3 mapped = normalize(x * sx + y * sy + n * std::max(stored.z * 2 - 1, 1e-3f));
    return dot(mapped, geometric_normal) > 0 ? mapped : n;
}

/// Bends a normal that faces away from wo until it just faces it: there the material would show black.
Vec3 face(Vec3 n, Vec3 wo) {
    constexpr float least_cosine = 0.01f;
    const float cosine = dot(n, wo);
    return cosine >= least_cosine ? n : normalize(n + wo * (least_cosine - cosine));
}

// What a slot holds at a point of a triangle; only for slots that are used.
Rgb slot_color(const Scene& scene, const TextureSlot& slot, const Triangle& t) {
    return lookup_color(scene, slot.texture, t.uv(slot));
}
Vec3 slot_linear(const Scene& scene, const TextureSlot& slot, const Triangle& t) {
    return lookup_linear(scene, slot.texture, t.uv(slot));
}
float slot_alpha(const Scene& scene, const TextureSlot& slot, const Triangle& t) {
    return lookup_alpha(scene, slot.texture, t.uv(slot));
}

Rgb base_color(const Scene& scene, const Material& material, const Triangle& t, Counters& counters) {
    Rgb color = material.base_color;
    if (material.base_color_texture.used()) {
        color *= slot_color(scene, material.base_color_texture, t);
        counters.count(Feature::texture);
    }
    if (!t.mesh.colors.empty()) {
        color *= t.interpolate(t.mesh.colors);
        counters.count(Feature::vertex_color);
    }
    // Files may hold factors above 1; a surface that reflects more than it receives would never let a path end.
    return {std::clamp(color.r, 0.0f, 1.0f), std::clamp(color.g, 0.0f, 1.0f), std::clamp(color.b, 0.0f, 1.0f)};
}

Rgb emission_at(const Scene& scene, const Material& material, const Triangle& t) {
    if (!material.emits()) return Rgb(0);
    return material.emission_texture.used() ? material.emission * slot_color(scene, material.emission_texture, t)
                                            : material.emission;
}

float transmission_at(const Scene& scene, const Material& material, const Triangle& t, float metallic,
                      Counters& counters) {
    if (material.transmission == 0) return 0;
    float transmission = material.transmission * (1 - metallic);
    if (material.transmission_texture.used()) {
        transmission *= slot_linear(scene, material.transmission_texture, t).x;
        counters.count(Feature::texture);
    }
    return transmission;
}

}  // namespace

Surface evaluate_surface(const Scene& scene, const SurfacePoint& point, Vec3 direction, float u, Counters& counters) {
    const Triangle t(scene, point);
    const Material& material = scene.materials[t.mesh.material];
    const Transform& scene_from_object = scene.instances[point.instance].scene_from_object;
    const Vec3 p0 = t.mesh.positions[t.corner[0]], p1 = t.mesh.positions[t.corner[1]],
               p2 = t.mesh.positions[t.corner[2]];

    Surface s;
    // In double: the transform may hold large translations that cancel.
    s.position = Vec3(scene_from_object.point(Vec3d(p0) * t.b0 + Vec3d(p1) * t.b1 + Vec3d(p2) * t.b2));
    s.geometric_normal = Vec3(normalize(scene_from_object.normal(cross(Vec3d(p1 - p0), Vec3d(p2 - p0)))));
    const bool mirrored = scene_from_object.determinant() < 0;  // then the winding of the front is reversed
    const bool from_front = (dot(s.geometric_normal, direction) < 0) != mirrored;
    if (dot(s.geometric_normal, direction) > 0) s.geometric_normal = -s.geometric_normal;
    s.shading_normal =
        face(shading_normal(scene, t, scene_from_object, s.geometric_normal, mirrored, counters), -direction);

    if (material.emits() && (from_front || material.double_sided)) {
        s.emission = emission_at(scene, material, t);
        counters.count(Feature::emissive_surface);
    }
    const Rgb color = base_color(scene, material, t, counters);
    float metallic = material.metallic, roughness = material.roughness;
    if (material.metallic_roughness_texture.used()) {
        const Vec3 stored = slot_linear(scene, material.metallic_roughness_texture, t);
        roughness *= stored.y;
        metallic *= stored.z;
        counters.count(Feature::texture);
    }
    if (u < transmission_at(scene, material, t, metallic, counters)) {
        counters.count(Feature::pane);
        s.bsdf = Pane{color, material.ior};
        return s;
    }
    MetallicRoughness m{color, metallic, roughness, material.specular, material.specular_color, material.ior};
    if (material.specular_texture.used()) {
        m.specular *= slot_alpha(scene, material.specular_texture, t);
        counters.count(Feature::texture);
    }
    if (material.specular_color_texture.used()) {
        m.specular_color *= slot_color(scene, material.specular_color_texture, t);
        counters.count(Feature::texture);
    }
    s.bsdf = m;
    return s;
}

float opacity(const Scene& scene, const SurfacePoint& point) {
    const Triangle t(scene, point);
    const Material& material = scene.materials[t.mesh.material];
    if (material.alpha_mode == AlphaMode::opaque) return 1;
    float alpha = material.alpha;
    if (material.base_color_texture.used()) alpha *= slot_alpha(scene, material.base_color_texture, t);
    if (!t.mesh.alphas.empty()) alpha *= t.interpolate(t.mesh.alphas);
    if (material.alpha_mode == AlphaMode::mask) return alpha < material.alpha_cutoff ? 0.0f : 1.0f;
    return std::clamp(alpha, 0.0f, 1.0f);
}

bool may_be_transparent(const Scene& scene, const Mesh& mesh) {
    const Material& m = scene.materials[mesh.material];
    if (m.alpha_mode == AlphaMode::opaque) return false;
    if (m.base_color_texture.used() || !mesh.alphas.empty()) return true;
    return m.alpha_mode == AlphaMode::mask ? m.alpha < m.alpha_cutoff : m.alpha < 1;
}

std::array<Vec3d, 3> corners(const Scene& scene, int instance, int triangle) {
    const Instance& i = scene.instances[instance];
    const Mesh& mesh = scene.meshes[i.mesh];
    std::array<Vec3d, 3> result;
    for (int k = 0; k < 3; ++k)
        result[k] = i.scene_from_object.point(Vec3d(mesh.positions[mesh.triangles[triangle][k]]));
    return result;
}

Vec3d front_normal(const Scene& scene, int instance, int triangle) {
    const auto corner = corners(scene, instance, triangle);
    const Vec3d normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
    return scene.instances[instance].scene_from_object.determinant() < 0 ? -normal : normal;
}

Rgb emission(const Scene& scene, const SurfacePoint& point) {
    const Triangle t(scene, point);
    return emission_at(scene, scene.materials[t.mesh.material], t);
}

}  // namespace pluvia
