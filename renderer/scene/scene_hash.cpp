#include "renderer/core/random.h"
#include "renderer/scene/scene.h"

#include <bit>
#include <span>
#include <type_traits>

namespace pluvia {
namespace {

/// Folds values one by one, each as its bits; field by field, since padding between fields holds anything.
class ContentHash {
public:
    void add(std::integral auto value) { hash_ = hash_key(hash_, uint64_t(value)); }
    void add(float value) { hash_ = hash_key(hash_, std::bit_cast<uint32_t>(value)); }
    void add(double value) { hash_ = hash_key(hash_, std::bit_cast<uint64_t>(value)); }
    template <class T>
    requires std::is_enum_v<T>
    void add(T value) { add(int(value)); }
    void add(Vec2 v) { add(v.x), add(v.y); }
    template <class T>
    void add(Vector3<T> v) {
        add(v.x), add(v.y), add(v.z);
    }
    void add(Rgb c) { add(c.r), add(c.g), add(c.b); }
    void add(Rgba8 c) { add(uint32_t(c.r) | uint32_t(c.g) << 8 | uint32_t(c.b) << 16 | uint32_t(c.a) << 24); }
    void add(const Tangent& t) { add(t.direction), add(t.sign); }
    void add(const std::array<uint32_t, 3>& t) { add(t[0]), add(t[1]), add(t[2]); }
    void add(const Transform& t) { add(t.column_x), add(t.column_y), add(t.column_z), add(t.translation); }
    template <class T>
    void add(const std::vector<T>& values) {
        add(values.size());
        for (const T& value : values) add(value);
    }
    void add(const Image<Rgba8>& image) { add(image.width), add(image.height), add(image.pixels); }
    void add(const Texture& t) { add(t.image), add(t.wrap_u), add(t.wrap_v), add(t.nearest); }
    void add(const TextureSlot& s) {
        add(s.texture), add(s.uv_set), add(s.has_transform);
        add(s.transform.column_u), add(s.transform.column_v), add(s.transform.offset);
    }
    void add(const Material& m) {
        add(m.base_color), add(m.alpha), add(m.metallic), add(m.roughness), add(m.specular), add(m.specular_color);
        add(m.ior), add(m.transmission), add(m.emission), add(m.normal_scale), add(m.alpha_mode), add(m.alpha_cutoff);
        add(m.double_sided), add(m.lamp), add(m.thickness), add(m.attenuation_color), add(m.attenuation_distance);
        add(m.clearcoat), add(m.clearcoat_roughness), add(m.clearcoat_normal_scale), add(m.sheen_color);
        add(m.sheen_roughness), add(m.anisotropy), add(m.anisotropy_rotation), add(m.unlit), add(m.wet);
        Material::for_each_slot(m, [&](const TextureSlot& slot, const char*) { add(slot); });
    }
    void add(const Mesh& m) {
        add(m.positions), add(m.normals), add(m.uvs), add(m.uvs1), add(m.tangents), add(m.colors), add(m.alphas);
        add(m.triangles), add(m.material);
    }
    void add(const Instance& i) {
        add(i.id), add(i.mesh), add(i.scene_from_object), add(i.lamp);
        add(i.semantic.size());
        for (const char c : i.semantic) add(c);
    }
    void add(const PunctualLight& l) {
        add(l.kind), add(l.intensity), add(l.position), add(l.direction);
        add(l.inner_cone_angle), add(l.outer_cone_angle), add(l.lamp);
    }
    uint64_t value() const { return hash_; }

private:
    uint64_t hash_ = 0;
};

}  // namespace

uint64_t content_hash(const Scene& scene) {
    ContentHash hash;
    hash.add(scene.origin), hash.add(scene.unlit_luminance);
    hash.add(scene.images), hash.add(scene.textures), hash.add(scene.materials), hash.add(scene.meshes);
    hash.add(scene.instances), hash.add(scene.lights);
    return hash.value();
}

}  // namespace pluvia
