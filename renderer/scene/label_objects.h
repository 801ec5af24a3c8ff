// Objects: what labels count as one thing, made of the instances of a scene.
// An object is the nearest node above a mesh that has a class of its own in the file, else the mesh's node; rules of
// name patterns come before what the file says. Nodes of the same path are one object. Classes are in taxonomy.h.
#pragma once

#include "renderer/scene/scene.h"

#include <regex>
#include <string>
#include <vector>

namespace pluvia {

/// Gives a class to nodes whose path ("street/lamp_3") matches as a whole, and to all below them.
struct LabelRule {
    std::string pattern;  // as it was written
    std::regex path;
    int class_id = 0;
    std::string object = {};  // name of the object, "$1" being what the first group matched; empty: the node's path
};

struct LabelObject {
    std::string name;                // path of the node, or as a rule has it
    uint32_t id = 0;                 // hash of the name, never 0; different for different objects of a scene
    int class_id = 0;                // of the taxonomy
    int number = 0;                  // which one of its class it is, from 0, in the order of the scene's nodes
    std::string unknown_class = {};  // what the file calls it where the taxonomy lacks that; class_id is 0 then
};

struct SceneObjects {
    std::vector<LabelObject> objects;     // in the order in which they first appear in the scene
    std::vector<int> object_of_instance;  // index, one per instance of the scene
};

/// labelled_paths: per instance of the scene the path of the node that gave it its class, as GltfContents has them;
/// empty: that of each instance. The result depends on the nodes alone, not on time or camera.
SceneObjects label_objects(const Scene& scene, const std::vector<std::string>& labelled_paths,
                           const std::vector<LabelRule>& rules);

}  // namespace pluvia
