#include "renderer/scene/gltf_material.h"

#include "renderer/scene/gltf_lamp.h"
#include "renderer/scene/gltf_texture.h"
#include "renderer/scene/gltf_value.h"

#include <fmt/format.h>

#include <algorithm>

namespace pluvia {
namespace {

constexpr double max_ior = 1e6;  // reflects all but 4e-6

Rgb rgb_from(const std::vector<double>& v, Rgb otherwise) {
    return v.size() >= 3 ? Rgb(float(v[0]), float(v[1]), float(v[2])) : otherwise;
}

class MaterialReader {
public:
    MaterialReader(const tinygltf::Model& model, const tinygltf::Material& source, const std::string& where,
                   Scene& scene)
        : source_(source),
          scene_(scene),
          slots_{model, where, fmt::format("material \"{}\"", source.name), scene.warnings} {}

    Material read() {
        m_.name = source_.name;
        m_.lamp = is_marked_lamp(source_.extras);
        read_core();
        read_emission();
        read_specular();
        read_transmission();
        return m_;
    }

private:
    void read_core() {
        const auto& pbr = source_.pbrMetallicRoughness;
        m_.base_color = rgb_from(pbr.baseColorFactor, Rgb(1));
        m_.alpha = pbr.baseColorFactor.size() == 4 ? in_range("alpha", pbr.baseColorFactor[3], 0, 1) : 1.0f;
        m_.metallic = in_range("metallicFactor", pbr.metallicFactor, 0, 1);
        m_.roughness = in_range("roughnessFactor", pbr.roughnessFactor, 0, 1);
        m_.base_color_texture = slots_.read(pbr.baseColorTexture, "baseColorTexture");
        m_.metallic_roughness_texture = slots_.read(pbr.metallicRoughnessTexture, "metallicRoughnessTexture");
        m_.normal_texture = slots_.read(source_.normalTexture, "normalTexture");
        m_.normal_scale = float(source_.normalTexture.scale);
        m_.alpha_mode = source_.alphaMode == "MASK"    ? AlphaMode::mask
                        : source_.alphaMode == "BLEND" ? AlphaMode::blend
                                                       : AlphaMode::opaque;
        m_.alpha_cutoff = float(source_.alphaCutoff);
        m_.double_sided = source_.doubleSided;
    }

    void read_emission() {
        const double strength = number(find(extension("KHR_materials_emissive_strength"), "emissiveStrength"), 1);
        if (source_.emissiveFactor.size() == 3)
            m_.emission = {emission(source_.emissiveFactor[0] * strength),
                           emission(source_.emissiveFactor[1] * strength),
                           emission(source_.emissiveFactor[2] * strength)};
        m_.emission_texture = slots_.read(source_.emissiveTexture, "emissiveTexture");
    }

    void read_specular() {
        const auto* specular = extension("KHR_materials_specular");
        m_.specular = in_range("specularFactor", number(find(specular, "specularFactor"), 1), 0, 1);
        m_.specular_texture = slots_.read(specular, "specularTexture");
        const Rgb tint = color(find(specular, "specularColorFactor"), Rgb(1));
        m_.specular_color = {in_range("specularColorFactor", tint.r, 0, 1e6),
                             in_range("specularColorFactor", tint.g, 0, 1e6),
                             in_range("specularColorFactor", tint.b, 0, 1e6)};
        m_.specular_color_texture = slots_.read(specular, "specularColorTexture");
        const double ior = number(find(extension("KHR_materials_ior"), "ior"), 1.5);
        // 0 stands for a surface that reflects everything (KHR_materials_ior, for converted older materials).
        m_.ior = in_range("ior", ior == 0 ? max_ior : ior, 1, max_ior);
    }

    void read_transmission() {
        const auto* transmission = extension("KHR_materials_transmission");
        m_.transmission = in_range("transmissionFactor", number(find(transmission, "transmissionFactor"), 0), 0, 1);
        m_.transmission_texture = slots_.read(transmission, "transmissionTexture");
        if (m_.transmission > 0 && m_.roughness > 0.1f)
            warn("its transmission is rendered smooth, without its roughness");
    }

    const tinygltf::Value* extension(const char* name) const { return find(source_.extensions, name); }

    /// The value, or the nearest that is allowed and a warning: a surface that reflects more than it receives would
    /// never let a path end.
    float in_range(const char* name, double value, double lower, double upper) {
        const double inside = std::clamp(value, lower, upper);
        if (inside != value)
            warn(fmt::format("its {} is out of range (got {}, expected {} to {}), {} is taken instead", name, value,
                             lower, upper, inside));
        return float(inside);
    }
    float emission(double luminance) {
        return in_range("emission", luminance, 0, 1e12);  // cd/m2; the sun has 1.6e9
    }

    void warn(const std::string& text) { scene_.warnings.push_back(slots_.material + ": " + text); }

    const tinygltf::Material& source_;
    Scene& scene_;
    SlotReader slots_;
    Material m_;
};

}  // namespace

void read_materials(const tinygltf::Model& model, const std::string& where, Scene& scene) {
    read_textures(model, where, scene);
    for (const tinygltf::Material& material : model.materials)
        scene.materials.push_back(MaterialReader(model, material, where, scene).read());
    tinygltf::Material standard;
    standard.name = "default";
    scene.materials.push_back(MaterialReader(model, standard, where, scene).read());
}

}  // namespace pluvia
