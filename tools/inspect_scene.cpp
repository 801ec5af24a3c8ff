#include "tools/inspect_scene.h"

#include "renderer/scene/gltf.h"
#include "renderer/scene/lamps.h"
#include "tools/scene_memory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

double degrees(double radians) {
    return radians * 180 / std::numbers::pi;
}

double megabytes(size_t bytes) {
    return std::round(double(bytes) / 1e5) / 10;
}

/// What a render would activate: numbers of the parts that need it.
Json features(const Scene& scene) {
    Json j;
    int textured = 0, normal_mapped = 0, masked = 0, blended = 0, emissive = 0, colored = 0;
    int transmitting = 0, bodies = 0, coated = 0, sheen = 0, anisotropic = 0, unlit = 0;
    for (const Material& m : scene.materials) {
        bool any = false;
        Material::for_each_slot(m, [&](const TextureSlot& slot, const char*) { any = any || slot.used(); });
        textured += any;
        normal_mapped += m.normal_texture.used();
        masked += m.alpha_mode == AlphaMode::mask;
        blended += m.alpha_mode == AlphaMode::blend;
        emissive += m.emits();
        transmitting += m.transmission > 0, bodies += m.has_volume();
        coated += m.clearcoat > 0, sheen += !is_black(m.sheen_color), anisotropic += m.anisotropy > 0;
        unlit += m.unlit;
    }
    for (const Mesh& mesh : scene.meshes) colored += !mesh.colors.empty();
    j["textured_materials"] = textured, j["normal_mapped_materials"] = normal_mapped;
    j["alpha_masked_materials"] = masked, j["alpha_blended_materials"] = blended;
    j["emissive_materials"] = emissive, j["transmitting_materials"] = transmitting;
    j["volume_materials"] = bodies, j["clearcoat_materials"] = coated, j["sheen_materials"] = sheen;
    j["anisotropic_materials"] = anisotropic, j["unlit_materials"] = unlit;
    j["vertex_colored_meshes"] = colored;
    j["punctual_lights"] = scene.lights.size();
    j["lamps"] = lamp_count(scene);
    j["never_wet_materials"] =
        std::count_if(scene.materials.begin(), scene.materials.end(), [](const Material& m) { return !m.wet; });
    return j;
}

Json triangles(const Scene& scene) {
    size_t unique = 0, placed = 0, emissive = 0;
    for (const Mesh& mesh : scene.meshes) unique += mesh.triangles.size();
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        placed += mesh.triangles.size();
        if (scene.materials[mesh.material].emits()) emissive += mesh.triangles.size();
    }
    return {{"unique", unique}, {"with_instances", placed}, {"emissive", emissive}};
}

Json lights(const Scene& scene) {
    Json list = Json::array();
    for (const PunctualLight& light : scene.lights) {
        const bool is_directional = light.kind == PunctualLight::Kind::directional;
        Json entry = {{"name", light.name},
                      {"kind", is_directional                            ? "directional"
                               : light.kind == PunctualLight::Kind::spot ? "spot"
                                                                         : "point"}};
        entry[is_directional ? "lux" : "candela"] = {light.intensity.r, light.intensity.g, light.intensity.b};
        if (light.kind == PunctualLight::Kind::spot)
            entry["cone_degrees"] = {degrees(light.inner_cone_angle), degrees(light.outer_cone_angle)};
        list.push_back(entry);
    }
    return list;
}

Json cameras(const Scene& scene) {
    Json list = Json::array();
    for (const Camera& camera : scene.cameras) {
        const Vec3d p = camera.scene_from_camera.translation + scene.origin;
        list.push_back({{"name", camera.name},
                        {"vertical_fov_degrees", degrees(camera.vertical_fov)},
                        {"position_m", {p.x, p.y, p.z}}});
    }
    return list;
}

Json images(const Scene& scene) {
    std::vector<bool> used(scene.images.size());  // others are not decoded: gltf_texture.h
    for (const Material& m : scene.materials)
        Material::for_each_slot(m, [&](const TextureSlot& slot, const char*) {
            if (slot.used()) used[scene.textures[slot.texture].image] = true;
        });
    Json list = Json::array();
    for (size_t i = 0; i < scene.images.size(); ++i) {
        list.push_back({{"index", i}, {"used", bool(used[i])}});
        if (!used[i]) continue;
        list.back()["width"] = scene.images[i].width, list.back()["height"] = scene.images[i].height;
        list.back()["megabytes"] = megabytes(scene.images[i].pixels.size() * sizeof(Rgba8));
    }
    return list;
}

Json memory(const Scene& scene) {
    const SceneMemory m = estimate_memory(scene);
    return {{"geometry", megabytes(m.geometry)},
            {"textures", megabytes(m.textures)},
            {"hierarchy", megabytes(m.hierarchy)},
            {"program", megabytes(m.program)},
            {"total", megabytes(m.total())}};
}

}  // namespace

Json inspect_scene(const std::string& path, bool allow_outside) {
    GltfContents contents;
    const Scene scene = load_gltf(path, {.allow_outside = allow_outside}, &contents);
    Json j;
    j["scene"] = scene.name;
    j["nodes"] = contents.nodes, j["meshes"] = scene.meshes.size(), j["instances"] = scene.instances.size();
    j["triangles"] = triangles(scene);
    j["materials"] = scene.materials.size(), j["textures"] = scene.textures.size();
    if (const Bounds box = bounds(scene); !box.empty()) {
        const Vec3d lower = box.lower + scene.origin, upper = box.upper + scene.origin;
        j["bounds_m"] = {{lower.x, lower.y, lower.z}, {upper.x, upper.y, upper.z}};
    }
    j["images"] = images(scene);
    j["lights"] = lights(scene);
    j["cameras"] = cameras(scene);
    j["animations"] = Json::array();
    for (const auto& animation : contents.animations)
        j["animations"].push_back({{"name", animation.name}, {"seconds", animation.duration}});
    if (!contents.variants.empty()) j["variants"] = contents.variants;
    j["extensions"] = Json::array();
    for (const auto& extension : contents.extensions)
        j["extensions"].push_back({{"name", extension.name},
                                   {"required", extension.is_required},
                                   {"treatment", extension.is_read ? "read" : "warned, has no effect"}});
    j["requires"] = features(scene);
    j["memory_megabytes"] = memory(scene);
    if (!scene.warnings.empty()) j["warnings"] = scene.warnings;
    return j;
}

}  // namespace pluvia
