// Scenes from and to glTF 2.0 files, .gltf and .glb. The tinygltf door is here and in the gltf_*.cpp files beside it.
// Read: core glTF with triangles, KHR_lights_punctual, KHR_materials_emissive_strength, _ior, _specular (factor) and
// _transmission (factor). Whatever else a file uses is named in Scene::warnings; what it requires is refused.
#pragma once

#include "renderer/scene/scene.h"

#include <string>

namespace pluvia {

/// Reads, checks and rebases a scene. Throws Error (input) naming the file and the node, accessor or image at fault.
Scene load_gltf(const std::string& path);

/// Writes a scene as one binary .glb with its pictures embedded as PNG; appears whole, by rename.
void save_glb(const Scene& scene, const std::string& path);

}  // namespace pluvia
