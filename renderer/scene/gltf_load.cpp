#include "renderer/scene/gltf.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/gltf_animation.h"
#include "renderer/scene/gltf_deform.h"
#include "renderer/scene/gltf_material.h"
#include "renderer/scene/gltf_mesh.h"
#include "renderer/scene/gltf_nodes.h"
#include "renderer/scene/gltf_parse.h"
#include "renderer/scene/gltf_variants.h"
#include "renderer/scene/open_volumes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

namespace pluvia {
namespace {

/// Of a node during the exposure.
struct Movement {
    Vec3d velocity, angular_velocity;  // m/s; rad/s
};

/// Adds what hangs on the nodes to the scene, each where it is at the time of the frame.
class SceneFiller {
public:
    SceneFiller(const tinygltf::Model& model, const std::string& where, const NodeTree& tree, Scene& scene)
        : model_(model), where_(where), tree_(tree), scene_(scene), budget_(model, where) {}

    /// posed: the file's nodes, as animations left them.
    void add_meshes(const std::vector<tinygltf::Node>& posed) {
        for (const PlacedNode& entry : tree_.nodes)
            if (posed[entry.node].mesh != -1) add_mesh(posed[entry.node], entry);
    }
    void add_lights() {
        for (const PlacedNode& entry : tree_.nodes)
            if (model_.nodes[entry.node].extensions.count("KHR_lights_punctual")) add_light(entry);
    }
    /// movements: of the nodes; empty = all rest.
    void add_cameras(const std::vector<Movement>& movements) {
        for (const PlacedNode& entry : tree_.nodes) {
            if (model_.nodes[entry.node].camera == -1 || !add_camera(entry) || movements.empty()) continue;
            scene_.cameras.back().velocity = movements[entry.node].velocity;
            scene_.cameras.back().angular_velocity = movements[entry.node].angular_velocity;
        }
    }

    std::vector<std::string> labelled_paths() && { return std::move(labelled_paths_); }

private:
    struct Parts {
        int first = 0, count = 0;
    };

    std::string node_where(const std::string& path) const { return fmt::format("{}: node \"{}\"", where_, path); }

    void add_mesh(const tinygltf::Node& node, const PlacedNode& entry) {
        if (node.mesh < 0 || node.mesh >= int(model_.meshes.size()))
            throw input_error(node_where(entry.path), fmt::format("mesh does not exist (got {}, expected below {})",
                                                                  node.mesh, model_.meshes.size()));
        Deformation deformation;
        deformation.weights = node.weights.empty() ? model_.meshes[node.mesh].weights : node.weights;
        Transform placed = tree_.scene_from_node[entry.node];
        if (node.skin != -1) {
            // The joints alone place a skinned mesh. Its vertices are kept near zero for the sake of single precision.
            placed = translate(skin_origin(node.skin));
            deformation.joints = skin_joints(model_, node.skin, tree_.scene_from_node, tree_.is_placed,
                                             placed.translation, node_where(entry.path));
        }
        const Parts parts = read_once(node, std::move(deformation));
        const auto instancing = node.extensions.find("EXT_mesh_gpu_instancing");
        if (instancing == node.extensions.end()) {
            add_instances(entry, entry.path, parts, placed, entry.path.substr(0, entry.labelled));
            return;
        }
        const auto copies = read_copies(instancing->second, node_where(entry.path));
        for (size_t i = 0; i < copies.size(); ++i) {
            const std::string path = fmt::format("{}[{}]", entry.path, i);
            add_instances(entry, path, parts, placed * copies[i], path);
        }
    }

    Vec3d skin_origin(int skin) const {
        const bool exists = skin >= 0 && skin < int(model_.skins.size()) && !model_.skins[skin].joints.empty();
        const int joint = exists ? model_.skins[skin].joints[0] : -1;
        const bool is_placed = joint >= 0 && joint < int(tree_.is_placed.size()) && tree_.is_placed[joint];
        return is_placed ? tree_.scene_from_node[joint].translation : Vec3d();  // skin_joints() says what is wrong
    }

    /// Nodes share a mesh unless skins or weights shape it differently.
    Parts read_once(const tinygltf::Node& node, Deformation deformation) {
        const auto [found, is_new] = parts_.try_emplace({node.mesh, node.skin, deformation.weights});
        if (!is_new) return found->second;
        auto meshes = read_mesh(model_, node.mesh, deformation, where_, budget_, scene_);
        found->second = {int(scene_.meshes.size()), int(meshes.size())};
        std::move(meshes.begin(), meshes.end(), std::back_inserter(scene_.meshes));
        return found->second;
    }

    void add_instances(const PlacedNode& entry, const std::string& path, const Parts& parts,
                       const Transform& scene_from_object, const std::string& labelled_path) {
        for (int part = 0; part < parts.count; ++part) {
            budget_.spend(sizeof(Instance) + path.size() + entry.semantic.size() + sizeof labelled_path +
                          labelled_path.size());
            labelled_paths_.push_back(labelled_path);
            scene_.instances.push_back(
                {path, instance_id(path), parts.first + part, scene_from_object, entry.is_lamp, entry.semantic});
        }
    }

    /// Transforms of the copies of EXT_mesh_gpu_instancing, relative to their node.
    std::vector<Transform> read_copies(const tinygltf::Value& extension, const std::string& where) {
        const auto accessor = [&](const char* key) {
            if (!extension.Has("attributes") || !extension.Get("attributes").Has(key)) return -1;
            const tinygltf::Value& index = extension.Get("attributes").Get(key);
            return index.IsInt() && index.GetNumberAsInt() >= 0 ? index.GetNumberAsInt() : -2;
        };
        const int translation = accessor("TRANSLATION"), rotation = accessor("ROTATION"), scaling = accessor("SCALE");
        size_t count = 0;
        bool is_first = true;
        for (const int index : {translation, rotation, scaling}) {
            if (index == -1) continue;
            const size_t n = element_count(model_, index, where);
            if (!is_first && n != count)
                throw input_error(
                    where,
                    fmt::format("its EXT_mesh_gpu_instancing accessors differ in length (got {} and {})", count, n));
            count = n, is_first = false;
        }
        if (is_first) throw input_error(where, "its EXT_mesh_gpu_instancing has no TRANSLATION, ROTATION or SCALE");
        budget_.spend(count * sizeof(Transform));
        std::vector<Transform> copies(count);
        if (scaling != -1) {
            const auto s = read_floats(model_, scaling, 3, where);
            for (size_t i = 0; i < count; ++i) copies[i] = scale({s[3 * i], s[3 * i + 1], s[3 * i + 2]});
        }
        if (rotation != -1) {
            const auto q = read_floats(model_, rotation, 4, where);
            for (size_t i = 0; i < count; ++i) {
                const float* r = &q[4 * i];
                if (r[0] == 0 && r[1] == 0 && r[2] == 0 && r[3] == 0)
                    throw input_error(
                        where, fmt::format("accessor {}: rotation {} is not a quaternion (got 0 0 0 0)", rotation, i));
                copies[i] = rotate(r[0], r[1], r[2], r[3]) * copies[i];
            }
        }
        if (translation != -1) {
            const auto t = read_floats(model_, translation, 3, where);
            for (size_t i = 0; i < count; ++i) copies[i].translation = {t[3 * i], t[3 * i + 1], t[3 * i + 2]};
        }
        return copies;
    }

    /// False where the camera is of a kind that is not supported.
    bool add_camera(const PlacedNode& entry) {
        const int index = model_.nodes[entry.node].camera;
        const Transform& scene_from_node = tree_.scene_from_node[entry.node];
        const std::string where = node_where(entry.name);
        if (index < 0 || index >= int(model_.cameras.size()))
            throw input_error(
                where, fmt::format("camera does not exist (got {}, expected below {})", index, model_.cameras.size()));
        if (scene_from_node.determinant() == 0)
            throw input_error(where, "its transform leaves the camera no direction (got a scale of 0)");
        const tinygltf::Camera& source = model_.cameras[index];
        if (source.type != "perspective") {
            scene_.warnings.push_back(
                fmt::format("camera \"{}\": {} projection is not supported", entry.name, source.type));
            return false;
        }
        const auto& lens = source.perspective;
        if (!(lens.yfov > 0 && lens.yfov < std::numbers::pi))
            throw input_error(where, fmt::format("its camera's yfov is out of range (got {}, expected above 0 and "
                                                 "below pi)",
                                                 lens.yfov));
        // The parser gives 0 for what is absent; what is rendered does not depend on these.
        if (!(lens.znear > 0))
            throw input_error(where,
                              fmt::format("its camera's znear is out of range (got {}, expected above 0)", lens.znear));
        if (lens.zfar < 0 || (lens.zfar > 0 && lens.zfar <= lens.znear))
            throw input_error(where,
                              fmt::format("its camera's zfar is out of range (got {}, expected above its znear, {})",
                                          lens.zfar, lens.znear));
        if (lens.aspectRatio < 0)
            throw input_error(where, fmt::format("its camera's aspectRatio is out of range (got {}, expected above 0)",
                                                 lens.aspectRatio));
        scene_.cameras.push_back({source.name.empty() ? entry.name : source.name, scene_from_node, lens.yfov, {}});
        return true;
    }

    void add_light(const PlacedNode& entry) {
        const Transform& scene_from_node = tree_.scene_from_node[entry.node];
        const tinygltf::Value& reference = model_.nodes[entry.node].extensions.at("KHR_lights_punctual").Get("light");
        const int index = reference.IsInt() ? reference.GetNumberAsInt() : -1;
        const std::string where = node_where(entry.name);
        if (index < 0 || index >= int(model_.lights.size()))
            throw input_error(
                where, fmt::format("light does not exist (got {}, expected below {})", index, model_.lights.size()));
        const tinygltf::Light& source = model_.lights[index];
        PunctualLight light;
        light.name = source.name.empty() ? entry.name : source.name;
        const Rgb color = source.color.size() == 3
                              ? Rgb(float(source.color[0]), float(source.color[1]), float(source.color[2]))
                              : Rgb(1);
        light.intensity = color * float(source.intensity);
        if (!(is_finite(light.intensity) && std::min({light.intensity.r, light.intensity.g, light.intensity.b}) >= 0))
            throw input_error(where, fmt::format("its light's intensity is out of range (got {} times {} {} {}, "
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
            throw input_error(where, fmt::format("its light has an unknown type (got \"{}\", expected point, spot or "
                                                 "directional)",
                                                 source.type));
        if (light.kind != PunctualLight::Kind::point && !is_finite(light.direction))
            throw input_error(where, "its transform leaves the light no direction (got a scale of 0)");
        const bool is_cone = light.inner_cone_angle >= 0 && light.inner_cone_angle <= light.outer_cone_angle &&
                             light.outer_cone_angle > 0 && light.outer_cone_angle <= pi;
        if (light.kind == PunctualLight::Kind::spot && !is_cone)
            throw input_error(
                where, fmt::format("its light's cone angles are out of range (got {} and {}, expected 0 to pi, the "
                                   "inner within the outer)",
                                   light.inner_cone_angle, light.outer_cone_angle));
        if (source.range > 0)
            scene_.warnings.push_back(
                fmt::format("light \"{}\": its range is ignored, light falls off with distance squared", light.name));
        light.lamp = entry.is_lamp;
        scene_.lights.push_back(light);
    }

    const tinygltf::Model& model_;
    const std::string& where_;
    const NodeTree& tree_;
    Scene& scene_;
    MemoryBudget budget_;
    std::map<std::tuple<int, int, std::vector<double>>, Parts> parts_;  // of mesh, skin and weights
    std::vector<std::string> labelled_paths_;                           // of the scene's instances
};

/// Angular velocity of a frame that is turned from one to the other in so many seconds, by less than half a turn.
Vec3d angular_velocity(const Transform& before, const Transform& after, double seconds) {
    const auto axes = [](const Transform& t) {
        const Vec3d z = normalize(t.column_z), x = normalize(cross(t.column_y, z));
        return std::array<Vec3d, 3>{x, cross(z, x), z};
    };
    const auto a = axes(before), b = axes(after);
    Vec3d sine;  // of the angle, along the axis
    double trace = 0;
    for (size_t i = 0; i < 3; ++i) sine += cross(a[i], b[i]) * 0.5, trace += dot(a[i], b[i]);
    const double s = length(sine);
    return s > 0 ? sine * (std::atan2(s, (trace - 1) / 2) / (s * seconds)) : Vec3d();
}

/// Mean movements of the nodes over the exposure; what is before the first key or after the last does not count.
std::vector<Movement> node_movements(const Animations& animations, const NodeTree& tree, const tinygltf::Model& model,
                                     const GltfSettings& settings) {
    const double first = std::max(settings.time - settings.exposure_time / 2, animations.start());
    const double last = std::min(settings.time + settings.exposure_time / 2, animations.end());
    if (animations.empty() || !(last > first)) return {};
    std::vector<tinygltf::Node> nodes = model.nodes;
    animations.pose(first, nodes);
    const auto before = place_again(tree, nodes);
    animations.pose(last, nodes);
    const auto after = place_again(tree, nodes);
    std::vector<Movement> movements(before.size());
    for (size_t i = 0; i < movements.size(); ++i)
        movements[i] = {(after[i].translation - before[i].translation) / (last - first),
                        angular_velocity(before[i], after[i], last - first)};
    return movements;
}

/// A centre that does not move with the animation, so that rain and positions agree from frame to frame: that of the
/// places where meshes rest.
Vec3d resting_centre(const NodeTree& tree, const tinygltf::Model& model) {
    const auto resting = place_again(tree, model.nodes);
    Bounds box;
    for (const PlacedNode& entry : tree.nodes)
        if (model.nodes[entry.node].mesh != -1) box.add(resting[entry.node].translation);
    return box.empty() ? Vec3d() : (box.lower + box.upper) * 0.5;
}

GltfContents contents_of(const tinygltf::Model& model, const std::string& where) {
    GltfContents contents;
    contents.nodes = int(model.nodes.size());
    for (const tinygltf::Animation& animation : model.animations) {
        auto& entry = contents.animations.emplace_back();
        entry.name = animation.name;
        for (const tinygltf::AnimationSampler& sampler : animation.samplers)
            for (const float time : read_floats(model, sampler.input, 1, where))
                entry.duration = std::max<double>(entry.duration, time);
    }
    contents.variants = variant_names(model);
    for (const std::string& name : model.extensionsUsed) {
        const auto& required = model.extensionsRequired;
        const bool is_required = std::find(required.begin(), required.end(), name) != required.end();
        contents.extensions.push_back({name, is_required, is_supported_extension(name)});
    }
    return contents;
}

}  // namespace

Scene load_gltf(const std::string& path, const GltfSettings& settings, GltfContents* contents) {
    Scene scene;
    tinygltf::Model model = parse_gltf(path, settings, scene.warnings);
    if (!settings.variant.empty()) choose_variant(model, settings.variant, path);
    scene.name = std::filesystem::path(path).stem().string();
    read_materials(model, path, scene, settings.pictures);
    if (model.scenes.empty()) throw input_error(path, "has no scene");
    const int chosen = model.defaultScene == -1 ? 0 : model.defaultScene;
    if (chosen < 0 || chosen >= int(model.scenes.size()))
        throw input_error(path,
                          fmt::format("scene does not exist (got {}, expected below {})", chosen, model.scenes.size()));
    const Animations animations(model, path, scene.warnings);
    std::vector<tinygltf::Node> posed;
    if (!animations.empty()) {
        posed = model.nodes;
        animations.pose(settings.time, posed);
    }
    const std::vector<tinygltf::Node>& nodes = animations.empty() ? model.nodes : posed;
    const NodeTree tree = place_nodes(nodes, model.scenes[chosen].nodes, path);
    SceneFiller filler(model, path, tree, scene);
    filler.add_meshes(nodes);
    filler.add_cameras(node_movements(animations, tree, model, settings));
    filler.add_lights();
    if (contents) {
        *contents = contents_of(model, path);
        contents->labelled_paths = std::move(filler).labelled_paths();
    }
    check(scene, path);
    make_open_volumes_thin(scene);
    if (animations.empty())
        rebase(scene);
    else
        rebase(scene, resting_centre(tree, model));
    return scene;
}

}  // namespace pluvia
