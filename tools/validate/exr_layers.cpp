#include "tools/validate/exr_layers.h"

#include "renderer/core/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>

namespace pluvia {
namespace {

/// Channels that share what stands before the last point of their names, by what stands behind it.
using Group = std::map<std::string, std::string>;
using Groups = std::map<std::string, Group>;

Groups group_channels(std::span<const ExrChannel> channels) {
    Groups groups;
    for (const ExrChannel& channel : channels) {
        const size_t point = channel.name.rfind('.');
        const bool named = point != std::string::npos;
        groups[named ? channel.name.substr(0, point) : ""][named ? channel.name.substr(point + 1) : channel.name] =
            channel.name;
    }
    return groups;
}

std::optional<ExrLayer> triple(const std::string& name, const Group& group) {
    for (const auto& letters : {std::array{"R", "G", "B"}, {"r", "g", "b"}, {"X", "Y", "Z"}}) {
        ExrLayer layer{name, {}};
        for (const char* letter : letters)
            if (const auto found = group.find(letter); found != group.end()) layer.channels.push_back(found->second);
        if (layer.channels.size() == 3) return layer;
    }
    return std::nullopt;
}

ExrLayer single(const std::string& channel) {
    const auto is = [&](std::string_view end) { return channel == end || channel.ends_with("." + std::string(end)); };
    return {channel, {channel}, is("Z") || is("T") || channel.find("distance") == 0 || channel.find("rainy_Z") == 0};
}

std::optional<ExrLayer> layer_of(const std::string& name, const Group& group) {
    if (auto layer = triple(name, group)) return layer;
    if (!name.empty() && group.size() == 1) return single(group.begin()->second);
    return std::nullopt;
}

/// What Blender's compositor made of the view layers; only its full name asks for it.
bool is_composite(const std::string& name) {
    return name.starts_with("Composite.");
}

std::optional<ExrLayer> find_picture(const Groups& groups) {
    std::vector<ExrLayer> colors;
    for (const auto& [name, group] : groups)
        if (auto layer = triple(name, group)) colors.push_back(*layer);
    for (const char* name : {"background", "", "<root>"})
        for (const ExrLayer& layer : colors)
            if (layer.name == name) return layer;
    std::vector<ExrLayer> combined;
    for (const ExrLayer& layer : colors)
        if (layer.name == "Combined" || (layer.name.ends_with(".Combined") && !is_composite(layer.name)))
            combined.push_back(layer);
    if (combined.size() == 1) return combined[0];
    if (colors.size() == 1) return colors[0];
    if (groups.size() == 1 && groups.begin()->second.size() == 1) return single(groups.begin()->second.begin()->second);
    return std::nullopt;
}

std::vector<ExrLayer> find_named(const Groups& groups, const std::string& wanted) {
    std::vector<ExrLayer> found;
    for (const auto& [name, group] : groups) {
        for (const auto& [suffix, channel] : group)
            if (channel == wanted) return {single(channel)};
        if (name != wanted && (!name.ends_with("." + wanted) || is_composite(name))) continue;
        if (auto layer = layer_of(name, group)) found.push_back(*layer);
    }
    return found;
}

std::vector<ExrLayer> find_depth(const Groups& groups, bool along_axis) {
    std::vector<ExrLayer> found;
    for (const auto& [name, group] : groups)
        for (const auto& [suffix, channel] : group) {
            const bool is_z = channel == "Z" || (suffix == "Z" && (name == "Depth" || name.ends_with(".Depth")));
            const bool is_distance = channel == "distance.Y" || (suffix == "T" && group.size() == 1);
            if (along_axis ? is_z : is_distance) found.push_back(single(channel));
        }
    return found;
}

}  // namespace

ExrLayer find_layer(std::span<const ExrChannel> channels, const std::string& layer, const std::string& where) {
    const Groups groups = group_channels(channels);
    std::vector<ExrLayer> found = find_named(groups, layer);
    if (layer.empty()) {
        found.clear();
        if (const auto picture = find_picture(groups)) found.push_back(*picture);
    } else if (found.empty() && (layer == "depth" || layer == "distance")) {
        found = find_depth(groups, layer == "depth");
    }
    if (found.size() == 1) return found[0];
    std::vector<std::string> names;
    if (found.empty()) {
        for (const auto& [name, group] : groups) {
            if (!name.empty())
                names.push_back(name);
            else
                for (const auto& entry : group) names.push_back(entry.second);
        }
        throw input_error(where, fmt::format("has no {} (got {}; choose with --layer)",
                                             layer.empty() ? "picture that stands out" : "layer \"" + layer + '"',
                                             fmt::join(names, ", ")));
    }
    for (const ExrLayer& one : found) names.push_back(one.name);
    throw input_error(
        where, fmt::format("has several layers \"{}\" (got {}; name one in full)", layer, fmt::join(names, ", ")));
}

}  // namespace pluvia
