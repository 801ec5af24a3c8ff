#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include "renderer/scene/gltf_parse.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>

namespace pluvia {
namespace {

constexpr std::array supported_extensions = {
    "EXT_texture_webp",       "KHR_lights_punctual",        "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_specular", "KHR_materials_transmission", "KHR_texture_transform",           "MSFT_texture_dds",
};

// tinygltf follows nested values by recursion, so that a hostile file could use up the stack. Real files nest some 10.
constexpr int max_nesting = 200;

bool is_supported(const std::string& extension) {
    return std::find(supported_extensions.begin(), supported_extensions.end(), extension) != supported_extensions.end();
}

std::string read_bytes(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw input_error(path, "is not a file (expected a .glb or .gltf)");
    const auto size = std::filesystem::file_size(path, error);
    // tinygltf takes 32-bit lengths, and so does the container format.
    if (error || size > std::numeric_limits<uint32_t>::max())
        throw input_error(path, fmt::format("is too large (got {} bytes, expected less than 4 GiB)", size));
    std::string bytes(size, '\0');
    std::ifstream file(path, std::ios::binary);
    if (!file.read(bytes.data(), std::streamsize(size))) throw input_error(path, "cannot be read");
    return bytes;
}

/// The JSON chunk of a .glb file whose chunks all lie inside it; tinygltf lets the second reach eight bytes further.
/// Source: glTF 2.0 specification, 4.4 "Binary glTF Layout".
std::string_view json_chunk(std::string_view file, const std::string& path) {
    const auto word = [&](uint64_t offset) {  // little-endian, as all machines that Embree runs on
        uint32_t value;
        std::memcpy(&value, file.data() + offset, sizeof value);
        return value;
    };
    if (!file.starts_with("glTF"))
        throw input_error(path, "is not a binary glTF file (expected \"glTF\" at its beginning)");
    if (file.size() < 20)
        throw input_error(path, fmt::format("is cut short (got {} bytes, expected at least 20)", file.size()));
    const uint32_t length = word(8), json_length = word(12);
    if (word(4) != 2) throw input_error(path, fmt::format("has an unknown version (got {}, expected 2)", word(4)));
    if (length > file.size())
        throw input_error(path, fmt::format("is cut short (got {} bytes, expected {})", file.size(), length));
    const uint64_t json_end = 20 + uint64_t(json_length);
    const bool has_more = json_end + 8 <= length;
    if (json_end > length || (has_more && json_end + 8 + word(json_end) > length))
        throw input_error(path, "has a chunk that reaches beyond its end");
    return file.substr(20, json_length);
}

void check_nesting(std::string_view json, const std::string& path) {
    int depth = 0;
    bool in_string = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_string && c == '\\')
            ++i;
        else if (c == '"')
            in_string = !in_string;
        else if (!in_string && (c == '{' || c == '['))
            ++depth;
        else if (!in_string && (c == '}' || c == ']'))
            --depth;
        if (depth > max_nesting)
            throw input_error(path, fmt::format("nests values too deeply (expected at most {} levels)", max_nesting));
    }
}

tinygltf::TinyGLTF make_parser() {
    tinygltf::TinyGLTF parser;
    // Pictures stay encoded; they are decoded with the others in gltf_material.cpp.
    parser.SetImageLoader(
        [](tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes,
           int size, void*) {
            if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
            return true;
        },
        nullptr);
    // tinygltf would look in the folder that the program runs in, too, and take a stranger's file of the same name.
    const auto exists_beside_scene = [](const std::string& file, void*) {
        std::error_code ignored;
        return file.starts_with('/') && std::filesystem::is_regular_file(file, ignored);
    };
    parser.SetFsCallbacks(
        {exists_beside_scene, &tinygltf::ExpandFilePath, &tinygltf::ReadWholeFile, &tinygltf::WriteWholeFile, nullptr});
    return parser;
}

/// tinygltf decodes data URIs of the formats that it knows and leaves other pictures empty.
void decode_data_uris(tinygltf::Model& model) {
    constexpr std::string_view marker = ";base64,";
    for (tinygltf::Image& image : model.images) {
        const size_t at = image.uri.find(marker);
        if (!image.image.empty() || !image.uri.starts_with("data:") || at == std::string::npos) continue;
        const std::string bytes = tinygltf::base64_decode(image.uri.substr(at + marker.size()));
        image.image.assign(bytes.begin(), bytes.end());
    }
}

}  // namespace

tinygltf::Model parse_gltf(const std::string& path, std::vector<std::string>& warnings) {
    const std::string extension = std::filesystem::path(path).extension().string();
    const bool is_binary = extension == ".glb";
    if (!is_binary && extension != ".gltf")
        throw input_error(path, fmt::format("is not a glTF file (got \"{}\", expected .glb or .gltf)", extension));
    const std::string bytes = read_bytes(path);
    check_nesting(is_binary ? json_chunk(bytes, path) : std::string_view(bytes), path);

    tinygltf::TinyGLTF parser = make_parser();
    const std::string folder = std::filesystem::absolute(path).parent_path().string();
    tinygltf::Model model;
    std::string error, ignored;
    bool ok = false;
    try {
        ok = is_binary
                 ? parser.LoadBinaryFromMemory(&model, &error, &ignored,
                                               reinterpret_cast<const unsigned char*>(bytes.data()),
                                               uint32_t(bytes.size()), folder)
                 : parser.LoadASCIIFromString(&model, &error, &ignored, bytes.data(), uint32_t(bytes.size()), folder);
    } catch (const std::exception& e) {  // tinygltf's JSON library throws on some malformed files
        error = e.what();
    }
    // First of all: an extension such as a compression is why the rest did not make sense.
    for (const std::string& required : model.extensionsRequired)
        if (!is_supported(required))
            throw input_error(path, fmt::format("requires an extension that is not supported (got {})", required));
    error.erase(error.find_last_not_of('\n') + 1);
    std::replace(error.begin(), error.end(), '\n', ' ');
    if (!ok) throw input_error(path, fmt::format("is not readable as glTF ({})", error));
    if (!error.empty()) warnings.push_back(fmt::format("parts of the file are not understood ({})", error));
    decode_data_uris(model);
    for (const std::string& used : model.extensionsUsed)
        if (!is_supported(used))
            warnings.push_back(fmt::format("extension {} is not supported and has no effect", used));
    return model;
}

}  // namespace pluvia
