#include "renderer/scene/gltf_buffers.h"

#include "renderer/core/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>

namespace pluvia {
namespace {

using Json = nlohmann::json;
using Bytes = std::vector<unsigned char>;

std::string text(const Json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

/// RFC 4648, section 4; empty when a character is none of base64.
std::optional<Bytes> decode_base64(std::string_view digits) {
    static const std::array<int8_t, 256> values = [] {
        constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::array<int8_t, 256> table;
        table.fill(-1);
        for (size_t i = 0; i < alphabet.size(); ++i) table[uint8_t(alphabet[i])] = int8_t(i);
        return table;
    }();
    while (!digits.empty() && digits.back() == '=') digits.remove_suffix(1);
    Bytes bytes;
    bytes.reserve(digits.size() * 3 / 4);
    uint32_t bits = 0;
    int count = 0;
    for (const char c : digits) {
        const int value = values[uint8_t(c)];
        if (value < 0) return std::nullopt;
        bits = bits << 6 | uint32_t(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<unsigned char>(bits >> count));
    }
    return bytes;
}

/// RFC 3986, section 2.1.
std::string decode_percent(std::string_view uri) {
    std::string path;
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
            path += char(16 * digit(uri[i + 1]) + digit(uri[i + 2]));
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

/// The file that a URI names. Throws when it lies outside of the scene's folder and that is not allowed.
std::filesystem::path file_of(const std::string& uri, const UriRules& rules, const std::string& where) {
    const std::filesystem::path path = std::filesystem::path(decode_percent(uri)).lexically_normal();
    const bool is_outside = path.is_absolute() || (!path.empty() && *path.begin() == "..");
    if (is_outside && !rules.allow_outside)
        throw input_error(where, fmt::format("its file lies outside of the scene's folder (got \"{}\", expected one "
                                             "inside, or --allow-outside)",
                                             uri));
    return std::filesystem::path(rules.folder) / path;
}

std::optional<Bytes> read_file(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
    const auto size = std::filesystem::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    if (error || !file) return std::nullopt;
    Bytes bytes(size);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size))) return std::nullopt;
    return bytes;
}

/// Bytes of a data URI or file; empty when there is no such file.
std::optional<Bytes> read_uri(const std::string& uri, const UriRules& rules, const std::string& where) {
    if (!uri.starts_with("data:")) return read_file(file_of(uri, rules, where));
    const size_t comma = uri.find(',');
    constexpr std::string_view mark = ";base64";
    const bool is_base64 = comma != std::string::npos && std::string_view(uri).substr(0, comma).ends_with(mark);
    auto bytes = is_base64 ? decode_base64(std::string_view(uri).substr(comma + 1)) : std::nullopt;
    if (!bytes)
        throw input_error(
            where, fmt::format("its data URI is not readable (got \"{}...\", expected base64)", uri.substr(0, 40)));
    return bytes;
}

}  // namespace

void read_buffers(const Json& buffers, GltfFile& file, const UriRules& rules, const std::string& where,
                  tinygltf::Model& model) {
    for (size_t i = 0; i < buffers.size(); ++i) {
        const std::string buffer_where = fmt::format("{}: buffer {}", where, i);
        const Json& entry = buffers[i];
        if (!entry.is_object() || !entry.contains("byteLength") || !entry["byteLength"].is_number_unsigned())
            throw input_error(buffer_where, "has no byteLength");
        const uint64_t length = entry["byteLength"].get<uint64_t>();
        const std::string uri = text(entry, "uri");
        tinygltf::Buffer buffer;
        buffer.name = text(entry, "name");
        if (uri.empty()) {
            // A buffer without bytes may stand in for compressed ones (EXT_meshopt_compression, "Fallback Buffers").
            const bool is_fallback = entry.contains("extensions") && entry["extensions"].is_object() &&
                                     entry["extensions"].contains("EXT_meshopt_compression");
            if (i == 0 && file.has_binary)
                buffer.data = std::move(file.binary);
            else if (!is_fallback)
                throw input_error(buffer_where, "has no uri and is not the binary chunk");
            else {
                model.buffers.push_back(std::move(buffer));
                continue;
            }
        } else {
            auto bytes = read_uri(uri, rules, buffer_where);
            if (!bytes)
                throw input_error(buffer_where,
                                  fmt::format("its file is not found (got \"{}\", expected one beside the scene)",
                                              uri.substr(0, 200)));
            buffer.data = std::move(*bytes);
        }
        if (buffer.data.size() < length)
            throw input_error(buffer_where,
                              fmt::format("is too short (got {} bytes, expected {})", buffer.data.size(), length));
        model.buffers.push_back(std::move(buffer));
    }
}

void read_image_sources(const Json& images, const UriRules& rules, const std::string& where, tinygltf::Model& model) {
    for (size_t i = 0; i < images.size(); ++i) {
        const std::string image_where = fmt::format("{}: image {}", where, i);
        const Json& entry = images[i];
        if (!entry.is_object()) throw input_error(image_where, "is not an object");
        tinygltf::Image image;
        image.name = text(entry, "name");
        image.mimeType = text(entry, "mimeType");
        const std::string uri = text(entry, "uri");
        if (const auto view = entry.find("bufferView"); view != entry.end()) {
            const bool exists = view->is_number_integer() && view->get<int64_t>() >= 0 &&
                                view->get<int64_t>() < int64_t(model.bufferViews.size());
            if (!exists)
                throw input_error(image_where, fmt::format("buffer view does not exist (got {}, expected below {})",
                                                           view->dump(), model.bufferViews.size()));
            image.bufferView = view->get<int>();
        } else if (!uri.empty()) {
            const std::string named = fmt::format("{} \"{}\"", image_where, image.name);
            if (auto bytes = read_uri(uri, rules, named)) image.image = std::move(*bytes);
            image.uri = uri.starts_with("data:") ? "" : uri;
        }
        model.images.push_back(std::move(image));
    }
}

}  // namespace pluvia
