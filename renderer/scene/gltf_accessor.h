// Numbers out of a glTF file's buffers, every offset and size checked before use.
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace pluvia {

/// Reads an accessor as floats, components of each element one after the other; integer components are normalised
/// when the accessor says so. components: how many each element must have (2 VEC2, 3 VEC3, 4 VEC4, 1 SCALAR).
/// Throws Error (input) naming the accessor when sizes do not fit; where: file and mesh that use it.
std::vector<float> read_floats(const tinygltf::Model& model, int accessor, int components, const std::string& where);

/// Number of components of an accessor's elements, 0 when it does not exist.
int component_count(const tinygltf::Model& model, int accessor);

/// Reads an index accessor (unsigned byte, short or int).
std::vector<uint32_t> read_indices(const tinygltf::Model& model, int accessor, const std::string& where);

/// The bytes of a buffer view. Throws Error (input) when it reaches outside its buffer.
std::span<const std::byte> buffer_view_bytes(const tinygltf::Model& model, int view, const std::string& where);

}  // namespace pluvia
