#include "renderer/scene/gltf_container.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string_view>

namespace pluvia {
namespace {

// Nested values are followed by recursion, so that a hostile file could use up the stack. Real files nest some 10.
constexpr int max_nesting = 200;

/// An open file and its size, read front to back.
class Source {
public:
    explicit Source(const std::string& path) : path_(path) {
        std::error_code error;
        if (!std::filesystem::is_regular_file(path, error))
            throw input_error(path, "is not a file (expected a .glb or .gltf)");
        size_ = std::filesystem::file_size(path, error);
        file_.open(path, std::ios::binary);
        if (error || !file_) throw input_error(path, "cannot be read");
    }
    uint64_t size() const { return size_; }

    template <class Bytes>
    Bytes read(uint64_t count) {
        Bytes bytes(count, 0);
        if (!file_.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(count)))
            throw input_error(path_, "cannot be read");
        return bytes;
    }
    uint32_t read_word() {  // little-endian, as all machines that Embree runs on
        const auto bytes = read<std::string>(4);
        uint32_t value;
        std::memcpy(&value, bytes.data(), sizeof value);
        return value;
    }

private:
    const std::string& path_;
    std::ifstream file_;
    uint64_t size_ = 0;
};

/// Source: glTF 2.0 specification, 4.4 "Binary glTF Layout".
GltfFile read_glb(Source& source, const std::string& path) {
    if (source.size() < 20)
        throw input_error(path, fmt::format("is cut short (got {} bytes, expected at least 20)", source.size()));
    if (source.read<std::string>(4) != "glTF")
        throw input_error(path, "is not a binary glTF file (expected \"glTF\" at its beginning)");
    if (const uint32_t version = source.read_word(); version != 2)
        throw input_error(path, fmt::format("has an unknown version (got {}, expected 2)", version));
    const uint64_t length = source.read_word();
    if (source.size() > std::numeric_limits<uint32_t>::max())
        throw input_error(path, fmt::format("is too large (got {} bytes, a .glb holds less than 4 GiB; expected its "
                                            "buffers in files of their own)",
                                            source.size()));
    if (length > source.size())
        throw input_error(path, fmt::format("is cut short (got {} bytes, expected {})", source.size(), length));
    GltfFile file;
    const uint64_t json_length = source.read_word();
    const bool is_json = source.read<std::string>(4) == "JSON";
    if (!is_json) throw input_error(path, "does not begin with a chunk of JSON");
    if (20 + json_length > length)
        throw input_error(path, fmt::format("has a chunk that reaches beyond its end (got {} bytes at 20, expected {} "
                                            "bytes in all)",
                                            json_length, length));
    file.json = source.read<std::string>(json_length);
    if (20 + json_length + 8 > length) return file;
    const uint64_t binary_length = source.read_word();
    const bool is_binary = source.read<std::string>(4) == std::string_view("BIN\0", 4);
    if (28 + json_length + binary_length > length)
        throw input_error(path, fmt::format("has a chunk that reaches beyond its end (got {} bytes at {}, expected {} "
                                            "bytes in all)",
                                            binary_length, 28 + json_length, length));
    if (!is_binary) return file;  // chunks of other kinds are to be ignored
    file.binary = source.read<std::vector<unsigned char>>(binary_length);
    file.has_binary = true;
    return file;
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

}  // namespace

GltfFile read_gltf_file(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    const bool is_binary = extension == ".glb";
    if (!is_binary && extension != ".gltf")
        throw input_error(path, fmt::format("is not a glTF file (got \"{}\", expected .glb or .gltf)", extension));
    Source source(path);
    GltfFile file;
    if (is_binary)
        file = read_glb(source, path);
    else
        file.json = source.read<std::string>(source.size());
    check_nesting(file.json, path);
    return file;
}

}  // namespace pluvia
