#include "renderer/scene/gltf.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/gltf_lamp.h"
#include "renderer/scene/gltf_material.h"
#include "renderer/scene/gltf_parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace pluvia {
namespace {

Transform transform_of(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        const auto& m = node.matrix;  // column-major
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    Transform t;
    if (node.scale.size() == 3) t = scale({node.scale[0], node.scale[1], node.scale[2]});
    if (node.rotation.size() == 4)
        t = rotate(node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]) * t;
    if (node.translation.size() == 3) t.translation = {node.translation[0], node.translation[1], node.translation[2]};
    return t;
}

Mesh read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const std::string& name,
                    const std::string& where) {
    Mesh mesh;
    mesh.name = name;
    const auto attribute = [&](const char* key) {
        const auto found = primitive.attributes.find(key);
        return found == primitive.attributes.end() ? -1 : found->second;
    };
    if (attribute("POSITION") == -1) throw input_error(where, "has no POSITION");
    const auto p = read_floats(model, attribute("POSITION"), 3, where);
    for (size_t i = 0; i < p.size(); i += 3) mesh.positions.emplace_back(p[i], p[i + 1], p[i + 2]);
    if (const int a = attribute("NORMAL"); a != -1) {
        const auto n = read_floats(model, a, 3, where);
        for (size_t i = 0; i < n.size(); i += 3) mesh.normals.emplace_back(n[i], n[i + 1], n[i + 2]);
    }
    const auto read_uvs = [&](const char* key, std::vector<Vec2>& uvs) {
        const int a = attribute(key);
        if (a == -1) return;
        const auto uv = read_floats(model, a, 2, where);
        for (size_t i = 0; i < uv.size(); i += 2) uvs.push_back({uv[i], uv[i + 1]});
    };
    read_uvs("TEXCOORD_0", mesh.uvs);
    read_uvs("TEXCOORD_1", mesh.uvs1);
    if (const int a = attribute("TANGENT"); a != -1) {
        const auto t = read_floats(model, a, 4, where);
        for (size_t i = 0; i < t.size(); i += 4) mesh.tangents.push_back({{t[i], t[i + 1], t[i + 2]}, t[i + 3]});
    }
    if (const int a = attribute("COLOR_0"); a != -1) {
        const int components = component_count(model, a) == 4 ? 4 : 3;
        const auto c = read_floats(model, a, components, where);
        for (size_t i = 0; i < c.size(); i += components) {
            mesh.colors.emplace_back(c[i], c[i + 1], c[i + 2]);
            if (components == 4) mesh.alphas.push_back(c[i + 3]);
        }
    }
    std::vector<uint32_t> indices;
    if (primitive.indices != -1) {
        indices = read_indices(model, primitive.indices, where);
    } else {
        indices.resize(mesh.positions.size());
        for (size_t i = 0; i < indices.size(); ++i) indices[i] = uint32_t(i);
    }
    if (indices.size() % 3 != 0)
        throw input_error(where, fmt::format("is not made of whole triangles (got {} indices)", indices.size()));
    for (size_t i = 0; i < indices.size(); i += 3)
        mesh.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    if (primitive.material < -1 || primitive.material >= int(model.materials.size()))
        throw input_error(where, fmt::format("material does not exist (got {}, expected below {})", primitive.material,
                                             model.materials.size()));
    mesh.material = primitive.material >= 0 ? primitive.material : int(model.materials.size());
    return mesh;
}

// Far more than any file has; a chain of nodes is followed by recursion, which must not use up the stack.
constexpr int max_depth = 256;

/// Walks the node tree and adds what hangs on it, with transforms composed in double precision.
class NodeWalk {
public:
    NodeWalk(const tinygltf::Model& model, const std::string& where, Scene& scene)
        : model_(model),
          where_(where),
          scene_(scene),
          first_part_(model.meshes.size(), -1),
          visited_(model.nodes.size()) {}

    /// parent_path: empty for a root. depth: number of nodes above.
    void walk(int index, const Transform& scene_from_parent, const std::string& parent_path, int depth = 0) {
        if (index < 0 || index >= int(model_.nodes.size()))
            throw input_error(
                where_, fmt::format("node does not exist (got {}, expected below {})", index, model_.nodes.size()));
        if (visited_[index])
            throw input_error(where_, fmt::format("node {} is reached twice (expected a tree)", index));
        if (depth >= max_depth)
            throw input_error(where_, fmt::format("node {} lies too deep in the tree (expected at most {} levels)",
                                                  index, max_depth));
        visited_[index] = true;
        const tinygltf::Node& node = model_.nodes[index];
        const std::string name = node.name.empty() ? fmt::format("node_{}", index) : node.name;
        const std::string path = parent_path.empty() ? name : parent_path + "/" + name;
        const Transform scene_from_node = scene_from_parent * transform_of(node);
        if (!is_finite(scene_from_node.translation) || !std::isfinite(scene_from_node.determinant()))
            throw input_error(fmt::format("{}: node \"{}\"", where_, path),
                              "its transform is not finite (expected numbers)");
        const bool lamp_above = lamp_;
        lamp_ = lamp_above || is_marked_lamp(node.extras);
        if (node.mesh != -1) add_mesh(node, path, scene_from_node);
        if (node.camera != -1) add_camera(node, name, scene_from_node);
        if (node.extensions.count("KHR_lights_punctual")) add_light(node, name, scene_from_node);
        for (const int child : node.children) walk(child, scene_from_node, path, depth + 1);
        lamp_ = lamp_above;
    }

private:
    void add_mesh(const tinygltf::Node& node, const std::string& path, const Transform& scene_from_node) {
        if (node.mesh < 0 || node.mesh >= int(model_.meshes.size()))
            throw input_error(fmt::format("{}: node \"{}\"", where_, path),
                              fmt::format("mesh does not exist (got {}, "
                                          "expected below {})",
                                          node.mesh, model_.meshes.size()));
        if (node.skin >= 0) scene_.warnings.push_back(fmt::format("node \"{}\": its skin is not supported", path));
        const tinygltf::Mesh& mesh = model_.meshes[node.mesh];
        if (first_part_[node.mesh] < 0) read_mesh(mesh, node.mesh);
        for (int part = 0; part < part_count_[node.mesh]; ++part)
            scene_.instances.push_back({path, instance_id(path), first_part_[node.mesh] + part, scene_from_node, lamp_});
    }

    void read_mesh(const tinygltf::Mesh& mesh, int index) {
        first_part_[index] = int(scene_.meshes.size());
        for (size_t k = 0; k < mesh.primitives.size(); ++k) {
            const tinygltf::Primitive& primitive = mesh.primitives[k];
            const std::string primitive_where = fmt::format("{}: mesh \"{}\" primitive {}", where_, mesh.name, k);
            if (primitive.mode != TINYGLTF_MODE_TRIANGLES && primitive.mode != -1) {
                scene_.warnings.push_back(
                    fmt::format("mesh \"{}\": primitive {} is not made of triangles (mode {}) and "
                                "is left out",
                                mesh.name, k, primitive.mode));
                continue;
            }
            if (!primitive.targets.empty())
                scene_.warnings.push_back(fmt::format("mesh \"{}\": its morph targets are not supported", mesh.name));
            scene_.meshes.push_back(read_primitive(model_, primitive, mesh.name, primitive_where));
        }
        part_count_[index] = int(scene_.meshes.size()) - first_part_[index];
    }

    void add_camera(const tinygltf::Node& node, const std::string& name, const Transform& scene_from_node) {
        const std::string node_where = fmt::format("{}: node \"{}\"", where_, name);
        if (node.camera < 0 || node.camera >= int(model_.cameras.size()))
            throw input_error(node_where, fmt::format("camera does not exist (got {}, expected below {})", node.camera,
                                                      model_.cameras.size()));
        if (scene_from_node.determinant() == 0)
            throw input_error(node_where, "its transform leaves the camera no direction (got a scale of 0)");
        const tinygltf::Camera& source = model_.cameras[node.camera];
        if (source.type != "perspective") {
            scene_.warnings.push_back(fmt::format("camera \"{}\": {} projection is not supported", name, source.type));
            return;
        }
        const double fov = source.perspective.yfov;
        if (!(fov > 0 && fov < std::numbers::pi))
            throw input_error(node_where, fmt::format("its camera's yfov is out of range (got {}, expected above 0 and "
                                                      "below pi)",
                                                      fov));
        scene_.cameras.push_back({source.name.empty() ? name : source.name, scene_from_node, fov});
    }

    void add_light(const tinygltf::Node& node, const std::string& name, const Transform& scene_from_node) {
        const tinygltf::Value& reference = node.extensions.at("KHR_lights_punctual").Get("light");
        const int index = reference.IsInt() ? reference.GetNumberAsInt() : -1;
        const std::string node_where = fmt::format("{}: node \"{}\"", where_, name);
        if (index < 0 || index >= int(model_.lights.size()))
            throw input_error(node_where, fmt::format("light does not exist (got {}, expected below {})", index,
                                                      model_.lights.size()));
        const tinygltf::Light& source = model_.lights[index];
        PunctualLight light;
        light.name = source.name.empty() ? name : source.name;
        const Rgb color = source.color.size() == 3
                              ? Rgb(float(source.color[0]), float(source.color[1]), float(source.color[2]))
                              : Rgb(1);
        light.intensity = color * float(source.intensity);
        if (!(is_finite(light.intensity) && std::min({light.intensity.r, light.intensity.g, light.intensity.b}) >= 0))
            throw input_error(node_where, fmt::format("its light's intensity is out of range (got {} times {} {} {}, "
                                                      "expected 0 or more)",
                                                      source.intensity, color.r, color.g, color.b));
        light.position = scene_from_node.translation;
        light.direction = Vec3(normalize(scene_from_node.vector({0, 0, -1})));
        light.inner_cone_angle = float(source.spot.innerConeAngle);
        light.outer_cone_angle = float(source.spot.outerConeAngle);
        if (source.type == "directional")
            light.kind = PunctualLight::Kind::directional;
        else if (source.type == "spot")
            light.kind = PunctualLight::Kind::spot;
        else if (source.type != "point")
            throw input_error(node_where,
                              fmt::format("its light has an unknown type (got \"{}\", expected point, spot or "
                                          "directional)",
                                          source.type));
        if (light.kind != PunctualLight::Kind::point && !is_finite(light.direction))
            throw input_error(node_where, "its transform leaves the light no direction (got a scale of 0)");
        if (source.range > 0)
            scene_.warnings.push_back(
                fmt::format("light \"{}\": its range is ignored, light falls off with distance "
                            "squared",
                            light.name));
        light.lamp = lamp_;
        scene_.lights.push_back(light);
    }

    const tinygltf::Model& model_;
    const std::string& where_;
    Scene& scene_;
    std::vector<int> first_part_;  // first Scene mesh of each glTF mesh, -1 = not read yet
    std::vector<int> part_count_ = std::vector<int>(first_part_.size(), 0);
    std::vector<bool> visited_;
    bool lamp_ = false;  // the node in hand or one above it is marked as a lamp
};

}  // namespace

Scene load_gltf(const std::string& path) {
    Scene scene;
    const tinygltf::Model model = parse_gltf(path, scene.warnings);
    scene.name = std::filesystem::path(path).stem().string();
    if (!model.animations.empty()) scene.warnings.push_back("animations are not supported and have no effect");

    read_materials(model, path, scene);
    if (model.scenes.empty()) throw input_error(path, "has no scene");
    const int chosen = model.defaultScene == -1 ? 0 : model.defaultScene;
    if (chosen < 0 || chosen >= int(model.scenes.size()))
        throw input_error(path,
                          fmt::format("scene does not exist (got {}, expected below {})", chosen, model.scenes.size()));
    NodeWalk walk(model, path, scene);
    for (const int node : model.scenes[chosen].nodes) walk.walk(node, Transform(), "");
    check(scene, path);
    rebase(scene);
    return scene;
}

}  // namespace pluvia
