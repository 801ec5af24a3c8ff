// Arrays of numbers in a .glb file that is being written: its one buffer, with the views and accessors that find them.
// Used by gltf_save.cpp.
#pragma once

#include "renderer/scene/scene.h"

#include <tiny_gltf.h>

#include <cstring>
#include <span>
#include <vector>

namespace pluvia {

/// The file's model has its one buffer before anything is added. Functions give the index of the new accessor.
class GlbArrays {
protected:
    template <class T>
    int add_view(std::span<const T> values, int target) {
        std::vector<unsigned char>& bytes = model_.buffers[0].data;
        bytes.resize((bytes.size() + 3) / 4 * 4);  // accessors of floats and 32-bit indices start at multiples of 4
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = bytes.size();
        view.byteLength = values.size_bytes();
        view.target = target;
        bytes.resize(bytes.size() + values.size_bytes());
        std::memcpy(bytes.data() + view.byteOffset, values.data(), values.size_bytes());
        model_.bufferViews.push_back(view);
        return int(model_.bufferViews.size()) - 1;
    }

    template <class T>
    int add_accessor(std::span<const T> values, int component_type, int type, int target, size_t count) {
        tinygltf::Accessor accessor;
        accessor.bufferView = add_view(values, target);
        accessor.componentType = component_type;
        accessor.type = type;
        accessor.count = count;
        model_.accessors.push_back(accessor);
        return int(model_.accessors.size()) - 1;
    }

    /// components: floats per element, which are flattened by the caller.
    int add_floats(const std::vector<float>& values, int components, int target = TINYGLTF_TARGET_ARRAY_BUFFER) {
        constexpr int types[] = {0, TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4};
        return add_accessor(std::span(values), TINYGLTF_COMPONENT_TYPE_FLOAT, types[components], target,
                            values.size() / size_t(components));
    }

    /// Three bytes and one of padding a vertex.
    int add_colors(const std::vector<Rgba8>& colors) {
        const int accessor = add_accessor(std::span(colors), TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC3,
                                          TINYGLTF_TARGET_ARRAY_BUFFER, colors.size());
        model_.accessors[accessor].normalized = true;
        model_.bufferViews[model_.accessors[accessor].bufferView].byteStride = sizeof(Rgba8);
        return accessor;
    }

    int add_indices(const Mesh& mesh) {
        const size_t count = 3 * mesh.triangles.size();
        // The largest 16-bit index is left out: some systems restart strips at it.
        if (mesh.positions.size() > 0xffff)
            return add_accessor(std::span(mesh.triangles), TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                                TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, count);
        std::vector<uint16_t> narrow;
        narrow.reserve(count);
        for (const auto& triangle : mesh.triangles)
            for (const uint32_t vertex : triangle) narrow.push_back(uint16_t(vertex));
        return add_accessor(std::span<const uint16_t>(narrow), TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                            TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, count);
    }

    tinygltf::Model model_;
};

}  // namespace pluvia
