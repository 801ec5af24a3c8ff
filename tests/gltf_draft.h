// A small glTF file under construction, to be read by the loader under test; it is written without the project's
// writer.
#pragma once

#include "renderer/scene/scene.h"
#include "tests/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pluvia {

using Json = nlohmann::json;

// Component types of accessors, as glTF numbers them.
enum GltfType {
    gltf_byte = 5120,
    gltf_ubyte = 5121,
    gltf_short = 5122,
    gltf_ushort = 5123,
    gltf_uint = 5125,
    gltf_float = 5126
};

/// root may be changed at will before it is written; its one buffer is added from `bytes`.
struct GltfDraft {
    Json root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", Json::array({{{"nodes", Json::array()}}})}};
    std::string bytes;

    /// Appends to an array of the file and returns the index there.
    int add(const std::string& array, Json entry);
    int add_view(std::string_view content, int stride = 0);
    int add_accessor(int view, int count, const std::string& type, GltfType component, bool normalized = false,
                     int offset = 0);
    /// One value per component in a view of its own; T agrees with component.
    template <class T>
    int add_values(const std::vector<T>& values, const std::string& type, GltfType component, bool normalized = false) {
        const int components = type == "SCALAR" ? 1 : type.back() - '0';
        const std::string_view content(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        return add_accessor(add_view(content), int(values.size()) / components, type, component, normalized);
    }
    int add_floats(const std::vector<float>& values, const std::string& type) {
        return add_values(values, type, gltf_float);
    }
    /// A mesh of one primitive with the corners (0,0,0), (1,0,0), (0,1,0); more: further entries of the primitive.
    int add_triangle_mesh(Json more = Json::object());
    /// A node of the default scene.
    int add_root(Json node);
    /// The file's images, each with a texture and a material that shows it.
    void add_pictures(const Json& images);

    /// With the buffer as a data URI.
    std::string gltf() const;
    /// With the buffer as the second chunk, absent when it is empty.
    std::string glb() const;
};

/// A file of one triangle, mesh 0, on node 0 named "triangle".
GltfDraft triangle_draft();

/// Writes a file and returns its path.
std::string write(const TemporaryFolder& folder, const std::string& name, std::string_view bytes);
/// The draft as .gltf through load_gltf.
Scene load(const GltfDraft& draft);
/// Whether a warning contains this text.
bool warns(const Scene& scene, const std::string& text);

std::string data_uri(std::string_view bytes, const std::string& mime_type);

}  // namespace pluvia
