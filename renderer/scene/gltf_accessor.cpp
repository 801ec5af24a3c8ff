#include "renderer/scene/gltf_accessor.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace pluvia {
namespace {

template <class T>
T load(const std::byte* p) {
    T value;
    std::memcpy(&value, p, sizeof value);
    return value;
}

/// Normalised integers as the glTF 2.0 specification, 3.6.2.2 (signed values clamp at -1).
float read_component(const std::byte* p, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return load<float>(p);
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return normalized ? std::max(load<int8_t>(p) / 127.0f, -1.0f) : load<int8_t>(p);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return normalized ? load<uint8_t>(p) / 255.0f : load<uint8_t>(p);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return normalized ? std::max(load<int16_t>(p) / 32767.0f, -1.0f) : load<int16_t>(p);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return normalized ? load<uint16_t>(p) / 65535.0f : load<uint16_t>(p);
        default:
            return normalized ? float(load<uint32_t>(p) / 4294967295.0) : float(load<uint32_t>(p));
    }
}

/// Elements in a row: count of them, `stride` bytes from one to the next.
struct Row {
    const std::byte* first = nullptr;  // null: all are zero
    size_t count = 0, stride = 0;
};

/// A row that starts `offset` bytes into a buffer view, all of whose elements lie inside.
Row find_row(const tinygltf::Model& model, int view, uint64_t offset, uint64_t count, size_t element_size,
             const std::string& where) {
    const auto bytes = buffer_view_bytes(model, view, where);
    const size_t view_stride = model.bufferViews[view].byteStride;
    const size_t stride = view_stride ? view_stride : element_size;
    // Compared by division: a hostile count times the stride would overflow.
    const bool fits = offset <= bytes.size() && stride >= element_size &&
                      (count == 0 || (bytes.size() - offset >= element_size &&
                                      count - 1 <= (bytes.size() - offset - element_size) / stride));
    if (!fits)
        throw input_error(where, fmt::format("reaches outside its buffer view (got {} elements of stride {} at "
                                             "offset {}, expected at most {} bytes)",
                                             count, stride, offset, bytes.size()));
    return {bytes.data() + offset, size_t(count), stride};
}

struct Elements {
    Row row;
    int components, component_type;
    size_t component_size;
    bool normalized;
    Row sparse_indices, sparse_values;
    int sparse_index_type = 0;
    std::string where;
};

std::vector<uint32_t> read_integers(const Row& row, int component_type, const std::string& where) {
    std::vector<uint32_t> values(row.count);
    const auto copy = [&]<class T>(T) {
        for (size_t i = 0; i < row.count; ++i) values[i] = row.first ? load<T>(row.first + i * row.stride) : 0;
    };
    if (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
        copy(uint8_t());
    else if (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        copy(uint16_t());
    else if (component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        copy(uint32_t());
    else
        throw input_error(where,
                          fmt::format("has the wrong type for indices (got {}, expected unsigned byte, short or int)",
                                      component_type));
    return values;
}

/// The most elements that an accessor without bytes, which stands for zeros, may have: it goes with others that have.
size_t most_zeros(const tinygltf::Model& model) {
    size_t bytes = 1024;
    for (const tinygltf::Buffer& buffer : model.buffers) bytes += buffer.data.size();
    return bytes;
}

Elements find_elements(const tinygltf::Model& model, int index, const std::string& where) {
    if (index < 0 || index >= int(model.accessors.size()))
        throw input_error(
            where, fmt::format("accessor does not exist (got {}, expected below {})", index, model.accessors.size()));
    const tinygltf::Accessor& accessor = model.accessors[index];
    Elements e;
    e.where = fmt::format("{}: accessor {}", where, index);
    e.components = tinygltf::GetNumComponentsInType(uint32_t(accessor.type));
    e.component_type = accessor.componentType;
    e.normalized = accessor.normalized;
    const int component_size = tinygltf::GetComponentSizeInBytes(uint32_t(accessor.componentType));
    const bool is_signed_int = accessor.componentType == TINYGLTF_COMPONENT_TYPE_INT;  // glTF has none
    if (e.components <= 0 || component_size <= 0 || component_size > 4 || is_signed_int)
        throw input_error(e.where, fmt::format("has an unknown type (got {} components of type {}, expected type 5120 "
                                               "to 5123, 5125 or 5126)",
                                               e.components, accessor.componentType));
    e.component_size = size_t(component_size);
    const size_t element_size = size_t(e.components) * e.component_size;
    if (accessor.bufferView == -1) {
        if (accessor.count > most_zeros(model))
            throw input_error(e.where, fmt::format("has no buffer view (got {} elements all zero)", accessor.count));
        e.row.count = accessor.count;
    } else {
        e.row = find_row(model, accessor.bufferView, accessor.byteOffset, accessor.count, element_size, e.where);
    }
    if (!accessor.sparse.isSparse) return e;
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || size_t(sparse.count) > accessor.count || sparse.indices.byteOffset < 0 ||
        sparse.values.byteOffset < 0)
        throw input_error(
            e.where, fmt::format("has sparse values that do not fit (got {} at {} and {}, expected at most {})",
                                 sparse.count, sparse.indices.byteOffset, sparse.values.byteOffset, accessor.count));
    const int index_size = tinygltf::GetComponentSizeInBytes(uint32_t(sparse.indices.componentType));
    const std::string sparse_where = e.where + ": sparse indices", value_where = e.where + ": sparse values";
    if (index_size <= 0 || index_size > 4)
        throw input_error(sparse_where, fmt::format("have an unknown type (got {})", sparse.indices.componentType));
    e.sparse_indices = find_row(model, sparse.indices.bufferView, uint64_t(sparse.indices.byteOffset),
                                uint64_t(sparse.count), size_t(index_size), sparse_where);
    e.sparse_values = find_row(model, sparse.values.bufferView, uint64_t(sparse.values.byteOffset),
                               uint64_t(sparse.count), element_size, value_where);
    e.sparse_index_type = sparse.indices.componentType;
    return e;
}

std::vector<uint32_t> sparse_targets(const Elements& e) {
    if (e.sparse_indices.count == 0) return {};
    auto targets = read_integers(e.sparse_indices, e.sparse_index_type, e.where + ": sparse indices");
    for (size_t i = 0; i < targets.size(); ++i) {
        if (targets[i] >= e.row.count)
            throw input_error(
                e.where, fmt::format("substitutes an element that is not there (got {}, expected below {})", targets[i],
                                     e.row.count));
        if (i > 0 && targets[i] <= targets[i - 1])
            throw input_error(e.where, fmt::format("has sparse indices that do not rise (got {} after {})", targets[i],
                                                   targets[i - 1]));
    }
    return targets;
}

void read_element(const std::byte* p, const Elements& e, float* out) {
    for (int c = 0; c < e.components; ++c)
        out[c] = read_component(p + size_t(c) * e.component_size, e.component_type, e.normalized);
}

}  // namespace

std::span<const std::byte> buffer_view_bytes(const tinygltf::Model& model, int index, const std::string& where) {
    if (index < 0 || index >= int(model.bufferViews.size()))
        throw input_error(where, fmt::format("buffer view does not exist (got {}, expected below {})", index,
                                             model.bufferViews.size()));
    const tinygltf::BufferView& view = model.bufferViews[index];
    if (view.buffer < 0 || view.buffer >= int(model.buffers.size()))
        throw input_error(
            where, fmt::format("buffer does not exist (got {}, expected below {})", view.buffer, model.buffers.size()));
    const auto& data = model.buffers[view.buffer].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        throw input_error(where, fmt::format("buffer view {} reaches outside its buffer (got {} bytes at offset {}, "
                                             "expected at most {} bytes)",
                                             index, view.byteLength, view.byteOffset, data.size()));
    return std::as_bytes(std::span(data)).subspan(view.byteOffset, view.byteLength);
}

int component_count(const tinygltf::Model& model, int accessor) {
    if (accessor < 0 || accessor >= int(model.accessors.size())) return 0;
    return tinygltf::GetNumComponentsInType(uint32_t(model.accessors[accessor].type));
}

size_t element_count(const tinygltf::Model& model, int accessor, const std::string& where) {
    return find_elements(model, accessor, where).row.count;
}

void read_into(const tinygltf::Model& model, int accessor, int components, const std::string& where, float* out) {
    const Elements e = find_elements(model, accessor, where);
    if (e.components != components)
        throw input_error(where, fmt::format("accessor {} has the wrong type (got {} components, expected {})",
                                             accessor, e.components, components));
    if (e.row.count == 0) return;  // out may be null then
    const size_t n = size_t(components);
    const bool is_plain = e.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT && e.row.stride == n * sizeof(float);
    if (!e.row.first)
        std::fill_n(out, e.row.count * n, 0.0f);
    else if (is_plain)
        std::memcpy(out, e.row.first, e.row.count * n * sizeof(float));
    else
        for (size_t i = 0; i < e.row.count; ++i) read_element(e.row.first + i * e.row.stride, e, out + i * n);
    const auto targets = sparse_targets(e);
    for (size_t i = 0; i < targets.size(); ++i)
        read_element(e.sparse_values.first + i * e.sparse_values.stride, e, out + targets[i] * n);
    if (e.component_type != TINYGLTF_COMPONENT_TYPE_FLOAT) return;
    for (size_t i = 0; i < e.row.count * n; ++i)
        if (!std::isfinite(out[i]))
            throw input_error(e.where, fmt::format("holds a value that is not finite (got {} in element {}, expected "
                                                   "numbers)",
                                                   out[i], i / n));
}

std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components, const std::string& where) {
    std::vector<float> values(element_count(model, accessor, where) * size_t(std::max(components, 0)));
    read_into(model, accessor, components, where, values.data());
    return values;
}

std::vector<uint32_t> read_indices(const tinygltf::Model& model, int accessor, const std::string& where) {
    const Elements e = find_elements(model, accessor, where);
    if (e.components != 1)
        throw input_error(e.where,
                          fmt::format("has the wrong type for indices (got {} components, expected 1)", e.components));
    auto indices = read_integers(e.row, e.component_type, e.where);
    const auto targets = sparse_targets(e);
    if (targets.empty()) return indices;
    const auto values = read_integers(e.sparse_values, e.component_type, e.where);
    for (size_t i = 0; i < targets.size(); ++i) indices[targets[i]] = values[i];
    return indices;
}

}  // namespace pluvia
