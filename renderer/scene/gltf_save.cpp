// Writing of .glb files: every mesh and picture once, one node per instance. The counterpart of gltf_load.cpp.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include "renderer/scene/gltf.h"

#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "renderer/image/pending_file.h"
#include "renderer/scene/gltf_arrays.h"
#include "renderer/scene/gltf_extras.h"
#include "renderer/scene/gltf_save_material.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <span>
#include <tuple>

namespace pluvia {
namespace {

std::vector<double> numbers(Rgb c) {
    return {c.r, c.g, c.b};
}

std::vector<double> matrix_of(const Transform& t) {  // column-major
    return {t.column_x.x, t.column_x.y, t.column_x.z, 0, t.column_y.x,    t.column_y.y,    t.column_y.z,    0,
            t.column_z.x, t.column_z.y, t.column_z.z, 0, t.translation.x, t.translation.y, t.translation.z, 1};
}

/// Rotation of orthonormal columns as (x, y, z, w). Source: Shepperd 1978, by the largest of the four components.
std::vector<double> quaternion(const Transform& t) {
    const Vec3d x = t.column_x, y = t.column_y, z = t.column_z;
    std::array<double, 4> q;
    const double trace = x.x + y.y + z.z, largest = std::max({x.x, y.y, z.z, trace});
    if (largest == trace)
        q = {y.z - z.y, z.x - x.z, x.y - y.x, 1 + trace};
    else if (largest == x.x)
        q = {1 + x.x - y.y - z.z, x.y + y.x, z.x + x.z, y.z - z.y};
    else if (largest == y.y)
        q = {x.y + y.x, 1 - x.x + y.y - z.z, y.z + z.y, z.x - x.z};
    else
        q = {z.x + x.z, y.z + z.y, 1 - x.x - y.y + z.z, x.y - y.x};
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

/// Vertex colours as bytes where these hold them exactly, else nothing.
std::vector<Rgba8> as_bytes(const Mesh& mesh) {
    std::vector<Rgba8> bytes;
    if (!mesh.alphas.empty()) return bytes;
    bytes.reserve(mesh.colors.size());
    for (const Rgb c : mesh.colors) {
        const auto byte = [](float v) { return v >= 0 && v <= 1 ? uint8_t(std::lround(255 * v)) : uint8_t(0); };
        const Rgba8 b = {byte(c.r), byte(c.g), byte(c.b), 0};
        if (Rgb(float(b.r) / 255, float(b.g) / 255, float(b.b) / 255) != c) return {};
        bytes.push_back(b);
    }
    return bytes;
}

/// Gathers the file's parts; everything binary goes into its one buffer.
class GlbWriter : GlbArrays {
public:
    GlbWriter(const Scene& scene, const std::vector<NodeMotion>& motions) : scene_(scene) {
        for (const NodeMotion& motion : motions) motions_[motion.path] = &motion;
        model_.asset.version = "2.0";
        model_.asset.generator = "Pluvia";
        model_.buffers.resize(1);
        model_.defaultScene = 0;
        model_.scenes.resize(1);
        model_.scenes[0].name = scene.name;
        for (const Image<Rgba8>& image : scene.images) add_image(image);
        for (const Texture& texture : scene.textures) add_texture(texture);
        for (const Material& material : scene.materials) add_material(material);
        for (const Mesh& mesh : scene.meshes) add_mesh(mesh);
        for (const Instance& instance : scene.instances) add_instance(instance);
        for (const PunctualLight& light : scene.lights) add_light(light);
        for (const Camera& camera : scene.cameras) add_camera(camera);
        std::sort(model_.extensionsUsed.begin(), model_.extensionsUsed.end());
    }
    const tinygltf::Model& model() const { return model_; }

private:
    void use_extension(const std::string& name) {
        auto& used = model_.extensionsUsed;
        if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
    }

    void add_image(const Image<Rgba8>& image) {
        const std::vector<std::byte> png = encode_png(image);
        tinygltf::Image entry;
        entry.bufferView = add_view(std::span(png), 0);
        entry.mimeType = "image/png";
        model_.images.push_back(entry);
    }

    void add_texture(const Texture& texture) {
        const auto wrap = [](Wrap w) {
            return w == Wrap::clamp    ? TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE
                   : w == Wrap::mirror ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT
                                       : TINYGLTF_TEXTURE_WRAP_REPEAT;
        };
        tinygltf::Sampler sampler;
        sampler.wrapS = wrap(texture.wrap_u);
        sampler.wrapT = wrap(texture.wrap_v);
        sampler.magFilter = texture.nearest ? TINYGLTF_TEXTURE_FILTER_NEAREST : TINYGLTF_TEXTURE_FILTER_LINEAR;
        const auto found = std::find(model_.samplers.begin(), model_.samplers.end(), sampler);
        tinygltf::Texture entry;
        entry.source = texture.image;
        entry.sampler = int(found - model_.samplers.begin());
        if (found == model_.samplers.end()) model_.samplers.push_back(sampler);
        model_.textures.push_back(entry);
    }

    void add_material(const Material& material) {
        model_.materials.push_back(gltf_material(material, [this](const std::string& name) { use_extension(name); }));
    }

    void add_mesh(const Mesh& mesh) {
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = mesh.material;
        std::vector<float> p;
        Vec3 lower = mesh.positions[0], upper = lower;
        for (const Vec3 v : mesh.positions) {
            p.insert(p.end(), {v.x, v.y, v.z});
            lower = min(lower, v), upper = max(upper, v);
        }
        const int position = add_floats(p, 3);
        model_.accessors[position].minValues = {lower.x, lower.y, lower.z};
        model_.accessors[position].maxValues = {upper.x, upper.y, upper.z};
        primitive.attributes["POSITION"] = position;
        std::vector<float> n, uv, uv1, t, c;
        for (const Vec3 v : mesh.normals) n.insert(n.end(), {v.x, v.y, v.z});
        for (const Vec2 v : mesh.uvs) uv.insert(uv.end(), {v.x, v.y});
        for (const Vec2 v : mesh.uvs1) uv1.insert(uv1.end(), {v.x, v.y});
        for (const Tangent& v : mesh.tangents) t.insert(t.end(), {v.direction.x, v.direction.y, v.direction.z, v.sign});
        for (size_t i = 0; i < mesh.colors.size(); ++i) {
            c.insert(c.end(), {mesh.colors[i].r, mesh.colors[i].g, mesh.colors[i].b});
            if (!mesh.alphas.empty()) c.push_back(mesh.alphas[i]);
        }
        if (!n.empty()) primitive.attributes["NORMAL"] = add_floats(n, 3);
        if (!uv.empty()) primitive.attributes["TEXCOORD_0"] = add_floats(uv, 2);
        if (!uv1.empty()) primitive.attributes["TEXCOORD_1"] = add_floats(uv1, 2);
        if (!t.empty()) primitive.attributes["TANGENT"] = add_floats(t, 4);
        if (const auto bytes = as_bytes(mesh); !bytes.empty())
            primitive.attributes["COLOR_0"] = add_colors(bytes);
        else if (!c.empty())
            primitive.attributes["COLOR_0"] = add_floats(c, mesh.alphas.empty() ? 3 : 4);
        primitive.indices = add_indices(mesh);
        tinygltf::Mesh entry;
        entry.name = mesh.name;
        entry.primitives.push_back(primitive);
        model_.meshes.push_back(entry);
    }

    /// Appends a node under `parent`, -1 = the scene itself.
    int add_node(const tinygltf::Node& node, int parent) {
        model_.nodes.push_back(node);
        const int index = int(model_.nodes.size()) - 1;
        (parent < 0 ? model_.scenes[0].nodes : model_.nodes[parent].children).push_back(index);
        return index;
    }

    /// The node that stands for a path's folders, made on first use; -1 for the empty path.
    int group(const std::string& path) {
        if (path.empty()) return -1;
        const auto found = groups_.find(path);
        if (found != groups_.end()) return found->second;
        const size_t slash = path.rfind('/');
        tinygltf::Node node;
        node.name = path.substr(slash + 1);  // npos + 1 = 0: the whole path
        return groups_[path] = add_node(node, group(slash == std::string::npos ? "" : path.substr(0, slash)));
    }

    void add_instance(const Instance& instance) {
        const size_t slash = instance.name.rfind('/');
        tinygltf::Node node;
        node.name = instance.name.substr(slash + 1);
        node.mesh = instance.mesh;
        const int parent = group(slash == std::string::npos ? "" : instance.name.substr(0, slash));
        node.extras = marks(instance.lamp);
        const auto found = motions_.find(instance.name);
        const NodeMotion* motion = found == motions_.end() ? nullptr : found->second;
        const std::string& object = motion && !motion->object.empty() ? motion->object : instance.name;
        if (!instance.semantic.empty()) {
            tinygltf::Value& extras = &object == &instance.name ? node.extras : model_.nodes[group(object)].extras;
            mark_semantic(extras, instance.semantic, number_in_class(instance.semantic, object));
        }
        if (motion) {
            place_rigidly(node, motion->scene_from_object[0]);
            const int index = add_node(node, parent);
            moving_nodes_.try_emplace(motion->path, index);
            add_motion(*motion, index);
        } else {
            node.matrix = matrix_of(in_file(instance.scene_from_object));
            add_node(node, parent);
        }
    }

    /// As nodes that move must be, which may not have a matrix.
    void place_rigidly(tinygltf::Node& node, const Transform& scene_from_object) const {
        const Transform placed = in_file(scene_from_object);
        node.translation = {placed.translation.x, placed.translation.y, placed.translation.z};
        node.rotation = quaternion(placed);
    }

    void add_motion(const NodeMotion& motion, int node) {
        std::vector<float> positions, rotations;
        std::vector<double> before;
        for (const Transform& key : motion.scene_from_object) {
            const Vec3d p = key.translation + scene_.origin;
            positions.insert(positions.end(), {float(p.x), float(p.y), float(p.z)});
            std::vector<double> q = quaternion(key);
            // A rotation has two quaternions; that next to the one before is the shorter way.
            if (!before.empty() && q[0] * before[0] + q[1] * before[1] + q[2] * before[2] + q[3] * before[3] < 0)
                for (double& v : q) v = -v;
            rotations.insert(rotations.end(), q.begin(), q.end());
            before = q;
        }
        tinygltf::Animation entry;
        entry.name = motion.path;
        const int input = add_times(motion.times);
        for (const auto& [values, components, path] :
             {std::tuple{&positions, 3, "translation"}, {&rotations, 4, "rotation"}}) {
            // What never turns keeps the rotation of its node.
            if (components == 4 && std::equal(values->begin() + components, values->end(), values->begin())) continue;
            tinygltf::AnimationSampler sampler;
            sampler.input = input;
            sampler.output = add_floats(*values, components, 0);
            sampler.interpolation = "LINEAR";
            tinygltf::AnimationChannel channel;
            channel.sampler = int(entry.samplers.size());
            channel.target_node = node;
            channel.target_path = path;
            entry.samplers.push_back(sampler);
            entry.channels.push_back(channel);
        }
        model_.animations.push_back(entry);
    }

    int add_times(const std::vector<float>& times) {
        const int accessor = add_floats(times, 1, 0);
        model_.accessors[accessor].minValues = {*std::min_element(times.begin(), times.end())};
        model_.accessors[accessor].maxValues = {*std::max_element(times.begin(), times.end())};
        return accessor;
    }

    /// Objects of a class are counted from 0 in the order in which they first appear; the parts of one share a number.
    int number_in_class(const std::string& semantic, const std::string& object) {
        auto& numbers = numbers_in_class_[semantic];
        return numbers.try_emplace(object, int(numbers.size())).first->second;
    }

    void add_light(const PunctualLight& light) {
        tinygltf::Light entry;
        entry.name = light.name;
        entry.type = light.kind == PunctualLight::Kind::point  ? "point"
                     : light.kind == PunctualLight::Kind::spot ? "spot"
                                                               : "directional";
        // Colours are limited to 0..1 as emissive factors are.
        const double strength = max_component(light.intensity);
        entry.intensity = strength;
        for (const double channel : numbers(light.intensity))
            entry.color.push_back(strength > 0 ? channel / strength : 1.0);
        entry.spot.innerConeAngle = light.inner_cone_angle;
        entry.spot.outerConeAngle = light.outer_cone_angle;
        model_.lights.push_back(entry);

        const ShadingBasis basis(-light.direction);  // lights shine along their node's -z
        const Transform placed = {Vec3d(basis.tangent), Vec3d(basis.bitangent), Vec3d(basis.normal), light.position};
        tinygltf::Node node;
        node.name = light.name;
        node.matrix = matrix_of(in_file(placed));
        int parent = -1;
        const size_t slash = std::min(light.name.rfind('/'), light.name.size());
        const auto moving = moving_nodes_.find(light.name.substr(0, slash));
        if (moving != moving_nodes_.end() && slash < light.name.size()) {
            node.name = light.name.substr(slash + 1);
            node.matrix = matrix_of(inverse(motions_.at(moving->first)->scene_from_object[0]) * placed);
            parent = moving->second;
        }
        node.extensions["KHR_lights_punctual"] =
            tinygltf::Value(tinygltf::Value::Object{{"light", tinygltf::Value(int(model_.lights.size()) - 1)}});
        use_extension("KHR_lights_punctual");
        node.extras = marks(light.lamp);
        add_node(node, parent);
    }

    void add_camera(const Camera& camera) {
        tinygltf::Camera entry;
        entry.name = camera.name;
        entry.type = "perspective";
        entry.perspective.yfov = camera.vertical_fov;
        entry.perspective.znear = 0.01;
        entry.perspective.zfar = 1000;  // tinygltf always writes it, and the default 0 is not valid
        model_.cameras.push_back(entry);
        tinygltf::Node node;
        node.name = camera.name;
        node.camera = int(model_.cameras.size()) - 1;
        const auto motion = motions_.find(camera.name);
        if (motion == motions_.end() && camera.path.empty()) {
            node.matrix = matrix_of(in_file(camera.scene_from_camera));
            add_node(node, -1);
            return;
        }
        place_rigidly(node, camera.scene_from_camera);
        add_motion(motion != motions_.end() ? *motion->second : motion_along(camera), add_node(node, -1));
    }

    /// Along its path, without turning.
    static NodeMotion motion_along(const Camera& camera) {
        NodeMotion motion{camera.name, "", {}, {}};
        for (const CameraKey& key : camera.path) {
            motion.times.push_back(key.time);
            motion.scene_from_object.push_back(camera.scene_from_camera);
            motion.scene_from_object.back().translation = key.position;
        }
        return motion;
    }

    Transform in_file(Transform scene_from_object) const {
        scene_from_object.translation += scene_.origin;
        return scene_from_object;
    }

    const Scene& scene_;
    std::map<std::string, const NodeMotion*> motions_;  // by path
    std::map<std::string, int> groups_;
    std::map<std::string, int> moving_nodes_;  // by path; the first where an instance has several meshes
    std::map<std::string, std::map<std::string, int>> numbers_in_class_;  // by class, then by path
};

}  // namespace

void save_glb(const Scene& scene, const std::string& path, const std::vector<NodeMotion>& motions) {
    check(scene, path);
    for (const Mesh& mesh : scene.meshes)
        if (mesh.triangles.empty())
            throw input_error(
                path, fmt::format("mesh \"{}\" cannot be written (got 0 triangles, expected at least 1)", mesh.name));
    const GlbWriter writer(scene, motions);
    PendingFile file(path);
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&writer.model(), file.stream(), false, true);
    file.commit();
}

}  // namespace pluvia
