// What Pluvia reads and writes in the extras of a glTF file.
// Under "pluvia": {"lamp": true} on a node, for it and all below it, or on a material (what it means is in lamps.h);
// {"wet": false} on a material that stays dry on wet ground. Beside it {"semantic": "car", "instance": 3} on a node,
// for it and all below it: its class as Cityscapes names it, and which one of that class it is, from 0.
#pragma once

#include "renderer/scene/gltf_value.h"

namespace pluvia {

/// A mark under "pluvia"; `otherwise` where it is missing or is no boolean.
inline bool mark(const tinygltf::Value& extras, const char* name, bool otherwise) {
    const tinygltf::Value* value = find(find(&extras, "pluvia"), name);
    return value && value->IsBool() ? value->Get<bool>() : otherwise;
}
inline bool is_marked_lamp(const tinygltf::Value& extras) {
    return mark(extras, "lamp", false);
}
inline bool is_marked_dry(const tinygltf::Value& extras) {
    return !mark(extras, "wet", true);
}

/// Extras that carry the marks given; nothing where there are none.
inline tinygltf::Value marks(bool lamp, bool dry = false) {
    tinygltf::Value::Object list;
    if (lamp) list["lamp"] = tinygltf::Value(true);
    if (dry) list["wet"] = tinygltf::Value(false);
    if (list.empty()) return {};
    return tinygltf::Value(tinygltf::Value::Object{{"pluvia", tinygltf::Value(list)}});
}

/// Empty where none is given.
inline std::string semantic_class(const tinygltf::Value& extras) {
    const tinygltf::Value* name = find(&extras, "semantic");
    return name && name->IsString() ? name->Get<std::string>() : std::string();
}

/// Adds a class and a number to extras, which keep what they have.
inline void mark_semantic(tinygltf::Value& extras, const std::string& semantic, int instance) {
    tinygltf::Value::Object object;
    if (extras.IsObject()) object = extras.Get<tinygltf::Value::Object>();
    object["semantic"] = tinygltf::Value(semantic);
    object["instance"] = tinygltf::Value(instance);
    extras = tinygltf::Value(object);
}

}  // namespace pluvia
