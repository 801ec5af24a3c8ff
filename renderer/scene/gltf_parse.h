// A glTF file as tinygltf's structs, pictures still encoded.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace pluvia {

/// Throws Error (input) when the file is not readable as glTF or requires an extension that is not supported; one that
/// is merely used is named in `warnings`.
tinygltf::Model parse_gltf(const std::string& path, std::vector<std::string>& warnings);

}  // namespace pluvia
