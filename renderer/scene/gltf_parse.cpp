#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include "renderer/scene/gltf_parse.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf_buffers.h"
#include "renderer/scene/gltf_container.h"
#include "renderer/scene/gltf_draco.h"
#include "renderer/scene/gltf_meshopt.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>

namespace pluvia {
namespace {

using Json = nlohmann::json;

constexpr std::array supported_extensions = {
    "EXT_mesh_gpu_instancing",    "EXT_meshopt_compression",
    "EXT_texture_webp",           "KHR_draco_mesh_compression",
    "KHR_lights_punctual",        "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",    "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",        "KHR_materials_specular",
    "KHR_materials_transmission", "KHR_materials_unlit",
    "KHR_materials_variants",     "KHR_materials_volume",
    "KHR_mesh_quantization",      "KHR_texture_transform",
    "MSFT_texture_dds",
};

// Each entry of these becomes a struct of up to some kilobytes, whatever its length in the file.
constexpr size_t max_entries = 100000;
constexpr size_t max_small_entries = 2000000;
constexpr std::array small_arrays = {"nodes", "meshes", "accessors", "bufferViews"};
constexpr std::array arrays = {"accessors", "animations", "buffers",  "bufferViews", "cameras", "images",  "materials",
                               "meshes",    "nodes",      "samplers", "scenes",      "skins",   "textures"};

void check_entries(const Json& root, const std::string& path) {
    if (!root.is_object()) throw input_error(path, "is not readable as glTF (its JSON is not an object)");
    for (const auto& [name, value] : root.items()) {
        if (!value.is_array() && std::find(arrays.begin(), arrays.end(), name) != arrays.end())
            throw input_error(path,
                              fmt::format("its {} are no list (got {}, expected [...])", name, value.type_name()));
        const bool is_small = std::find(small_arrays.begin(), small_arrays.end(), name) != small_arrays.end();
        const size_t limit = is_small ? max_small_entries : max_entries;
        if (value.is_array() && value.size() > limit)
            throw input_error(path, fmt::format("has too many {} (got {}, expected at most {})", name.substr(0, 40),
                                                value.size(), limit));
    }
}

void check_required(const Json& root, const std::string& path) {
    const auto required = root.find("extensionsRequired");
    if (required == root.end() || !required->is_array()) return;
    for (const Json& name : *required)
        if (name.is_string() && !is_supported_extension(name.get<std::string>()))
            throw input_error(
                path, fmt::format("requires an extension that is not supported (got {})", name.get<std::string>()));
}

Json take(Json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array()) return Json::array();
    Json value = std::move(*found);
    object.erase(found);
    return value;
}

// tinygltf refuses index accessors without a buffer view, which compressed primitives have. It sees the index as an
// extension of this name instead.
constexpr const char* hidden_indices = "indices";

template <class Action>
void for_each_primitive(Json& root, Action action) {
    if (!root.contains("meshes") || !root["meshes"].is_array()) return;
    for (Json& mesh : root["meshes"])
        if (mesh.is_object() && mesh.contains("primitives") && mesh["primitives"].is_array())
            for (Json& primitive : mesh["primitives"])
                if (primitive.is_object()) action(primitive);
}

void hide_indices(Json& root) {
    for_each_primitive(root, [](Json& primitive) {
        Json& extensions = primitive["extensions"];
        if (!extensions.is_object()) extensions = Json::object();
        extensions.erase(hidden_indices);
        const auto found = primitive.find("indices");
        if (found == primitive.end()) return;
        const bool is_index =
            found->is_number_integer() && found->get<int64_t>() >= 0 && found->get<int64_t>() < INT32_MAX;
        extensions[hidden_indices] = {{"accessor", is_index ? found->get<int>() : -2}};
        primitive.erase(found);
    });
}

void restore_indices(tinygltf::Model& model) {
    for (tinygltf::Mesh& mesh : model.meshes)
        for (tinygltf::Primitive& primitive : mesh.primitives) {
            const auto found = primitive.extensions.find(hidden_indices);
            if (found == primitive.extensions.end()) continue;
            primitive.indices = found->second.Get("accessor").GetNumberAsInt();
            primitive.extensions.erase(found);
        }
}

tinygltf::Model parse_structs(const std::string& json, const std::string& path, std::vector<std::string>& warnings) {
    tinygltf::TinyGLTF parser;
    tinygltf::Model model;
    std::string error, ignored;
    bool ok = false;
    try {
        ok = parser.LoadASCIIFromString(&model, &error, &ignored, json.data(), uint32_t(json.size()), "");
    } catch (const std::exception& e) {  // tinygltf's JSON library throws on some malformed files
        error = e.what();
    }
    error.erase(error.find_last_not_of('\n') + 1);
    std::replace(error.begin(), error.end(), '\n', ' ');
    if (!ok) throw input_error(path, fmt::format("is not readable as glTF ({})", error));
    if (!error.empty()) warnings.push_back(fmt::format("parts of the file are not understood ({})", error));
    return model;
}

}  // namespace

bool is_supported_extension(const std::string& name) {
    return std::find(supported_extensions.begin(), supported_extensions.end(), name) != supported_extensions.end();
}

tinygltf::Model parse_gltf(const std::string& path, const GltfSettings& settings, std::vector<std::string>& warnings) {
    GltfFile file = read_gltf_file(path);
    Json root;
    try {
        root = Json::parse(file.json);
    } catch (const std::exception& e) {
        const std::string text = e.what();  // after the library's own name for it, in brackets
        throw input_error(path, fmt::format("is not readable as glTF ({})", text.substr(text.find("] ") + 2)));
    }
    file.json = {};
    check_entries(root, path);
    // First of all: an extension such as a compression is why the rest does not make sense.
    check_required(root, path);
    // tinygltf would keep a second copy of every byte and take files from the folder that the program runs in.
    const Json buffers = take(root, "buffers"), images = take(root, "images");
    hide_indices(root);
    const std::string json = root.dump();
    if (json.size() > INT32_MAX)  // tinygltf takes 32-bit lengths
        throw input_error(path, fmt::format("has too much JSON (got {} bytes, expected less than 2 GiB)", json.size()));
    root = {};
    tinygltf::Model model = parse_structs(json, path, warnings);
    restore_indices(model);
    for (const std::string& used : model.extensionsUsed)
        if (used == "EXT_lights_image_based")
            warnings.push_back(
                "extension EXT_lights_image_based has no effect: it states its radiance in lux and leaves open how its "
                "pictures store it; light from pictures comes from --environment");
        else if (!is_supported_extension(used))
            warnings.push_back(fmt::format("extension {} is not supported and has no effect", used));

    const UriRules rules{std::filesystem::absolute(path).parent_path().string(), settings.allow_outside};
    read_buffers(buffers, file, rules, path, model);
    read_image_sources(images, rules, path, model);
    unpack_meshopt(model, path);
    unpack_draco(model, path);
    return model;
}

}  // namespace pluvia
