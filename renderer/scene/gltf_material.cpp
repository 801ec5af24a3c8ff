#include "renderer/scene/gltf_material.h"

#include "renderer/scene/gltf_extras.h"
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
                   Scene& scene, std::vector<RoughnessPicture>& roughness_pictures)
        : source_(source),
          scene_(scene),
          roughness_pictures_(roughness_pictures),
          slots_{model, where, fmt::format("material \"{}\"", source.name), scene.warnings} {}

    Material read() {
        m_.name = source_.name;
        m_.lamp = is_marked_lamp(source_.extras);
        m_.wet = !is_marked_dry(source_.extras);
        read_core();
        read_emission();
        read_specular();
        read_transmission();
        read_layers();
        read_anisotropy();
        m_.unlit = extension("KHR_materials_unlit") != nullptr;
        if (const auto* old = extension("KHR_materials_pbrSpecularGlossiness")) read_specular_glossiness(old);
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
        m_.specular_color = in_range("specularColorFactor", color(find(specular, "specularColorFactor"), Rgb(1)), 1e6);
        m_.specular_color_texture = slots_.read(specular, "specularColorTexture");
        const double ior = number(find(extension("KHR_materials_ior"), "ior"), 1.5);
        // 0 stands for a surface that reflects everything (KHR_materials_ior, for converted older materials).
        m_.ior = in_range("ior", ior == 0 ? max_ior : ior, 1, max_ior);
    }

    void read_transmission() {
        const auto* transmission = extension("KHR_materials_transmission");
        m_.transmission = in_range("transmissionFactor", number(find(transmission, "transmissionFactor"), 0), 0, 1);
        m_.transmission_texture = slots_.read(transmission, "transmissionTexture");
        const auto* volume = extension("KHR_materials_volume");
        m_.thickness = in_range("thicknessFactor", number(find(volume, "thicknessFactor"), 0), 0, 1e9);
        m_.attenuation_color = in_range("attenuationColor", color(find(volume, "attenuationColor"), Rgb(1)), 1);
        if (const auto* distance = find(volume, "attenuationDistance"))
            m_.attenuation_distance = in_range("attenuationDistance", number(distance, 1e9), 1e-9, 1e9);
    }

    void read_layers() {
        const auto* coat = extension("KHR_materials_clearcoat");
        m_.clearcoat = in_range("clearcoatFactor", number(find(coat, "clearcoatFactor"), 0), 0, 1);
        m_.clearcoat_texture = slots_.read(coat, "clearcoatTexture");
        m_.clearcoat_roughness =
            in_range("clearcoatRoughnessFactor", number(find(coat, "clearcoatRoughnessFactor"), 0), 0, 1);
        m_.clearcoat_roughness_texture = slots_.read(coat, "clearcoatRoughnessTexture");
        m_.clearcoat_normal_texture = slots_.read(coat, "clearcoatNormalTexture");
        m_.clearcoat_normal_scale = float(number(find(find(coat, "clearcoatNormalTexture"), "scale"), 1));
        const auto* sheen = extension("KHR_materials_sheen");
        m_.sheen_color = in_range("sheenColorFactor", color(find(sheen, "sheenColorFactor"), Rgb(0)), 1);
        m_.sheen_color_texture = slots_.read(sheen, "sheenColorTexture");
        m_.sheen_roughness = in_range("sheenRoughnessFactor", number(find(sheen, "sheenRoughnessFactor"), 0), 0, 1);
        m_.sheen_roughness_texture = slots_.read(sheen, "sheenRoughnessTexture");
    }

    void read_anisotropy() {
        const auto* anisotropy = extension("KHR_materials_anisotropy");
        m_.anisotropy = in_range("anisotropyStrength", number(find(anisotropy, "anisotropyStrength"), 0), 0, 1);
        m_.anisotropy_rotation =
            in_range("anisotropyRotation", number(find(anisotropy, "anisotropyRotation"), 0), -1000, 1000);
        m_.anisotropy_texture = slots_.read(anisotropy, "anisotropyTexture");
    }

    /// The older workflow is a dielectric whose reflectance is given as a colour, which an infinite index of refraction
    /// times a specular colour says exactly; glossiness is what roughness lacks to 1.
    void read_specular_glossiness(const tinygltf::Value* old) {
        warn("KHR_materials_pbrSpecularGlossiness is converted to a dielectric with coloured reflection");
        m_.base_color = color(find(old, "diffuseFactor"), Rgb(1));
        m_.alpha = in_range("alpha", number(find(old, "diffuseFactor"), 3, 1), 0, 1);
        m_.base_color_texture = slots_.read(old, "diffuseTexture");
        m_.metallic = 0, m_.ior = float(max_ior), m_.specular = 1;
        m_.specular_color = in_range("specularFactor", color(find(old, "specularFactor"), Rgb(1)), 1);
        const float glossiness = in_range("glossinessFactor", number(find(old, "glossinessFactor"), 1), 0, 1);
        m_.roughness = 1 - glossiness;
        m_.metallic_roughness_texture = {};
        m_.specular_color_texture = slots_.read(old, "specularGlossinessTexture");
        if (!m_.specular_color_texture.used()) return;
        m_.metallic_roughness_texture = m_.specular_color_texture;
        m_.metallic_roughness_texture.texture =
            add_roughness_of_glossiness(scene_, m_.specular_color_texture.texture, roughness_pictures_, glossiness);
        m_.roughness = 1;
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
    Rgb in_range(const char* name, Rgb value, double upper) {
        return {in_range(name, value.r, 0, upper), in_range(name, value.g, 0, upper),
                in_range(name, value.b, 0, upper)};
    }
    float emission(double luminance) {
        return in_range("emission", luminance, 0, 1e12);  // cd/m2; the sun has 1.6e9
    }

    void warn(const std::string& text) { scene_.warnings.push_back(slots_.material + ": " + text); }

    const tinygltf::Material& source_;
    Scene& scene_;
    std::vector<RoughnessPicture>& roughness_pictures_;
    SlotReader slots_;
    Material m_;
};

}  // namespace

void read_materials(const tinygltf::Model& model, const std::string& where, Scene& scene, bool pictures) {
    read_textures(model, where, scene);
    std::vector<RoughnessPicture> roughness_pictures;
    for (const tinygltf::Material& material : model.materials)
        scene.materials.push_back(MaterialReader(model, material, where, scene, roughness_pictures).read());
    tinygltf::Material standard;
    standard.name = "default";
    scene.materials.push_back(MaterialReader(model, standard, where, scene, roughness_pictures).read());
    if (!pictures) return;
    read_pictures(model, where, scene);
    for (const RoughnessPicture& picture : roughness_pictures) make_roughness(scene, picture);
}

}  // namespace pluvia
