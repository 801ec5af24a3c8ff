// The mark of a lamp in a glTF file: extras {"pluvia": {"lamp": true}} on a node, for it and all below it, or on a
// material. What the mark means is in lamps.h.
#pragma once

#include <tiny_gltf.h>

namespace pluvia {

inline bool is_marked_lamp(const tinygltf::Value& extras) {
    if (!extras.IsObject() || !extras.Has("pluvia") || !extras.Get("pluvia").IsObject()) return false;
    const tinygltf::Value& lamp = extras.Get("pluvia").Get("lamp");
    return lamp.IsBool() && lamp.Get<bool>();
}

inline tinygltf::Value lamp_mark() {
    const tinygltf::Value mark(tinygltf::Value::Object{{"lamp", tinygltf::Value(true)}});
    return tinygltf::Value(tinygltf::Value::Object{{"pluvia", mark}});
}

}  // namespace pluvia
