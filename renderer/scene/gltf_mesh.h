// Primitives of a glTF file as meshes: strips and fans unrolled, morph targets and skins applied, tangents made where a
// normal map needs them.
#pragma once

#include "renderer/scene/scene.h"

#include <tiny_gltf.h>

#include <map>
#include <string>
#include <vector>

namespace pluvia {

/// Refuses files that ask for more memory than they can have any use for: a kilobyte must not become a gigabyte.
class MemoryBudget {
public:
    MemoryBudget(const tinygltf::Model& model, const std::string& where);
    /// Throws Error (input) when all that was spent exceeds what the file's size allows.
    void spend(size_t bytes);

private:
    const std::string& where_;
    size_t left_, allowed_;
};

/// What becomes of a mesh at its node.
struct Deformation {
    std::vector<double> weights;    // of the morph targets; missing ones are 0
    std::vector<Transform> joints;  // object space of the new mesh from the bind pose; empty = no skin
};

/// Reads the primitives of a mesh that are made of triangles, one Mesh each; others are named in scene.warnings.
/// Material indices become those of scene.materials, whose last is for primitives without one.
/// Throws Error (input) naming mesh, primitive and accessor.
std::vector<Mesh> read_mesh(const tinygltf::Model& model, int mesh, const Deformation& deformation,
                            const std::string& where, MemoryBudget& budget, Scene& scene);

}  // namespace pluvia
