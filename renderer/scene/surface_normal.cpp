#include "renderer/scene/surface_normal.h"

namespace pluvia {
namespace {

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

}  // namespace

Vec3 smooth_normal(const PlacedTriangle& placed) {
    const Triangle& t = placed.triangle;
    if (t.mesh.normals.empty()) return placed.geometric_normal;
    Vec3 n = normalize(Vec3(placed.scene_from_object.normal(Vec3d(t.interpolate(t.mesh.normals)))));
    if (placed.mirrored) n = -n;
    if (!is_finite(n)) n = placed.geometric_normal;  // normals that cancel or are zero in the file
    return dot(n, placed.geometric_normal) < 0 ? -n : n;
}

std::optional<TangentFrame> tangent_frame(const PlacedTriangle& placed, Vec3 n, const TextureSlot& slot) {
    const Triangle& t = placed.triangle;
    const Transform& scene_from_object = placed.scene_from_object;
    if (t.mesh.tangents.empty() && t.uv_set(slot).empty()) return std::nullopt;
    const Vec3 p0 = t.mesh.positions[t.corner[0]];
    const Vec3 edge1 = t.mesh.positions[t.corner[1]] - p0, edge2 = t.mesh.positions[t.corner[2]] - p0;
    const Tangent tangent = t.mesh.tangents.empty() ? tangent_from_uvs(t, slot, edge1, edge2)
                                                    : Tangent{t.mesh.tangents[t.corner[0]].direction * t.b0 +
                                                                  t.mesh.tangents[t.corner[1]].direction * t.b1 +
                                                                  t.mesh.tangents[t.corner[2]].direction * t.b2,
                                                              t.mesh.tangents[t.corner[0]].sign};
    Vec3 x = Vec3(scene_from_object.vector(Vec3d(tangent.direction)));
    x = normalize(x - n * dot(x, n));
    if (!is_finite(x)) return std::nullopt;  // a triangle whose uv coordinates do not span it
    // The file's bitangent belongs to the front; n may have been turned to the back or mirrored.
    const Vec3 front = Vec3(scene_from_object.normal(Vec3d(cross(edge1, edge2))));
    const float side = dot(front, n) < 0 ? -1.0f : 1.0f;
    return TangentFrame{x, cross(n, x) * (tangent.sign * side)};
}

Vec3 mapped_normal(const Scene& scene, const PlacedTriangle& placed, Vec3 n, const TextureSlot& slot, float scale,
                   Counters& counters) {
    const Triangle& t = placed.triangle;
    if (!slot.used() || t.uv_set(slot).empty()) return n;
    counters.count(Feature::normal_map);
    const auto frame = tangent_frame(placed, n, slot);
    if (!frame) return n;
    const Vec3 stored = lookup_linear(scene, slot.texture, t.uv(slot));
    const float sx = (stored.x * 2 - 1) * scale, sy = (stored.y * 2 - 1) * scale;
    const Vec3 mapped = normalize(frame->x * sx + frame->y * sy + n * std::max(stored.z * 2 - 1, 1e-3f));
    return dot(mapped, placed.geometric_normal) > 0 ? mapped : n;
}

Vec3 face(Vec3 n, Vec3 wo) {
    constexpr float least_cosine = 0.01f;
    const float cosine = dot(n, wo);
    return cosine >= least_cosine ? n : normalize(n + wo * (least_cosine - cosine));
}

}  // namespace pluvia
