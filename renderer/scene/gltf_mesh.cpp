#include "renderer/scene/gltf_mesh.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/gltf_deform.h"
#include "renderer/scene/tangents.h"

#include <fmt/format.h>

#include <algorithm>

namespace pluvia {
namespace {

int attribute(const tinygltf::Primitive& primitive, const std::string& key) {
    const auto found = primitive.attributes.find(key);
    return found == primitive.attributes.end() ? -1 : found->second;
}

void read_colors(const tinygltf::Model& model, int accessor, const std::string& where, Mesh& mesh) {
    if (component_count(model, accessor) != 4) {
        mesh.colors = read_elements<Rgb>(model, accessor, where);
        return;
    }
    const auto c = read_floats(model, accessor, 4, where);
    mesh.colors.reserve(c.size() / 4);
    mesh.alphas.reserve(c.size() / 4);
    for (size_t i = 0; i < c.size(); i += 4) {
        mesh.colors.emplace_back(c[i], c[i + 1], c[i + 2]);
        mesh.alphas.push_back(c[i + 3]);
    }
}

/// Corners of a primitive's triangles. Source: glTF 2.0 specification, 3.7.2.1 "Overview".
std::vector<std::array<uint32_t, 3>> triangles_of(const std::vector<uint32_t>& corners, int mode,
                                                  const std::string& where) {
    std::vector<std::array<uint32_t, 3>> triangles;
    const size_t n = corners.size();
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        if (n % 3 != 0) throw input_error(where, fmt::format("is not made of whole triangles (got {} indices)", n));
        triangles.reserve(n / 3);
        for (size_t i = 0; i < n; i += 3) triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    } else if (n >= 3) {
        triangles.reserve(n - 2);
        for (size_t i = 0; i + 2 < n; ++i)
            triangles.push_back(mode == TINYGLTF_MODE_TRIANGLE_STRIP
                                    ? std::array{corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]}
                                    : std::array{corners[i + 1], corners[i + 2], corners[0]});
    }
    return triangles;
}

/// Exporters let primitives share vertices of which each uses a part; a mesh keeps the part.
void drop_unused_vertices(Mesh& mesh) {
    const size_t count = mesh.positions.size();
    if (3 * mesh.triangles.size() >= count) return;
    constexpr uint32_t unused = ~0u;
    std::vector<uint32_t> place(count, unused), kept;
    for (auto& triangle : mesh.triangles)
        for (uint32_t& corner : triangle) {
            if (corner >= count) return;  // check() says which
            if (place[corner] == unused) {
                place[corner] = uint32_t(kept.size());
                kept.push_back(corner);
            }
            corner = place[corner];
        }
    const auto keep = [&](auto& values) {
        if (values.empty()) return;
        std::remove_reference_t<decltype(values)> part;
        part.reserve(kept.size());
        for (const uint32_t vertex : kept) part.push_back(values[vertex]);
        values = std::move(part);
    };
    keep(mesh.positions), keep(mesh.normals), keep(mesh.uvs), keep(mesh.uvs1), keep(mesh.tangents), keep(mesh.colors);
    keep(mesh.alphas);
}

void check_lengths(const Mesh& mesh, const std::string& where) {
    const auto check_size = [&](size_t size, const char* name) {
        if (size != 0 && size != mesh.positions.size())
            throw input_error(
                where, fmt::format("{} has the wrong length (got {}, expected {})", name, size, mesh.positions.size()));
    };
    check_size(mesh.normals.size(), "NORMAL");
    check_size(mesh.uvs.size(), "TEXCOORD_0");
    check_size(mesh.uvs1.size(), "TEXCOORD_1");
    check_size(mesh.tangents.size(), "TANGENT");
    check_size(mesh.colors.size(), "COLOR_0");
}

Mesh read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const std::string& name,
                    const Deformation& deformation, const std::string& where, MemoryBudget& budget) {
    Mesh mesh;
    mesh.name = name;
    const int position = attribute(primitive, "POSITION");
    if (position == -1) throw input_error(where, "has no POSITION");
    size_t bytes_per_vertex = 0;
    for (const auto& entry : primitive.attributes)
        bytes_per_vertex += 4 * std::max(0, component_count(model, entry.second));
    budget.spend(element_count(model, position, where) * bytes_per_vertex);
    mesh.positions = read_elements<Vec3>(model, position, where);
    // Tangents without normals are to be ignored (3.7.2.1); what has no normals is shaded flat, as surfaces are anyway.
    if (const int a = attribute(primitive, "NORMAL"); a != -1) {
        mesh.normals = read_elements<Vec3>(model, a, where);
        if (const int b = attribute(primitive, "TANGENT"); b != -1)
            mesh.tangents = read_elements<Tangent>(model, b, where);
    }
    if (const int a = attribute(primitive, "TEXCOORD_0"); a != -1) mesh.uvs = read_elements<Vec2>(model, a, where);
    if (const int a = attribute(primitive, "TEXCOORD_1"); a != -1) mesh.uvs1 = read_elements<Vec2>(model, a, where);
    if (const int a = attribute(primitive, "COLOR_0"); a != -1) read_colors(model, a, where, mesh);
    check_lengths(mesh, where);
    apply_morph_targets(model, primitive, deformation.weights, where, mesh);
    if (!deformation.joints.empty()) apply_skin(model, primitive, deformation.joints, where, mesh);

    std::vector<uint32_t> corners;
    if (primitive.indices != -1) {
        budget.spend(8 * element_count(model, primitive.indices, where));
        corners = read_indices(model, primitive.indices, where);
    } else {
        corners.resize(mesh.positions.size());
        for (size_t i = 0; i < corners.size(); ++i) corners[i] = uint32_t(i);
    }
    mesh.triangles = triangles_of(corners, primitive.mode == -1 ? TINYGLTF_MODE_TRIANGLES : primitive.mode, where);
    if (primitive.material < -1 || primitive.material >= int(model.materials.size()))
        throw input_error(where, fmt::format("material does not exist (got {}, expected below {})", primitive.material,
                                             model.materials.size()));
    mesh.material = primitive.material >= 0 ? primitive.material : int(model.materials.size());
    drop_unused_vertices(mesh);
    return mesh;
}

}  // namespace

MemoryBudget::MemoryBudget(const tinygltf::Model& model, const std::string& where) : where_(where) {
    // Real files stay far below: compression reaches some 50, a node that repeats a mesh some 20.
    constexpr size_t per_byte = 200, floor = size_t(256) << 20;
    size_t bytes = model.nodes.size() * 8;
    for (const tinygltf::Buffer& buffer : model.buffers) bytes += buffer.data.size();
    allowed_ = left_ = floor + per_byte * bytes;
}

void MemoryBudget::spend(size_t bytes) {
    if (bytes > left_)
        throw input_error(where_,
                          fmt::format("asks for more than a file of its size can have use for (got over {} MB of "
                                      "meshes and instances)",
                                      allowed_ >> 20));
    left_ -= bytes;
}

std::vector<Mesh> read_mesh(const tinygltf::Model& model, int index, const Deformation& deformation,
                            const std::string& where, MemoryBudget& budget, Scene& scene) {
    const tinygltf::Mesh& source = model.meshes[index];
    std::vector<Mesh> meshes;
    for (size_t k = 0; k < source.primitives.size(); ++k) {
        const tinygltf::Primitive& primitive = source.primitives[k];
        const std::string primitive_where = fmt::format("{}: mesh \"{}\" primitive {}", where, source.name, k);
        if (primitive.mode != -1 &&
            (primitive.mode < TINYGLTF_MODE_TRIANGLES || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)) {
            constexpr std::array names = {"points", "lines", "a loop of lines", "a strip of lines"};
            if (primitive.mode < 0 || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
                throw input_error(primitive_where,
                                  fmt::format("has an unknown mode (got {}, expected 0 to 6)", primitive.mode));
            scene.warnings.push_back(
                fmt::format("mesh \"{}\": primitive {} is made of {}, not of triangles, and is left out", source.name,
                            k, names[primitive.mode]));
            continue;
        }
        meshes.push_back(read_primitive(model, primitive, source.name, deformation, primitive_where, budget));
        Mesh& mesh = meshes.back();
        if (mesh.triangles.empty()) {
            scene.warnings.push_back(fmt::format("mesh \"{}\": primitive {} has no triangle", source.name, k));
            meshes.pop_back();
            continue;
        }
        const Material& material = scene.materials[mesh.material];
        const auto& uvs = material.tangent_slot().uv_set == 1 ? mesh.uvs1 : mesh.uvs;
        if (!(material.normal_texture.used() || material.anisotropy > 0) || !mesh.tangents.empty()) continue;
        if (!uvs.empty() && !mesh.normals.empty()) generate_tangents(mesh, uvs);
        if (uvs.empty() && material.anisotropy > 0)
            scene.warnings.push_back(fmt::format(
                "mesh \"{}\": primitive {} has neither tangents nor the texture coordinates that they would "
                "follow, so its material \"{}\" is the same in all directions",
                source.name, k, material.name));
    }
    return meshes;
}

}  // namespace pluvia
