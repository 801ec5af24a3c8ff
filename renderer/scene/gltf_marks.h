// Marks that only Pluvia reads, in the `extras` of a glTF file under "pluvia": {"lamp": true} on a node, for it and all
// below it, or on a material (what it means is in lamps.h); {"wet": false} on a material that stays dry on wet ground.
#pragma once

#include <tiny_gltf.h>

#include <optional>

namespace pluvia {

/// Empty where the mark is missing or is no boolean.
inline std::optional<bool> mark(const tinygltf::Value& extras, const char* name) {
    if (!extras.IsObject() || !extras.Has("pluvia") || !extras.Get("pluvia").IsObject()) return std::nullopt;
    const tinygltf::Value& value = extras.Get("pluvia").Get(name);
    if (!value.IsBool()) return std::nullopt;
    return value.Get<bool>();
}

inline bool is_marked_lamp(const tinygltf::Value& extras) {
    return mark(extras, "lamp").value_or(false);
}
inline bool is_marked_dry(const tinygltf::Value& extras) {
    return !mark(extras, "wet").value_or(true);
}

/// Extras that carry the marks given; nothing where there are none.
inline tinygltf::Value marks(bool lamp, bool dry = false) {
    tinygltf::Value::Object list;
    if (lamp) list["lamp"] = tinygltf::Value(true);
    if (dry) list["wet"] = tinygltf::Value(false);
    if (list.empty()) return {};
    return tinygltf::Value(tinygltf::Value::Object{{"pluvia", tinygltf::Value(list)}});
}

}  // namespace pluvia
