#include "renderer/scene/gltf_deform.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf_accessor.h"

#include <fmt/format.h>

namespace pluvia {
namespace {

int find(const std::map<std::string, int>& attributes, const std::string& key) {
    const auto found = attributes.find(key);
    return found == attributes.end() ? -1 : found->second;
}

Vec3 unit_or(Vec3 v, Vec3 otherwise) {
    const Vec3 unit = normalize(v);
    return is_finite(unit) ? unit : otherwise;
}

/// Offsets of one attribute of a morph target, one per vertex; empty when the target has none.
std::vector<Vec3> offsets(const tinygltf::Model& model, const std::map<std::string, int>& target, const char* key,
                          size_t count, const std::string& where) {
    const int accessor = find(target, key);
    if (accessor == -1) return {};
    if (const size_t n = element_count(model, accessor, where); n != count)
        throw input_error(where, fmt::format("{} has the wrong length (got {}, expected {})", key, n, count));
    return read_elements<Vec3>(model, accessor, where);
}

Transform weighted_sum(const std::vector<Transform>& joints,
                       const std::vector<std::pair<uint32_t, float>>& influences) {
    double total = 0;
    Transform sum{{}, {}, {}, {}};
    for (const auto& [joint, weight] : influences) {
        const Transform& t = joints[joint];
        const double w = weight;
        sum.column_x += t.column_x * w, sum.column_y += t.column_y * w, sum.column_z += t.column_z * w;
        sum.translation += t.translation * w;
        total += w;
    }
    if (!(total > 0)) return joints[influences.empty() ? 0 : influences[0].first];
    return {sum.column_x / total, sum.column_y / total, sum.column_z / total, sum.translation / total};
}

}  // namespace

void apply_morph_targets(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                         const std::vector<double>& weights, const std::string& where, Mesh& mesh) {
    bool moved = false;
    for (size_t k = 0; k < primitive.targets.size() && k < weights.size(); ++k) {
        const float weight = float(weights[k]);
        if (weight == 0) continue;
        moved = true;
        const std::string target_where = fmt::format("{}: morph target {}", where, k);
        const auto& target = primitive.targets[k];
        const size_t count = mesh.positions.size();
        const auto positions = offsets(model, target, "POSITION", count, target_where);
        for (size_t i = 0; i < positions.size(); ++i) mesh.positions[i] += positions[i] * weight;
        if (mesh.normals.empty()) continue;
        const auto normals = offsets(model, target, "NORMAL", count, target_where);
        for (size_t i = 0; i < normals.size(); ++i) mesh.normals[i] += normals[i] * weight;
        if (mesh.tangents.empty()) continue;
        const auto tangents = offsets(model, target, "TANGENT", count, target_where);
        for (size_t i = 0; i < tangents.size(); ++i) mesh.tangents[i].direction += tangents[i] * weight;
    }
    if (!moved) return;
    for (Vec3& n : mesh.normals) n = unit_or(n, n);
    for (Tangent& t : mesh.tangents) t.direction = unit_or(t.direction, t.direction);
}

void apply_skin(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                const std::vector<Transform>& joints, const std::string& where, Mesh& mesh) {
    struct Set {
        std::vector<float> joints, weights;
    };
    std::vector<Set> sets;
    for (int n = 0;; ++n) {
        const int j = find(primitive.attributes, fmt::format("JOINTS_{}", n));
        const int w = find(primitive.attributes, fmt::format("WEIGHTS_{}", n));
        if (j == -1 || w == -1) break;
        sets.push_back({read_floats(model, j, 4, where), read_floats(model, w, 4, where)});
        for (const size_t size : {sets.back().joints.size(), sets.back().weights.size()})
            if (size != 4 * mesh.positions.size())
                throw input_error(
                    where, fmt::format("JOINTS_{} or WEIGHTS_{} has the wrong length (got {}, expected {})", n, n,
                                       size / 4, mesh.positions.size()));
    }
    if (sets.empty()) throw input_error(where, "is skinned but has no JOINTS_0 and WEIGHTS_0");
    std::vector<std::pair<uint32_t, float>> influences;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        influences.clear();
        for (const Set& set : sets)
            for (size_t k = 4 * i; k < 4 * i + 4; ++k) {
                if (set.weights[k] == 0) continue;
                if (!(set.joints[k] >= 0 && set.joints[k] < float(joints.size())))
                    throw input_error(
                        where, fmt::format("vertex {} names a joint that its skin does not have (got {}, expected "
                                           "below {})",
                                           i, set.joints[k], joints.size()));
                influences.push_back({uint32_t(set.joints[k]), set.weights[k]});
            }
        const Transform t = weighted_sum(joints, influences);
        mesh.positions[i] = Vec3(t.point(Vec3d(mesh.positions[i])));
        if (!mesh.normals.empty()) mesh.normals[i] = unit_or(Vec3(t.normal(Vec3d(mesh.normals[i]))), mesh.normals[i]);
        if (!mesh.tangents.empty())
            mesh.tangents[i].direction =
                unit_or(Vec3(t.vector(Vec3d(mesh.tangents[i].direction))), mesh.tangents[i].direction);
    }
}

std::vector<Transform> skin_joints(const tinygltf::Model& model, int index,
                                   const std::vector<Transform>& scene_from_node, const std::vector<bool>& is_placed,
                                   Vec3d space_origin, const std::string& where) {
    if (index < 0 || index >= int(model.skins.size()))
        throw input_error(where,
                          fmt::format("skin does not exist (got {}, expected below {})", index, model.skins.size()));
    const tinygltf::Skin& skin = model.skins[index];
    const std::string skin_where = fmt::format("{}: skin {} \"{}\"", where, index, skin.name);
    if (skin.joints.empty()) throw input_error(skin_where, "has no joints");
    std::vector<float> matrices;  // column-major; none: all are the identity
    if (skin.inverseBindMatrices != -1) {
        matrices = read_floats(model, skin.inverseBindMatrices, 16, skin_where);
        if (matrices.size() < 16 * skin.joints.size())
            throw input_error(skin_where, fmt::format("has too few inverse bind matrices (got {}, expected {})",
                                                      matrices.size() / 16, skin.joints.size()));
    }
    std::vector<Transform> joints;
    for (size_t i = 0; i < skin.joints.size(); ++i) {
        const int node = skin.joints[i];
        if (node < 0 || node >= int(is_placed.size()) || !is_placed[node])
            throw input_error(skin_where, fmt::format("its joint {} is not a node of the scene (got {})", i, node));
        Transform bind;
        if (!matrices.empty()) {
            const float* m = &matrices[16 * i];
            bind = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
        }
        joints.push_back(translate(-space_origin) * scene_from_node[node] * bind);
    }
    return joints;
}

}  // namespace pluvia
