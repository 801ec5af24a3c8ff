// Values inside the extensions of a glTF file, which the parser leaves as untyped trees. Nothing here throws: what is
// absent or of another type gives the default, as for a property that the file does not state.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/vec.h"

#include <tiny_gltf.h>

#include <string>

namespace pluvia {

/// A member of an object; null when `value` is null, no object or without it.
inline const tinygltf::Value* find(const tinygltf::Value* value, const std::string& key) {
    return value && value->IsObject() && value->Has(key) ? &value->Get(key) : nullptr;
}
/// An extension of whatever carries one; null when absent.
inline const tinygltf::Value* find(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

inline double number(const tinygltf::Value* value, double otherwise) {
    return value && value->IsNumber() ? value->GetNumberAsDouble() : otherwise;
}
/// An index into one of the file's arrays; -1 when there is none.
inline int index(const tinygltf::Value* value) {
    return value && value->IsInt() ? value->GetNumberAsInt() : -1;
}
/// The i-th element of an array.
inline double number(const tinygltf::Value* array, int i, double otherwise) {
    return array && array->IsArray() && i < int(array->ArrayLen()) ? number(&array->Get(i), otherwise) : otherwise;
}
inline Rgb color(const tinygltf::Value* array, Rgb otherwise) {
    return {float(number(array, 0, otherwise.r)), float(number(array, 1, otherwise.g)),
            float(number(array, 2, otherwise.b))};
}
inline Vec2 pair(const tinygltf::Value* array, Vec2 otherwise) {
    return {float(number(array, 0, otherwise.x)), float(number(array, 1, otherwise.y))};
}

}  // namespace pluvia
