#include "renderer/scene/gltf_draco.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf_accessor.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <memory>

namespace pluvia {
namespace {

constexpr const char* extension = "KHR_draco_mesh_compression";

std::unique_ptr<draco::Mesh> decode(std::span<const std::byte> bytes, const std::string& where) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
    if (!type.ok() || type.value() != draco::TRIANGULAR_MESH)
        throw input_error(where, "its compressed bytes are not a Draco mesh");
    auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok())
        throw input_error(where,
                          fmt::format("its compressed bytes are not valid ({})", mesh.status().error_msg_string()));
    return std::move(mesh).value();
}

int add_accessor(tinygltf::Model& model, tinygltf::Accessor accessor, std::vector<unsigned char> bytes, size_t count) {
    tinygltf::BufferView view;
    view.buffer = int(model.buffers.size());
    view.byteLength = bytes.size();
    model.buffers.emplace_back().data = std::move(bytes);
    accessor.bufferView = int(model.bufferViews.size());
    accessor.byteOffset = 0;
    accessor.count = count;
    model.bufferViews.push_back(view);
    model.accessors.push_back(std::move(accessor));
    return int(model.accessors.size()) - 1;
}

template <class T>
std::vector<unsigned char> values_of(const draco::Mesh& mesh, const draco::PointAttribute& attribute, int components,
                                     const std::string& where) {
    std::vector<unsigned char> bytes(size_t(mesh.num_points()) * components * sizeof(T));
    for (uint32_t i = 0; i < mesh.num_points(); ++i) {
        const auto value = attribute.mapped_index(draco::PointIndex(i));
        T* out = reinterpret_cast<T*>(bytes.data()) + size_t(i) * components;
        if (value.value() >= attribute.size() || !attribute.ConvertValue<T>(value, int8_t(components), out))
            throw input_error(where, "its compressed bytes hold an attribute that does not fit");
    }
    return bytes;
}

int add_attribute(tinygltf::Model& model, const draco::Mesh& mesh, int id, int accessor_index,
                  const std::string& where) {
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(uint32_t(id));
    if (!attribute)
        throw input_error(where, fmt::format("its compressed bytes lack an attribute (got id {}, expected one of {})",
                                             id, mesh.num_attributes()));
    if (accessor_index < 0 || accessor_index >= int(model.accessors.size()))
        throw input_error(where, fmt::format("accessor does not exist (got {}, expected below {})", accessor_index,
                                             model.accessors.size()));
    tinygltf::Accessor accessor = model.accessors[accessor_index];
    accessor.sparse.isSparse = false;
    const int components = tinygltf::GetNumComponentsInType(uint32_t(accessor.type));
    if (components <= 0 || components > attribute->num_components())
        throw input_error(
            where, fmt::format("accessor {} does not fit its compressed attribute (got {} components, expected {})",
                               accessor_index, components, attribute->num_components()));
    std::vector<unsigned char> bytes;
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            bytes = values_of<int8_t>(mesh, *attribute, components, where);
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            bytes = values_of<uint8_t>(mesh, *attribute, components, where);
            break;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            bytes = values_of<int16_t>(mesh, *attribute, components, where);
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            bytes = values_of<uint16_t>(mesh, *attribute, components, where);
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            bytes = values_of<uint32_t>(mesh, *attribute, components, where);
            break;
        default:
            accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
            bytes = values_of<float>(mesh, *attribute, components, where);
    }
    return add_accessor(model, std::move(accessor), std::move(bytes), mesh.num_points());
}

void unpack(tinygltf::Model& model, tinygltf::Primitive& primitive, const tinygltf::Value& settings,
            const std::string& where) {
    const auto integer = [](const tinygltf::Value& value) { return value.IsInt() ? value.GetNumberAsInt() : -1; };
    const int view = settings.Has("bufferView") ? integer(settings.Get("bufferView")) : -1;
    const auto mesh = decode(buffer_view_bytes(model, view, where), where);
    std::vector<unsigned char> indices(size_t(mesh->num_faces()) * 3 * sizeof(uint32_t));
    for (uint32_t i = 0; i < mesh->num_faces(); ++i)
        for (int k = 0; k < 3; ++k)
            reinterpret_cast<uint32_t*>(indices.data())[3 * size_t(i) + k] = mesh->face(draco::FaceIndex(i))[k].value();
    tinygltf::Accessor accessor;
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.type = TINYGLTF_TYPE_SCALAR;
    primitive.indices = add_accessor(model, accessor, std::move(indices), size_t(mesh->num_faces()) * 3);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;  // strips are unrolled by the encoder
    if (!settings.Has("attributes") || !settings.Get("attributes").IsObject())
        throw input_error(where, fmt::format("{} names no attributes", extension));
    for (const std::string& name : settings.Get("attributes").Keys())
        if (const auto found = primitive.attributes.find(name); found != primitive.attributes.end())
            found->second =
                add_attribute(model, *mesh, integer(settings.Get("attributes").Get(name)), found->second, where);
}

}  // namespace

void unpack_draco(tinygltf::Model& model, const std::string& where) {
    for (tinygltf::Mesh& mesh : model.meshes)
        for (size_t k = 0; k < mesh.primitives.size(); ++k) {
            const auto found = mesh.primitives[k].extensions.find(extension);
            if (found == mesh.primitives[k].extensions.end()) continue;
            const std::string primitive_where = fmt::format("{}: mesh \"{}\" primitive {}", where, mesh.name, k);
            unpack(model, mesh.primitives[k], found->second, primitive_where);
        }
}

}  // namespace pluvia
