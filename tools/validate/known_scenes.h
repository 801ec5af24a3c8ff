// Small scenes built in code, of which it is known how their light must be.
#pragma once

#include "renderer/core/view.h"
#include "renderer/scene/scene.h"

namespace pluvia {

/// A Lambert surface and nothing else.
Material lambert(Rgb albedo);
/// A surface that only emits, in cd/m2.
Material emitter(Rgb radiance);

/// Each adds one mesh and one instance, and returns the index of the instance.
int add_quad(Scene& scene, Vec3 corner, Vec3 edge_u, Vec3 edge_v, const Material& material);  // faces cross(u, v)
int add_box(Scene& scene, Vec3 lower, Vec3 upper, const Material& material);
/// Vertices on the sphere: the polyhedron is a little smaller than the sphere.
int add_sphere(Scene& scene, Vec3 centre, float radius, int segments, const Material& material);

/// A large plane y = 0 around the origin that faces up.
Scene make_plane(const Material& material);

/// Ground, two walls and a box that light each other, all of one material; seen by court_view().
Scene make_court(const Material& material);
View court_view(int width, int height);

/// A pinhole view of one pixel per degree or so: from `eye` towards `target`.
View look_at(Vec3d eye, Vec3d target, int width, int height, double focal_pixels);

}  // namespace pluvia
