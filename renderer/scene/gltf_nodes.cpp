#include "renderer/scene/gltf_nodes.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf_extras.h"

#include <fmt/format.h>

namespace pluvia {
namespace {

Transform transform_of(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        const auto& m = node.matrix;  // column-major
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    Transform t;
    if (node.scale.size() == 3) t = scale({node.scale[0], node.scale[1], node.scale[2]});
    if (node.rotation.size() == 4)
        t = rotate(node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]) * t;
    if (node.translation.size() == 3) t.translation = {node.translation[0], node.translation[1], node.translation[2]};
    return t;
}

// Far more than any file has; a chain of nodes is followed by recursion, which must not use up the stack.
constexpr int max_depth = 256;
constexpr size_t max_path_characters = 1 << 28;

class Walk {
public:
    Walk(const std::vector<tinygltf::Node>& nodes, const std::string& where) : nodes_(nodes), where_(where) {
        tree_.scene_from_node.resize(nodes.size());
        tree_.is_placed.resize(nodes.size());
    }

    /// parent_path: empty for a root. parent_labelled: as PlacedNode has it; of no use without a class. depth: number
    /// of nodes above.
    void walk(int index, const Transform& scene_from_parent, const std::string& parent_path, bool parent_is_lamp,
              const std::string& parent_semantic, size_t parent_labelled, int depth = 0) {
        if (index < 0 || index >= int(nodes_.size()))
            throw input_error(where_,
                              fmt::format("node does not exist (got {}, expected below {})", index, nodes_.size()));
        const tinygltf::Node& node = nodes_[index];
        const std::string name = node.name.empty() ? fmt::format("node_{}", index) : node.name;
        if (tree_.is_placed[index])
            throw input_error(where_, fmt::format("node {} is reached twice, from \"{}\" (expected a tree)", index,
                                                  parent_path.empty() ? "the scene" : parent_path));
        if (depth >= max_depth)
            throw input_error(where_, fmt::format("node {} lies too deep in the tree (expected at most {} levels)",
                                                  index, max_depth));
        tree_.is_placed[index] = true;
        const std::string path = parent_path.empty() ? name : parent_path + "/" + name;
        characters_ += path.size();
        if (characters_ > max_path_characters)
            throw input_error(where_,
                              fmt::format("its nodes' names are too long (got {} characters in the paths down to node "
                                          "{}, expected at most {})",
                                          characters_, index, max_path_characters));
        const Transform scene_from_node = scene_from_parent * transform_of(node);
        if (!is_finite(scene_from_node.translation) || !std::isfinite(scene_from_node.determinant()))
            throw input_error(fmt::format("{}: node \"{}\"", where_, path),
                              "its transform is not finite (expected numbers)");
        tree_.scene_from_node[index] = scene_from_node;
        const bool is_lamp = parent_is_lamp || is_marked_lamp(node.extras);
        const std::string own = semantic_class(node.extras), &semantic = own.empty() ? parent_semantic : own;
        const size_t labelled = own.empty() && !semantic.empty() ? parent_labelled : path.size();
        tree_.nodes.push_back({index, path, name, is_lamp, semantic, labelled});
        for (const int child : node.children) {
            walk(child, scene_from_node, path, is_lamp, semantic, labelled, depth + 1);
        }
    }
    NodeTree tree() && { return std::move(tree_); }

private:
    const std::vector<tinygltf::Node>& nodes_;
    const std::string& where_;
    NodeTree tree_;
    size_t characters_ = 0;
};

}  // namespace

NodeTree place_nodes(const std::vector<tinygltf::Node>& nodes, const std::vector<int>& roots,
                     const std::string& where) {
    Walk walk(nodes, where);
    for (const int root : roots) walk.walk(root, Transform(), "", false, "", 0);
    return std::move(walk).tree();
}

std::vector<Transform> place_again(const NodeTree& tree, const std::vector<tinygltf::Node>& nodes) {
    std::vector<Transform> placed(nodes.size());
    for (const PlacedNode& entry : tree.nodes) {  // a root's entry is still the identity, which its parent has
        const int node = entry.node;
        placed[node] = placed[node] * transform_of(nodes[node]);
        for (const int child : nodes[node].children) placed[child] = placed[node];
    }
    return placed;
}

}  // namespace pluvia
