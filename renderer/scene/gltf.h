// Scenes from and to glTF 2.0 files, .gltf and .glb. The tinygltf door is here and in the gltf_*.cpp files beside it.
// Read: core glTF (animations, skins, morph targets and sparse accessors included; no lines or points) and the
// extensions listed in gltf_parse.cpp. Whatever else a file uses is named in Scene::warnings; what it requires is
// refused.
#pragma once

#include "renderer/scene/scene.h"

#include <string>
#include <vector>

namespace pluvia {

struct GltfSettings {
    double time = 0;                  // seconds at which animations are sampled
    double exposure_time = 1.0 / 60;  // seconds around it over which a camera's motion is measured
    std::string variant = "";         // of KHR_materials_variants; empty: the materials that meshes have without one
    bool allow_outside = false;       // files that lie outside of the scene's folder may be read
};

/// What a file says beside its scene, for reports.
struct GltfContents {
    struct Animation {
        std::string name;
        double duration = 0;  // seconds to its last key
    };
    struct Extension {
        std::string name;
        bool is_required = false, is_read = false;
    };
    int nodes = 0;
    std::vector<Animation> animations;
    std::vector<std::string> variants;  // of KHR_materials_variants
    std::vector<Extension> extensions;
};

/// Reads, checks and rebases a scene. An animated file's coordinates have the same origin at all times.
/// Throws Error (input) naming the file and the node, accessor or image at fault, and (usage) for an unknown variant.
Scene load_gltf(const std::string& path, const GltfSettings& settings = {}, GltfContents* contents = nullptr);

/// Writes a scene as one binary .glb with its pictures embedded as PNG; appears whole, by rename.
void save_glb(const Scene& scene, const std::string& path);

}  // namespace pluvia
