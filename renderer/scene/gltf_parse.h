// A glTF file as tinygltf's structs, pictures still encoded.
#pragma once

#include "renderer/scene/gltf.h"

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace pluvia {

/// Throws Error (input) when the file is not readable as glTF or requires an extension that is not supported; one that
/// is merely used is named in `warnings`. Compressed buffer views and primitives come back unpacked.
tinygltf::Model parse_gltf(const std::string& path, const GltfSettings& settings, std::vector<std::string>& warnings);

/// Whether an extension is read, at least in part.
bool is_supported_extension(const std::string& name);

}  // namespace pluvia
