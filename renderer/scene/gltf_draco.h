// KHR_draco_mesh_compression: primitives whose vertices and indices are compressed. The Draco door.
#pragma once

#include <tiny_gltf.h>

#include <string>

namespace pluvia {

/// Decodes every compressed primitive and points it to accessors that hold what was inside.
/// Throws Error (input) naming mesh and primitive when the bytes are not valid or do not fit the file's accessors.
void unpack_draco(tinygltf::Model& model, const std::string& where);

}  // namespace pluvia
