// Tangents for normal maps of meshes that bring none.
#pragma once

#include "renderer/scene/scene.h"

namespace pluvia {

/// Sets mesh.tangents from its normals and the texture coordinates of the normal map, as the maps are baked: along
/// growing u, averaged over the triangles around a vertex by their angle there. Vertices where mirrored and unmirrored
/// texture coordinates meet are doubled.
/// Source: Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited" (MikkTSpace), which glTF 2.0, 3.7.2.1 names;
/// its v points up, so the sign is turned.
void generate_tangents(Mesh& mesh, const std::vector<Vec2>& uvs);

}  // namespace pluvia
