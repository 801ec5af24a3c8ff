#include "renderer/scene/gltf_accessor.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

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
            return float(load<uint32_t>(p));
    }
}

struct Elements {
    const std::byte* first;
    size_t count, stride, component_size;
    int components, component_type;
    bool normalized;
};

/// Finds an accessor's elements and checks that all of them lie inside the buffer.
Elements find_elements(const tinygltf::Model& model, int index, const std::string& where) {
    if (index < 0 || index >= int(model.accessors.size()))
        throw input_error(
            where, fmt::format("accessor does not exist (got {}, expected below {})", index, model.accessors.size()));
    const tinygltf::Accessor& accessor = model.accessors[index];
    const std::string accessor_where = fmt::format("{}: accessor {}", where, index);
    if (accessor.sparse.isSparse) throw input_error(accessor_where, "is sparse, which is not supported");
    const int components = tinygltf::GetNumComponentsInType(uint32_t(accessor.type));
    const int component_size = tinygltf::GetComponentSizeInBytes(uint32_t(accessor.componentType));
    const bool is_signed_int = accessor.componentType == TINYGLTF_COMPONENT_TYPE_INT;  // glTF has none
    if (components <= 0 || component_size <= 0 || component_size > 4 || is_signed_int)
        throw input_error(accessor_where, fmt::format("has an unknown type (got {} of component {})", accessor.type,
                                                      accessor.componentType));
    const auto bytes = buffer_view_bytes(model, accessor.bufferView, accessor_where);
    const size_t element_size = size_t(components) * component_size;
    const size_t view_stride = model.bufferViews[accessor.bufferView].byteStride;
    const size_t stride = view_stride ? view_stride : element_size;
    // Compared by division: a hostile count times the stride would overflow.
    const bool fits =
        accessor.byteOffset <= bytes.size() && stride >= element_size &&
        (accessor.count == 0 || (bytes.size() - accessor.byteOffset >= element_size &&
                                 (accessor.count - 1) <= (bytes.size() - accessor.byteOffset - element_size) / stride));
    if (!fits)
        throw input_error(accessor_where,
                          fmt::format("reaches outside its buffer view (got {} elements of stride {} at "
                                      "offset {}, expected at most {} bytes)",
                                      accessor.count, stride, accessor.byteOffset, bytes.size()));
    return {bytes.data() + accessor.byteOffset,
            accessor.count,
            stride,
            size_t(component_size),
            components,
            accessor.componentType,
            accessor.normalized};
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

std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components, const std::string& where) {
    const Elements e = find_elements(model, accessor, where);
    if (e.components != components)
        throw input_error(where, fmt::format("accessor {} has the wrong type (got {} components, expected {})",
                                             accessor, e.components, components));
    std::vector<float> values;
    values.reserve(e.count * components);
    for (size_t i = 0; i < e.count; ++i)
        for (int c = 0; c < components; ++c)
            values.push_back(
                read_component(e.first + i * e.stride + c * e.component_size, e.component_type, e.normalized));
    return values;
}

std::vector<uint32_t> read_indices(const tinygltf::Model& model, int accessor, const std::string& where) {
    const Elements e = find_elements(model, accessor, where);
    std::vector<uint32_t> indices(e.count);
    for (size_t i = 0; i < e.count; ++i) {
        const std::byte* p = e.first + i * e.stride;
        switch (e.component_type) {
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
                indices[i] = load<uint8_t>(p);
                break;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
                indices[i] = load<uint16_t>(p);
                break;
            case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
                indices[i] = load<uint32_t>(p);
                break;
            default:
                throw input_error(where, fmt::format("index accessor {} has the wrong type (got {}, expected unsigned "
                                                     "byte, short or int)",
                                                     accessor, e.component_type));
        }
    }
    return indices;
}

}  // namespace pluvia
