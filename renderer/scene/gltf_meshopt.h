// EXT_meshopt_compression: buffer views whose bytes are compressed. The meshoptimizer door.
#pragma once

#include <tiny_gltf.h>

#include <string>

namespace pluvia {

/// Decodes every compressed buffer view into a buffer of its own and points the view there.
/// Throws Error (input) naming the view when its description or its bytes are not valid.
void unpack_meshopt(tinygltf::Model& model, const std::string& where);

}  // namespace pluvia
