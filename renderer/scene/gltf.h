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
    bool pictures = true;             // false: of textures only the size of one texel, for who asks where things are
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
    /// Of Scene::instances: path of the nearest node that states a class, else the instance's own. A copy of
    /// EXT_mesh_gpu_instancing has its own.
    std::vector<std::string> labelled_paths;
};

/// Reads, checks and rebases a scene. An animated file's coordinates have the same origin at all times.
/// Throws Error (input) naming the file and the node, accessor or image at fault, and (usage) for an unknown variant.
Scene load_gltf(const std::string& path, const GltfSettings& settings = {}, GltfContents* contents = nullptr);

/// How a node moves: straight and turning evenly from key to key, at rest before the first and after the last. Lights
/// whose names go on from its path ("street/car_1/lamp") go with it.
struct NodeMotion {
    std::string path;          // of the instances that move, or the name of a camera that does
    std::string object;        // path of a node above, which gets their class: all that moves below it is one object;
                               // empty: the node itself is one
    std::vector<float> times;  // seconds, rising
    std::vector<Transform> scene_from_object;  // rigid, one per time; instances are where the first has them
};

/// Writes a scene as one binary .glb with its pictures embedded as PNG; appears whole, by rename.
void save_glb(const Scene& scene, const std::string& path, const std::vector<NodeMotion>& motions = {});

}  // namespace pluvia
