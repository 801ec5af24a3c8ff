#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include "renderer/scene/gltf_parse.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace pluvia {
namespace {

constexpr std::array supported_extensions = {"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                             "KHR_materials_ior", "KHR_materials_specular",
                                             "KHR_materials_transmission"};

bool is_supported(const std::string& extension) {
    return std::find(supported_extensions.begin(), supported_extensions.end(), extension) != supported_extensions.end();
}

/// Without a look at extensions.
tinygltf::Model parse_file(const std::string& path) {
    tinygltf::TinyGLTF parser;
    // Pictures stay encoded; they are decoded with the others in gltf_material.cpp.
    parser.SetImageLoader(
        [](tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
           void*) {
            if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
            return true;
        },
        nullptr);
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        throw input_error(path, "is not a file (expected a .glb or .gltf)");
    tinygltf::Model model;
    std::string error, warning;
    const std::string extension = std::filesystem::path(path).extension().string();
    bool ok = false;
    try {
        if (extension == ".glb") ok = parser.LoadBinaryFromFile(&model, &error, &warning, path);
        else if (extension == ".gltf") ok = parser.LoadASCIIFromFile(&model, &error, &warning, path);
        else throw input_error(path, fmt::format("is not a glTF file (got \"{}\", expected .glb or .gltf)", extension));
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {  // tinygltf's JSON library throws on some malformed files
        throw input_error(path, fmt::format("is not readable as glTF ({})", e.what()));
    }
    if (!ok) {
        std::replace(error.begin(), error.end(), '\n', ' ');
        throw input_error(path, fmt::format("is not readable as glTF ({})", error));
    }
    return model;
}

}  // namespace

tinygltf::Model parse_gltf(const std::string& path, std::vector<std::string>& warnings) {
    tinygltf::Model model = parse_file(path);
    for (const std::string& extension : model.extensionsRequired)
        if (!is_supported(extension))
            throw input_error(path, fmt::format("requires an extension that is not supported (got {})", extension));
    for (const std::string& extension : model.extensionsUsed)
        if (!is_supported(extension))
            warnings.push_back(fmt::format("extension {} is not supported and has no effect", extension));
    return model;
}

}  // namespace pluvia
