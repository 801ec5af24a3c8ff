#include "renderer/scene/surface.h"

#include "renderer/scene/surface_bsdf.h"
#include "renderer/scene/surface_normal.h"
#include "renderer/scene/triangle.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

Rgb emission_at(const Scene& scene, const Material& material, const Triangle& t) {
    if (!material.emits()) return Rgb(0);
    return material.emission_texture.used() ? material.emission * slot_color(scene, material.emission_texture, t)
                                            : material.emission;
}

/// The coat follows the surface, not the base's normal map; in the frame of the shading normal.
Vec3 coat_normal(const Scene& scene, const Material& material, const PlacedTriangle& placed, Vec3 smooth,
                 Vec3 shading_normal, Vec3 wo, Counters& counters) {
    if (!material.normal_texture.used() && !material.clearcoat_normal_texture.used()) return {0, 0, 1};
    const Vec3 n = mapped_normal(scene, placed, smooth, material.clearcoat_normal_texture,
                                 material.clearcoat_normal_scale, counters);
    return ShadingBasis(shading_normal).to_local(face(n, wo));
}

/// In the frame of the shading normal; none where the mesh has no tangents.
Anisotropy anisotropy_at(const Scene& scene, const Material& material, const PlacedTriangle& placed, Vec3 smooth,
                         Vec3 shading_normal, Counters& counters) {
    const auto frame = tangent_frame(placed, smooth, material.tangent_slot());
    if (!frame) return {};
    Anisotropy result{material.anisotropy, {1, 0}};
    Vec2 along = result.direction;
    if (material.anisotropy_texture.used()) {
        const Vec3 stored = slot_linear(scene, material.anisotropy_texture, placed.triangle);
        if (stored.x != 0.5f || stored.y != 0.5f) along = {2 * stored.x - 1, 2 * stored.y - 1};
        result.strength *= stored.z;
        counters.count(Feature::texture);
    }
    if (result.strength <= 0) return {};
    counters.count(Feature::anisotropy);
    const float c = std::cos(material.anisotropy_rotation), s = std::sin(material.anisotropy_rotation);
    const Vec3 direction = frame->x * (c * along.x - s * along.y) + frame->y * (s * along.x + c * along.y);
    const Vec3 local = ShadingBasis(shading_normal).to_local(direction);
    const float length = std::hypot(local.x, local.y);
    if (length > 0) result.direction = {local.x / length, local.y / length};
    return result;
}

// Scenes are larger than caches, and each of these is on its way while something else is computed.
void prefetch_corners(const Material& material, const Triangle& t) {
    t.prefetch(t.mesh.positions);
    t.prefetch(t.mesh.normals);
    t.prefetch(t.mesh.uvs);
    if (material.normal_texture.used()) t.prefetch(t.mesh.tangents);
}
void prefetch_textures(const Scene& scene, const Material& material, const Triangle& t) {
    for (const TextureSlot* slot :
         {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture})
        if (slot->used()) prefetch_texels(scene, slot->texture, t.uv(*slot));
}

}  // namespace

Surface evaluate_surface(const Scene& scene, const SurfacePoint& point, Vec3 direction, float u, Counters& counters) {
    const Triangle t(scene, point);
    const Material& material = scene.materials[t.mesh.material];
    prefetch_corners(material, t);
    const Transform& scene_from_object = scene.instances[point.instance].scene_from_object;
    const Vec3 p0 = t.mesh.positions[t.corner[0]], p1 = t.mesh.positions[t.corner[1]],
               p2 = t.mesh.positions[t.corner[2]];

    Surface s;
    // In double: the transform may hold large translations that cancel.
    s.position = Vec3(scene_from_object.point(Vec3d(p0) * t.b0 + Vec3d(p1) * t.b1 + Vec3d(p2) * t.b2));
    s.geometric_normal = Vec3(normalize(scene_from_object.normal(cross(Vec3d(p1 - p0), Vec3d(p2 - p0)))));
    const auto squared_length = [&](Vec3 edge) { return length_squared(scene_from_object.vector(Vec3d(edge))); };
    s.extent = float(std::sqrt(std::max({squared_length(p1 - p0), squared_length(p2 - p0), squared_length(p2 - p1)})));
    prefetch_textures(scene, material, t);
    const bool mirrored = scene_from_object.determinant() < 0;  // then the winding of the front is reversed
    s.from_front = (dot(s.geometric_normal, direction) < 0) != mirrored;
    if (dot(s.geometric_normal, direction) > 0) s.geometric_normal = -s.geometric_normal;
    const PlacedTriangle placed{t, scene_from_object, s.geometric_normal, mirrored};
    const Vec3 smooth = smooth_normal(placed);
    s.shading_normal = face(
        mapped_normal(scene, placed, smooth, material.normal_texture, material.normal_scale, counters), -direction);

    if (material.unlit) {
        s.emission = base_color(scene, material, t, counters) * scene.unlit_luminance;
        s.bsdf = Black();
        counters.count(Feature::unlit);
        return s;
    }
    if (material.emits() && (s.from_front || material.double_sided)) {
        s.emission = emission_at(scene, material, t);
        counters.count(Feature::emissive_surface);
    }
    s.bsdf = bsdf_at(scene, material, t, s.from_front, u, counters);
    if (auto* base = std::get_if<MetallicRoughness>(&s.bsdf); base && material.anisotropy > 0)
        base->anisotropy = anisotropy_at(scene, material, placed, smooth, s.shading_normal, counters);
    if (material.has_volume()) s.volume = t.mesh.material;
    if (material.is_layered())
        add_layers(scene, material, t,
                   coat_normal(scene, material, placed, smooth, s.shading_normal, -direction, counters), s.bsdf,
                   counters);
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

bool may_let_straight_through(const Material& m) {
    return m.transmission > 0 && !m.has_volume() && !m.unlit &&
           (m.roughness <= min_roughness || m.metallic_roughness_texture.used());
}

Rgb straight_transmittance(const Scene& scene, const SurfacePoint& point, const Surface& surface, Vec3 direction,
                           Counters& counters) {
    const auto* pane = std::get_if<Pane>(&surface.bsdf);
    if (!pane) return Rgb(0);
    const Triangle t(scene, point);
    const Vec3 wo = ShadingBasis(surface.shading_normal).to_local(-direction);
    return prepare(*pane, wo).transmittance * transmission_at(scene, scene.materials[t.mesh.material], t, counters);
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
