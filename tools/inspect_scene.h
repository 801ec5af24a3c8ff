// What a glTF file contains, how it is treated and what a render of it needs, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace pluvia {

/// Throws Error (input) as load_gltf does.
nlohmann::ordered_json inspect_scene(const std::string& path, bool allow_outside);

}  // namespace pluvia
