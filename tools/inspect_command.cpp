#include "renderer/core/error.h"
#include "renderer/image/exr.h"
#include "renderer/rain/drop_size.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/lamps.h"
#include "tools/commands.h"
#include "tools/frame_file.h"

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
    std::vector<double> rain;
    bool json = false;
};

/// What a renderer must be able to do for this scene.
Json features(const Scene& scene) {
    Json j;
    int textured = 0, normal_mapped = 0, masked = 0, blended = 0, emissive = 0, panes = 0, colored = 0;
    for (const Material& m : scene.materials) {
        bool any = false;
        Material::for_each_slot(m, [&](const TextureSlot& slot, const char*) { any = any || slot.used(); });
        textured += any;
        normal_mapped += m.normal_texture.used();
        masked += m.alpha_mode == AlphaMode::mask;
        blended += m.alpha_mode == AlphaMode::blend;
        emissive += m.emits();
        panes += m.transmission > 0;
    }
    for (const Mesh& mesh : scene.meshes) colored += !mesh.colors.empty();
    j["textured_materials"] = textured, j["normal_mapped_materials"] = normal_mapped;
    j["alpha_masked_materials"] = masked, j["alpha_blended_materials"] = blended;
    j["emissive_materials"] = emissive, j["transmitting_materials"] = panes;
    j["vertex_colored_meshes"] = colored;
    j["punctual_lights"] = scene.lights.size();
    j["lamps"] = lamp_count(scene);
    return j;
}

Json inspect_scene(const std::string& path) {
    const Scene scene = load_gltf(path);
    size_t unique = 0, placed = 0, texels = 0, emissive = 0;
    for (const Mesh& mesh : scene.meshes) unique += mesh.triangles.size();
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        placed += mesh.triangles.size();
        if (scene.materials[mesh.material].emits()) emissive += mesh.triangles.size();
    }
    for (const auto& image : scene.images) texels += image.pixels.size();
    Json j;
    j["scene"] = scene.name;
    j["meshes"] = scene.meshes.size(), j["instances"] = scene.instances.size();
    j["triangles"] = unique, j["triangles_with_instances"] = placed, j["emissive_triangles"] = emissive;
    j["materials"] = scene.materials.size(), j["images"] = scene.images.size(), j["texels"] = texels;
    if (const Bounds box = bounds(scene); !box.empty()) {
        const Vec3d lower = box.lower + scene.origin, upper = box.upper + scene.origin;
        j["bounds_m"] = {{lower.x, lower.y, lower.z}, {upper.x, upper.y, upper.z}};
    }
    for (const Camera& camera : scene.cameras) j["cameras"].push_back(camera.name);
    j["requires"] = features(scene);
    if (!scene.warnings.empty()) j["warnings"] = scene.warnings;
    return j;
}

Json inspect_exr(const std::string& path) {
    const ExrReader exr(path);
    Json j;
    j["width"] = exr.width(), j["height"] = exr.height();
    for (const ExrChannel& channel : exr.channels()) j["channels"].push_back(channel.name);
    for (const auto& [key, value] : exr.attributes()) {
        const bool is_object = key == "pluvia:settings" && std::holds_alternative<std::string>(value);
        if (is_object)
            j["attributes"][key] = Json::parse(std::get<std::string>(value), nullptr, false);
        else
            std::visit([&](const auto& v) { j["attributes"][key] = v; }, value);
    }
    return j;
}

/// Closed forms of the drop population, truncated to the diameters that Pluvia models.
Json drop_statistics(double intensity) {
    Json j;
    j["intensity_mm_per_h"] = intensity;
    j["drops_per_m3"] = number_density(intensity);
    j["extinction_per_m"] = extinction(intensity);
    j["volume_flux_mm_per_h"] = rain_rate(intensity) * 3.6e6;
    return j;
}

void print(const Json& j, const std::string& indent = "") {
    for (const auto& [key, value] : j.items()) {
        if (value.is_object()) {
            std::cout << indent << key << ":\n";
            print(value, indent + "  ");
        } else {
            std::cout << fmt::format("{}{:<26}{}\n", indent, key,
                                     value.is_string() ? value.get<std::string>() : json_text(value));
        }
    }
}

void inspect_command(const InspectOptions& options) {
    Json j;
    if (!options.input.empty())
        j = std::filesystem::path(options.input).extension() == ".exr" ? inspect_exr(options.input)
                                                                       : inspect_scene(options.input);
    for (const double intensity : options.rain) j["rain"][fmt::format("{:g}", intensity)] = drop_statistics(intensity);
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
    command->add_option("--rain", options->rain, "print the drop statistics of these intensities, mm/h")
        ->delimiter(',');
    command->add_flag("--json", options->json, "print as JSON");
    command->footer("Example:\n  pluvia inspect lane.glb\n  pluvia inspect --rain 10,100");
    command->callback([options] { inspect_command(*options); });
}

}  // namespace pluvia
