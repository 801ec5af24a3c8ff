// The bytes of a .gltf or .glb file, taken apart and checked before anything is made of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pluvia {

struct GltfFile {
    std::string json;
    std::vector<unsigned char> binary;  // the second chunk of a .glb, may be empty
    bool has_binary = false;
};

/// Throws Error (input) when the file is missing, cut short, not what its extension says, larger than the length field
/// of a .glb can state (4 GiB), or nests values deeper than any real file.
GltfFile read_gltf_file(const std::string& path);

}  // namespace pluvia
