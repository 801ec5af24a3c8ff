// A point on a triangle of the scene: its mesh, attributes interpolated there, and what texture slots hold there.
// Used by surface.h and its parts.
#pragma once

#include "renderer/scene/surface.h"
#include "renderer/scene/texture.h"

namespace pluvia {

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
    /// Asks for values of interpolate() that are to come.
    template <class T>
    void prefetch(const std::vector<T>& values) const {
        if (values.empty()) return;
        for (const uint32_t i : corner) __builtin_prefetch(&values[i]);
    }
    /// The zero vector where the mesh lacks the set.
    const std::vector<Vec2>& uv_set(const TextureSlot& slot) const { return slot.uv_set == 0 ? mesh.uvs : mesh.uvs1; }
    Vec2 uv(const TextureSlot& slot) const {
        const auto& set = uv_set(slot);
        const Vec2 uv = set.empty() ? Vec2() : interpolate(set);
        return slot.has_transform ? slot.transform(uv) : uv;
    }
};

// What a slot holds at a point of a triangle; only for slots that are used.
inline Rgb slot_color(const Scene& scene, const TextureSlot& slot, const Triangle& t) {
    return lookup_color(scene, slot.texture, t.uv(slot));
}
inline Vec3 slot_linear(const Scene& scene, const TextureSlot& slot, const Triangle& t) {
    return lookup_linear(scene, slot.texture, t.uv(slot));
}
inline float slot_alpha(const Scene& scene, const TextureSlot& slot, const Triangle& t) {
    return lookup_alpha(scene, slot.texture, t.uv(slot));
}

}  // namespace pluvia
