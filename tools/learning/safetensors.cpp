#include "tools/learning/safetensors.h"

#include "renderer/core/error.h"
#include "renderer/image/pending_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

namespace pluvia {
namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little, "tensors are little endian");

struct TypeName {
    const char* name;
    TensorType type;
    uint64_t size;
};
constexpr TypeName type_names[] = {
    {"F64", TensorType::f64, 8},      {"F32", TensorType::f32, 4}, {"F16", TensorType::f16, 2},
    {"BF16", TensorType::bf16, 2},    {"I64", TensorType::i64, 8}, {"I32", TensorType::i32, 4},
    {"I16", TensorType::i16, 2},      {"I8", TensorType::i8, 1},   {"U8", TensorType::u8, 1},
    {"BOOL", TensorType::boolean, 1},
};
constexpr uint64_t max_header =
    4 << 20;  // bytes; 2,320 tensors take 0.3 MB, and JSON in memory is larger than its text
constexpr size_t max_rank = 8;
constexpr int max_depth = 3;  // file, tensor, its shape

uint64_t size_of(TensorType type) {
    for (const TypeName& t : type_names)
        if (t.type == type) return t.size;
    return 0;
}

Error tensor_error(const std::string& path, const std::string& name, const std::string& what) {
    return input_error(path, fmt::format("tensor \"{}\" {}", name.substr(0, 200), what));
}

/// Unlike the parser itself, refuses what is nested deeply or named twice.
Json parse_header(const std::string& path, const std::string& text) {
    std::set<std::string> names;
    const auto check = [&](int depth, Json::parse_event_t event, Json& value) {
        const bool opens = event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
        if (opens && depth >= max_depth) throw input_error(path, "its header is nested too deeply");
        if (event == Json::parse_event_t::key && depth == 1 && !names.insert(value.get<std::string>()).second)
            throw tensor_error(path, value.get<std::string>(), "is listed twice");
        return true;
    };
    try {
        Json header = Json::parse(text, check);
        if (!header.is_object()) throw input_error(path, "its header is not a JSON object");
        return header;
    } catch (const Json::exception& e) {
        throw input_error(path, fmt::format("its header is not JSON ({})", e.what()));
    }
}

/// A whole number from 0 on, as the header has it.
uint64_t whole_number(const std::string& path, const std::string& name, const char* key, const Json& value) {
    if (!value.is_number_unsigned())
        throw tensor_error(path, name, fmt::format("has {} that are not whole numbers from 0 on", key));
    return value.get<uint64_t>();
}

TensorEntry parse_entry(const std::string& path, const std::string& name, const Json& j, uint64_t data_start,
                        uint64_t data_bytes) {
    const auto member = [&](const char* key, Json::value_t type) -> const Json& {
        const auto found = j.is_object() ? j.find(key) : j.end();
        if (!j.is_object() || found == j.end() || found->type() != type)
            throw tensor_error(path, name, fmt::format("has no valid \"{}\"", key));
        return *found;
    };
    TensorEntry entry;
    const std::string& type = member("dtype", Json::value_t::string).get_ref<const std::string&>();
    const auto known =
        std::find_if(std::begin(type_names), std::end(type_names), [&](const TypeName& t) { return type == t.name; });
    if (known == std::end(type_names))
        throw tensor_error(path, name, fmt::format("has an unknown type (got \"{}\")", type.substr(0, 40)));
    entry.type = known->type;

    const Json& shape = member("shape", Json::value_t::array);
    if (shape.size() > max_rank)
        throw tensor_error(path, name, fmt::format("has {} dimensions (expected at most {})", shape.size(), max_rank));
    uint64_t bytes = known->size;
    for (const Json& side : shape) {
        const uint64_t n = whole_number(path, name, "sides", side);
        // Bytes that the file cannot have need no exact count; this also keeps the product from overflowing.
        if (n != 0 && bytes > std::numeric_limits<int64_t>::max() / n)
            throw tensor_error(path, name, "has a shape larger than any file");
        bytes *= n;
        if (n > uint64_t(std::numeric_limits<int64_t>::max()))
            throw tensor_error(path, name, "has a shape larger than any file");
        entry.shape.push_back(int64_t(n));
    }

    const Json& offsets = member("data_offsets", Json::value_t::array);
    if (offsets.size() != 2) throw tensor_error(path, name, "has no two data_offsets");
    const uint64_t begin = whole_number(path, name, "data_offsets", offsets[0]),
                   end = whole_number(path, name, "data_offsets", offsets[1]);
    if (begin > end || end > data_bytes)
        throw tensor_error(path, name,
                           fmt::format("lies outside of the file (got bytes {} to {} of {})", begin, end, data_bytes));
    if (end - begin != bytes)
        throw tensor_error(path, name,
                           fmt::format("has the wrong size for {} {} (got {} bytes, expected {})", type,
                                       shape_text(entry.shape), end - begin, bytes));
    entry.offset = data_start + begin;
    entry.bytes = bytes;
    return entry;
}

/// Tensors must fill the data without holes and without sharing bytes, as the format demands.
void check_cover(const std::string& path, const std::map<std::string, TensorEntry>& entries, uint64_t data_start,
                 uint64_t file_bytes) {
    std::vector<std::pair<const TensorEntry*, const std::string*>> order;
    for (const auto& [name, entry] : entries) order.emplace_back(&entry, &name);
    std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
        return std::pair(a.first->offset, a.first->bytes) < std::pair(b.first->offset, b.first->bytes);
    });
    uint64_t end = data_start;
    for (const auto& [entry, name] : order) {
        if (entry->offset < end) throw tensor_error(path, *name, "overlaps another");
        if (entry->offset > end) throw tensor_error(path, *name, "leaves bytes before it that belong to no tensor");
        end += entry->bytes;
    }
    if (end != file_bytes)
        throw input_error(path, fmt::format("{} bytes at its end belong to no tensor", file_bytes - end));
}

float value_at(const char* bytes, TensorType type, uint64_t i) {
    const auto load = [&](auto value) {
        std::memcpy(&value, bytes + i * sizeof value, sizeof value);
        return value;
    };
    switch (type) {
        case TensorType::f64:
            return float(load(double()));
        case TensorType::f32:
            return load(float());
        case TensorType::f16:
            return float_from_half(load(uint16_t()));
        case TensorType::bf16:
            return std::bit_cast<float>(uint32_t(load(uint16_t())) << 16);
        default:
            return 0;  // refused before
    }
}

}  // namespace

const char* tensor_type_name(TensorType type) {
    for (const TypeName& t : type_names)
        if (t.type == type) return t.name;
    return "?";
}

int64_t element_count(const TensorShape& shape) {
    int64_t n = 1;
    for (int64_t side : shape) n *= side;
    return n;
}

std::string shape_text(const TensorShape& shape) {
    return fmt::format("[{}]", fmt::join(shape, ", "));
}

SafetensorsFile::SafetensorsFile(const std::string& path) : path_(path) {
    std::error_code error;
    const uint64_t file_bytes = std::filesystem::file_size(path, error);
    if (error) throw input_error(path, fmt::format("cannot be read ({})", error.message()));
    stream_.open(path, std::ios::binary);
    uint64_t header_bytes = 0;
    if (file_bytes < 8 || !stream_.read(reinterpret_cast<char*>(&header_bytes), 8))
        throw input_error(path, fmt::format("is too short for weights (got {} bytes)", file_bytes));
    if (header_bytes > max_header || header_bytes > file_bytes - 8)
        throw input_error(path, fmt::format("its header is longer than the file or {} bytes (got {}); is it a "
                                            ".safetensors file?",
                                            max_header, header_bytes));
    std::string text(header_bytes, ' ');
    if (!stream_.read(text.data(), std::streamsize(header_bytes))) throw input_error(path, "cannot be read");
    const Json header = parse_header(path, text);
    const uint64_t data_start = 8 + header_bytes;
    for (const auto& [name, j] : header.items()) {
        if (name != "__metadata__") {
            entries_[name] = parse_entry(path, name, j, data_start, file_bytes - data_start);
            continue;
        }
        if (!j.is_object()) throw input_error(path, "its __metadata__ is not an object");
        for (const auto& [key, value] : j.items()) {
            if (!value.is_string()) throw input_error(path, "its __metadata__ holds something else than text");
            metadata_[key] = value.get<std::string>();
        }
    }
    check_cover(path, entries_, data_start, file_bytes);
}

void SafetensorsFile::read(const std::string& name, std::span<float> values) {
    const auto found = entries_.find(name);
    if (found == entries_.end()) throw tensor_error(path_, name, "is missing");
    const TensorEntry& entry = found->second;
    if (entry.type > TensorType::bf16)
        throw tensor_error(
            path_, name,
            fmt::format("is not of floats (got {}, expected F32, F16, BF16 or F64)", tensor_type_name(entry.type)));
    if (int64_t(values.size()) != element_count(entry.shape))
        throw tensor_error(
            path_, name,
            fmt::format("has another size (got {}, expected {} values)", shape_text(entry.shape), values.size()));
    const uint64_t size = size_of(entry.type), block = 1 << 16;
    std::vector<char> bytes(std::min<uint64_t>(entry.bytes, block * size));
    stream_.clear();
    stream_.seekg(std::streamoff(entry.offset));
    for (uint64_t first = 0; first < values.size(); first += block) {
        const uint64_t count = std::min<uint64_t>(block, values.size() - first);
        if (!stream_.read(bytes.data(), std::streamsize(count * size)))
            throw tensor_error(path_, name, "cannot be read");
        for (uint64_t i = 0; i < count; ++i) {
            const float value = value_at(bytes.data(), entry.type, i);
            if (!std::isfinite(value)) throw tensor_error(path_, name, "holds a value that is not finite");
            values[first + i] = value;
        }
    }
}

void write_safetensors(const std::string& path, const std::map<std::string, std::string>& metadata,
                       const std::vector<WrittenTensor>& tensors, TensorType type) {
    nlohmann::ordered_json header = nlohmann::ordered_json::object();
    if (!metadata.empty()) header["__metadata__"] = metadata;
    uint64_t offset = 0;
    for (const WrittenTensor& t : tensors) {
        const uint64_t bytes = t.values.size() * size_of(type);
        header[t.name] = {
            {"dtype", tensor_type_name(type)}, {"shape", t.shape}, {"data_offsets", {offset, offset + bytes}}};
        offset += bytes;
    }
    std::string text = header.dump();
    text.resize((text.size() + 7) / 8 * 8, ' ');
    const uint64_t length = text.size();
    PendingFile file(path);
    std::ofstream& out = file.stream();
    out.write(reinterpret_cast<const char*>(&length), 8);
    out << text;
    for (const WrittenTensor& t : tensors) {
        if (type == TensorType::f32) {
            out.write(reinterpret_cast<const char*>(t.values.data()), std::streamsize(t.values.size_bytes()));
            continue;
        }
        std::vector<uint16_t> halves(t.values.size());
        std::transform(t.values.begin(), t.values.end(), halves.begin(), half_from_float);
        out.write(reinterpret_cast<const char*>(halves.data()), std::streamsize(halves.size() * 2));
    }
    file.commit();
}

}  // namespace pluvia
