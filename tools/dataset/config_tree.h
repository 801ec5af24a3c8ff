// A YAML file as a tree of texts with the lines they stand on; the yaml-cpp door. What the keys mean is in config.h.
#pragma once

#include <string>
#include <vector>

namespace pluvia {

struct ConfigEntry;

struct ConfigNode {
    enum class Kind { none, scalar, list, map };

    Kind kind = Kind::none;
    int line = 0;  // of the file, from 1
    std::string text;
    std::vector<ConfigNode> items;     // of a list
    std::vector<ConfigEntry> entries;  // of a map, in the file's order; no key twice
};

struct ConfigEntry {
    std::string key;
    int line = 0;
    ConfigNode value;
};

/// Throws Error: input when the file cannot be read, usage with FILE:LINE when it is no YAML or has a key twice.
ConfigNode read_config_tree(const std::string& path);

}  // namespace pluvia
