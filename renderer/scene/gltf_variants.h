// KHR_materials_variants: the looks that one file has for its meshes, of which a render shows one.
#pragma once

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace pluvia {

/// Names of the variants in the file's order; one without a name is "".
std::vector<std::string> variant_names(const tinygltf::Model& model);

/// Gives every primitive that has a material for the variant that material. Throws Error (usage) when the file has no
/// variant of this name. where: the file, for messages.
void choose_variant(tinygltf::Model& model, const std::string& name, const std::string& where);

}  // namespace pluvia
