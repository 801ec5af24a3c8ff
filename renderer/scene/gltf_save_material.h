// Materials as glTF writes them: the counterpart of gltf_material.h.
#pragma once

#include "renderer/scene/material.h"

#include <tiny_gltf.h>

#include <functional>
#include <string>

namespace pluvia {

/// use_extension: called with the name of each extension that the entry carries.
tinygltf::Material gltf_material(const Material& material,
                                 const std::function<void(const std::string&)>& use_extension);

}  // namespace pluvia
