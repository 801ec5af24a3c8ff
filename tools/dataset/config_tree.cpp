#include "tools/dataset/config_tree.h"

#include "renderer/core/error.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace pluvia {
namespace {

// An alias may repeat a tree that holds aliases itself, or the tree that it stands in.
constexpr int max_depth = 50;
constexpr size_t node_size = 32;  // a node counts as so many characters beside its text

/// Characters that all texts together may have. A node takes two in the file at least, so that what repeats nothing
/// stays below, and small files may repeat themselves some thousand times.
size_t max_size(size_t file_size) {
    return 100'000 + node_size * file_size;
}

ConfigNode converted(const YAML::Node& node, const std::string& path, int depth, size_t& left) {
    ConfigNode result;
    result.line = node.Mark().line + 1;
    const size_t size = node_size + (node.IsScalar() ? node.Scalar().size() : 0);
    if (depth > max_depth || size > left)
        throw usage_error(
            fmt::format("{}:{}", path, result.line),
            fmt::format("is nested too deep or repeats itself (expected at most {} levels and some thousand "
                        "repetitions)",
                        max_depth));
    left -= size;
    switch (node.Type()) {
        case YAML::NodeType::Scalar:
            result.kind = ConfigNode::Kind::scalar;
            result.text = node.Scalar();
            break;
        case YAML::NodeType::Sequence:
            result.kind = ConfigNode::Kind::list;
            result.items.reserve(node.size());
            for (const YAML::Node& item : node) result.items.push_back(converted(item, path, depth + 1, left));
            break;
        case YAML::NodeType::Map:
            result.kind = ConfigNode::Kind::map;
            for (const auto& entry : node) {
                const std::string key = entry.first.IsScalar() ? entry.first.Scalar() : "?";
                const int line = entry.first.Mark().line + 1;
                // The library keeps the first of two and is silent about the second.
                for (const ConfigEntry& before : result.entries)
                    if (before.key == key)
                        throw usage_error(fmt::format("{}:{}", path, line),
                                          fmt::format("the key \"{}\" is there already, on line {}", key, before.line));
                result.entries.push_back({key, line, converted(entry.second, path, depth + 1, left)});
            }
            break;
        default:
            break;
    }
    return result;
}

}  // namespace

ConfigNode read_config_tree(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw input_error(path, fmt::format("cannot be opened ({})", std::strerror(errno)));
    if (std::filesystem::is_directory(path)) throw input_error(path, "is a folder (expected a YAML file)");
    try {
        const std::string text(std::istreambuf_iterator<char>(file), {});
        size_t left = max_size(text.size());
        return converted(YAML::Load(text), path, 0, left);
    } catch (const YAML::Exception& e) {
        throw usage_error(fmt::format("{}:{}", path, e.mark.line + 1), fmt::format("is not YAML ({})", e.msg));
    }
}

}  // namespace pluvia
