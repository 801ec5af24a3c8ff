// Morph targets and skins, applied to a mesh once, at the time of the frame.
#pragma once

#include "renderer/scene/scene.h"

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace pluvia {

/// Adds the primitive's morph targets, each times its weight, to positions, normals and tangents. Throws Error (input)
/// when a target's length differs from the mesh's.
void apply_morph_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                         const std::vector<double>& weights, const std::string& where, Mesh& mesh);

/// Moves every vertex by the mean of its joints' transforms, weighted by WEIGHTS_n. joints: to the mesh's new object
/// space from the bind pose. Throws Error (input) when a vertex names a joint that is not there.
void apply_skin(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                const std::vector<Transform>& joints, const std::string& where, Mesh& mesh);

/// Transforms of a skin's joints to `space` from the bind pose. scene_from_node, is_placed: by node.
/// Throws Error (input) naming skin and joint.
std::vector<Transform> skin_joints(const tinygltf::Model& model, int skin,
                                   const std::vector<Transform>& scene_from_node, const std::vector<bool>& is_placed,
                                   Vec3d space_origin, const std::string& where);

}  // namespace pluvia
