// How large the hierarchies of ray_scene.h become.
#pragma once

#include "renderer/scene/scene.h"

namespace pluvia {

/// Triangles that RayScene keeps: those of small meshes once per instance, those of large ones once.
size_t held_triangles(const Scene& scene);

}  // namespace pluvia
