#include "renderer/core/error.h"
#include "renderer/image/exr.h"
#include "tools/commands.h"
#include "tools/frame_file.h"
#include "tools/inspect_scene.h"
#include "tools/rain_inspection.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <iostream>
#include <variant>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

struct InspectOptions {
    std::string input;
    RainInspectionOptions rain;
    bool json = false, allow_outside = false;
};

Json inspect_exr(const std::string& path) {
    const ExrReader exr(path);
    Json j;
    j["width"] = exr.width(), j["height"] = exr.height();
    for (const ExrChannel& channel : exr.channels()) j["channels"].push_back(channel.name);
    for (const auto& [key, value] : exr.attributes()) {
        Json& entry = j["attributes"][key];
        const bool is_object = key == "pluvia:settings" && std::holds_alternative<std::string>(value);
        if (is_object)
            entry = Json::parse(std::get<std::string>(value), nullptr, false);
        else
            std::visit([&](const auto& v) { entry = v; }, value);
    }
    return j;
}

/// An entry of a list on one line: its first value, then the others with their names.
std::string line(const Json& entry) {
    if (entry.is_string()) return entry.get<std::string>();
    std::string text;
    for (const auto& [key, value] : entry.items()) {
        const std::string shown = value.is_string() ? value.get<std::string>() : json_text(value);
        text += text.empty() ? fmt::format("{:<24}", shown) : fmt::format("  {} {}", key, shown);
    }
    return text;
}

void print(const Json& j, const std::string& indent = "") {
    for (const auto& [key, value] : j.items()) {
        if (value.is_object()) {
            std::cout << indent << key << ":\n";
            print(value, indent + "  ");
        } else if (value.is_array() && !value.empty() && (value[0].is_object() || value[0].is_string())) {
            std::cout << indent << key << ":\n";
            for (const Json& entry : value) std::cout << indent << "  " << line(entry) << "\n";
        } else {
            std::cout << fmt::format("{}{:<26}{}\n", indent, key,
                                     value.is_string() ? value.get<std::string>() : json_text(value));
        }
    }
}

void inspect_command(const InspectOptions& options) {
    Json j;
    if (!options.input.empty())
        j = std::filesystem::path(options.input).extension() == ".exr"
                ? inspect_exr(options.input)
                : inspect_scene(options.input, options.allow_outside);
    if (!options.rain.intensities.empty()) j["rain"] = inspect_rain(options.rain);
    if (j.empty()) throw usage_error("inspect", "has nothing to look at (expected a scene, an .exr file or --rain)");
    if (options.json)
        std::cout << json_text(j, 2) << "\n";
    else
        print(j);
}

}  // namespace

void add_inspect_command(CLI::App& app) {
    auto* command =
        app.add_subcommand("inspect", "what a scene contains and requires, the channels of an EXR, rain in numbers");
    auto options = std::make_shared<InspectOptions>();
    command->add_option("input", options->input, "scene (.glb, .gltf) or picture (.exr)");
    add_rain_inspection_options(*command, options->rain);
    command->add_flag("--json", options->json, "print as JSON");
    command->add_flag("--allow-outside", options->allow_outside,
                      "read files that the scene names outside of its folder");
    command->footer("Example:\n  pluvia inspect lane.glb\n  pluvia inspect --rain 10,100");
    command->callback([options] { inspect_command(*options); });
}

}  // namespace pluvia
