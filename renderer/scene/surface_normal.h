// Normals that shading sees: interpolated over a triangle and bent by normal maps.
#pragma once

#include "renderer/scene/triangle.h"

#include <optional>

namespace pluvia {

/// A triangle's place in the scene, as normals need it.
struct PlacedTriangle {
    const Triangle& triangle;
    const Transform& scene_from_object;
    Vec3 geometric_normal;  // unit, on the side that is seen
    bool mirrored;          // the transform turns the triangle's winding around
};

/// Unit, on the side of the geometric normal.
Vec3 smooth_normal(const PlacedTriangle& placed);

/// Unit tangent and bitangent at right angles to `normal`, of the side that is seen.
struct TangentFrame {
    Vec3 x, y;
};
/// As the mesh has it, or else along growing u and v of the slot's texture coordinates; empty without either.
std::optional<TangentFrame> tangent_frame(const PlacedTriangle& placed, Vec3 normal, const TextureSlot& slot);

/// `smooth` bent by a normal map; `smooth` itself where the slot is not used or finds no tangents.
Vec3 mapped_normal(const Scene& scene, const PlacedTriangle& placed, Vec3 smooth, const TextureSlot& slot, float scale,
                   Counters& counters);

/// Bends a normal that faces away from wo until it just faces it: there the material would show black.
Vec3 face(Vec3 normal, Vec3 wo);

}  // namespace pluvia
