// Materials, textures and pictures of a glTF file.
#pragma once

#include "renderer/scene/scene.h"

#include <tiny_gltf.h>

namespace pluvia {

/// Fills Scene::images, textures and materials in the file's order, and adds a last material for triangles without
/// one (the specification's default). folder: where the file lies, for pictures beside it.
void read_materials(const tinygltf::Model& model, const std::string& where, const std::string& folder, Scene& scene);

}  // namespace pluvia
