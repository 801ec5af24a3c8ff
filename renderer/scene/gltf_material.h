// Materials, textures and pictures of a glTF file.
#pragma once

#include "renderer/scene/scene.h"

#include <tiny_gltf.h>

namespace pluvia {

/// Fills Scene::images, textures and materials in the file's order, and adds a last material for triangles without
/// one (the specification's default). where: the file, for messages.
void read_materials(const tinygltf::Model& model, const std::string& where, Scene& scene, bool pictures = true);

}  // namespace pluvia
