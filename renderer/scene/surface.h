// Surface: all that light transport asks of the scene where a ray meets a triangle.
#pragma once

#include "renderer/core/counters.h"
#include "renderer/scene/scene.h"
#include "shaders/bsdf.h"

namespace pluvia {

/// A place on a triangle: which, and the barycentric weights of its second and third corner.
struct SurfacePoint {
    int instance = -1, triangle = -1;
    float b1 = 0, b2 = 0;
};

struct Surface {
    Vec3 position;
    Vec3 geometric_normal;   // unit, on the side that the ray came from
    Vec3 shading_normal;     // unit, interpolated and normal-mapped, turned so that the ray's side sees it
    float extent = 0;        // metres that the triangle's corners are away at most
    Rgb emission;            // cd/m2 towards the ray
    Bsdf bsdf;               // in the frame of ShadingBasis(shading_normal); glass as if air were around it
    bool from_front = true;  // whether the triangle's front is seen
    int volume = -1;         // material of the body whose surface this is, -1 = none; the body is behind the front
    int before = -1, behind = -1;  // materials of the bodies on the ray's side and beyond, -1 = air: set by the path
};

/// direction: of the ray that arrives, unit. u: uniform number that chooses between the sheets of which a partly
/// transmitting material is mixed.
Surface evaluate_surface(const Scene& scene, const SurfacePoint& point, Vec3 direction, float u, Counters& counters);

/// Share of light that the surface keeps from passing straight through: 1 for opaque materials, 0 or 1 for alpha masks.
float opacity(const Scene& scene, const SurfacePoint& point);

/// Whether opacity() can be below 1 anywhere on a mesh with this material.
bool may_be_transparent(const Scene& scene, const Mesh& mesh);

/// Whether straight_transmittance() can be above 0 anywhere on a mesh with this material: a thin pane that is smooth.
bool may_let_straight_through(const Material& material);

/// Share of the light along a ray that goes straight on through a surface which it meets; 0 but for smooth panes.
/// surface: as evaluate_surface() gives it with u = 0.
Rgb straight_transmittance(const Scene& scene, const SurfacePoint& point, const Surface& surface, Vec3 direction,
                           Counters& counters);

/// Corners of a triangle of an instance, in the scene's coordinates.
std::array<Vec3d, 3> corners(const Scene& scene, int instance, int triangle);

/// Normal of a triangle's front, as glTF defines it, with twice the triangle's area for length.
Vec3d front_normal(const Scene& scene, int instance, int triangle);

/// Emitted radiance at a point, cd/m2, of the front; the back of a double-sided material emits the same, any other
/// none.
Rgb emission(const Scene& scene, const SurfacePoint& point);

}  // namespace pluvia
