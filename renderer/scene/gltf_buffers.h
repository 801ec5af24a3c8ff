// Buffers and encoded pictures of a glTF file: from its second chunk, from data URIs and from files beside it.
#pragma once

#include "renderer/scene/gltf_container.h"

#include <tiny_gltf.h>
#include <nlohmann/json_fwd.hpp>

#include <string>

namespace pluvia {

/// Where the files that a scene refers to may lie.
struct UriRules {
    std::string folder;          // of the scene, absolute
    bool allow_outside = false;  // absolute paths and paths that leave the folder
};

/// Fills model.buffers from the file's "buffers" array; takes file.binary. Throws Error (input) naming the buffer when
/// its bytes are missing or fewer than it says.
void read_buffers(const nlohmann::json& buffers, GltfFile& file, const UriRules& rules, const std::string& where,
                  tinygltf::Model& model);

/// Fills model.images from the file's "images" array: name, uri, mimeType and bufferView, and the encoded bytes in
/// `image` where they are not in a buffer view; empty where the picture's file cannot be read.
void read_image_sources(const nlohmann::json& images, const UriRules& rules, const std::string& where,
                        tinygltf::Model& model);

}  // namespace pluvia
