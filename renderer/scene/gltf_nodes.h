// The node tree of a glTF file: where every node of the chosen scene is, composed in double precision.
#pragma once

#include "renderer/core/transform.h"

#include <tiny_gltf.h>

#include <string>
#include <vector>

namespace pluvia {

struct PlacedNode {
    int node;              // index in the file
    std::string path;      // names from the root down, e.g. "street/lamp_3"
    std::string name;      // the last of them
    bool is_lamp;          // marked as a lamp, or below a node that is
    std::string semantic;  // its class, or that of the nearest node above that has one
    size_t labelled;       // length of that node's path; of the whole path where no node has a class
};

struct NodeTree {
    std::vector<PlacedNode> nodes;           // parents before their children, siblings in the file's order
    std::vector<Transform> scene_from_node;  // by index in the file; of use for those in `nodes`
    std::vector<bool> is_placed;             // by index in the file
};

/// Throws Error (input) when the nodes do not form a tree, or one has a transform that is not finite.
NodeTree place_nodes(const std::vector<tinygltf::Node>& nodes, const std::vector<int>& roots, const std::string& where);

/// The transforms alone, for nodes that stand elsewhere at another time.
std::vector<Transform> place_again(const NodeTree& tree, const std::vector<tinygltf::Node>& nodes);

}  // namespace pluvia
