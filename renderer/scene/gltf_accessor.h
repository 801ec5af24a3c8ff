// Numbers out of a glTF file's buffers, every offset and size checked before use.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace pluvia {

// Integer components are normalised when the accessor says so; sparse accessors come back with their substitutions.
// All throw Error (input) naming the accessor when it does not exist, has another type, reaches outside of its buffer
// or holds a value that is not finite; where: file and mesh that use it.

/// Number of elements of an accessor, all of which lie inside their buffer.
size_t element_count(const tinygltf::Model& model, int accessor, const std::string& where);

/// Writes element_count() times `components` floats (1 SCALAR, 2 VEC2, 3 VEC3, 4 VEC4, 16 MAT4).
void read_into(const tinygltf::Model& model, int accessor, int components, const std::string& where, float* out);

/// Elements of a struct of floats (Vec2, Vec3, ...), one per element of the accessor.
template <class T>
std::vector<T> read_elements(const tinygltf::Model& model, int accessor, const std::string& where) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(float) == 0);
    std::vector<T> values(element_count(model, accessor, where));
    read_into(model, accessor, int(sizeof(T) / sizeof(float)), where, reinterpret_cast<float*>(values.data()));
    return values;
}

/// Components of each element one after the other.
std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components, const std::string& where);

/// Number of components of an accessor's elements, 0 when it does not exist.
int component_count(const tinygltf::Model& model, int accessor);

/// Reads an index accessor (unsigned byte, short or int).
std::vector<uint32_t> read_indices(const tinygltf::Model& model, int accessor, const std::string& where);

/// The bytes of a buffer view. Throws Error (input) when it reaches outside its buffer.
std::span<const std::byte> buffer_view_bytes(const tinygltf::Model& model, int view, const std::string& where);

}  // namespace pluvia
