#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include "renderer/scene/gltf_save_material.h"

#include "renderer/scene/gltf_extras.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

using Value = tinygltf::Value;
using Object = Value::Object;

Value array(std::initializer_list<float> numbers) {
    Value::Array values;
    for (const float n : numbers) values.emplace_back(double(n));
    return Value(values);
}
Value array(Rgb c) {
    return array({c.r, c.g, c.b});
}

class MaterialWriter {
public:
    MaterialWriter(const Material& m, const std::function<void(const std::string&)>& use) : m_(m), use_(use) {}

    tinygltf::Material write() {
        entry_.name = m_.name;
        auto& pbr = entry_.pbrMetallicRoughness;
        pbr.baseColorFactor = {m_.base_color.r, m_.base_color.g, m_.base_color.b, m_.alpha};
        pbr.metallicFactor = m_.metallic;
        pbr.roughnessFactor = m_.roughness;
        write_slot(pbr.baseColorTexture, m_.base_color_texture);
        write_slot(pbr.metallicRoughnessTexture, m_.metallic_roughness_texture);
        write_slot(entry_.normalTexture, m_.normal_texture);
        entry_.normalTexture.scale = m_.normal_scale;
        write_slot(entry_.emissiveTexture, m_.emission_texture);
        // Factors above one are not allowed in core glTF; the strength carries the luminance.
        const double strength = std::max(1.0, double(max_component(m_.emission)));
        entry_.emissiveFactor = {m_.emission.r / strength, m_.emission.g / strength, m_.emission.b / strength};
        if (strength > 1) add("KHR_materials_emissive_strength", "emissiveStrength", Value(strength));
        write_extensions();
        entry_.alphaMode = m_.alpha_mode == AlphaMode::mask    ? "MASK"
                           : m_.alpha_mode == AlphaMode::blend ? "BLEND"
                                                               : "OPAQUE";
        // The cutoff means nothing in the other modes, and a file that states it there is not valid.
        if (m_.alpha_mode == AlphaMode::mask) entry_.alphaCutoff = m_.alpha_cutoff;
        entry_.doubleSided = m_.double_sided;
        entry_.extras = marks(m_.lamp, !m_.wet);
        for (auto& [name, object] : extensions_) {
            entry_.extensions[name] = Value(object);
            use_(name);
        }
        return entry_;
    }

private:
    void write_extensions() {
        const Material standard;
        if (m_.ior != standard.ior) add("KHR_materials_ior", "ior", m_.ior);
        if (m_.specular != standard.specular) add("KHR_materials_specular", "specularFactor", m_.specular);
        if (m_.specular_color != standard.specular_color)
            add("KHR_materials_specular", "specularColorFactor", array(m_.specular_color));
        add("KHR_materials_specular", "specularTexture", m_.specular_texture);
        add("KHR_materials_specular", "specularColorTexture", m_.specular_color_texture);
        if (m_.transmission != standard.transmission)
            add("KHR_materials_transmission", "transmissionFactor", m_.transmission);
        add("KHR_materials_transmission", "transmissionTexture", m_.transmission_texture);
        if (m_.thickness > 0) {
            const std::string volume = "KHR_materials_volume";
            add(volume, "thicknessFactor", m_.thickness);
            add(volume, "attenuationColor", array(m_.attenuation_color));
            if (std::isfinite(m_.attenuation_distance)) add(volume, "attenuationDistance", m_.attenuation_distance);
        }
        if (m_.clearcoat > 0) {
            const std::string coat = "KHR_materials_clearcoat";
            add(coat, "clearcoatFactor", m_.clearcoat);
            add(coat, "clearcoatRoughnessFactor", m_.clearcoat_roughness);
            add(coat, "clearcoatTexture", m_.clearcoat_texture);
            add(coat, "clearcoatRoughnessTexture", m_.clearcoat_roughness_texture);
            add(coat, "clearcoatNormalTexture", m_.clearcoat_normal_texture, m_.clearcoat_normal_scale);
        }
        if (!is_black(m_.sheen_color)) {
            const std::string sheen = "KHR_materials_sheen";
            add(sheen, "sheenColorFactor", array(m_.sheen_color));
            add(sheen, "sheenRoughnessFactor", m_.sheen_roughness);
            add(sheen, "sheenColorTexture", m_.sheen_color_texture);
            add(sheen, "sheenRoughnessTexture", m_.sheen_roughness_texture);
        }
        if (m_.anisotropy > 0) {
            const std::string anisotropy = "KHR_materials_anisotropy";
            add(anisotropy, "anisotropyStrength", m_.anisotropy);
            add(anisotropy, "anisotropyRotation", m_.anisotropy_rotation);
            add(anisotropy, "anisotropyTexture", m_.anisotropy_texture);
        }
        if (m_.unlit) extensions_["KHR_materials_unlit"];
    }

    void add(const std::string& extension, const std::string& key, Value value) {
        extensions_[extension][key] = std::move(value);
    }
    void add(const std::string& extension, const std::string& key, float value) {
        add(extension, key, Value(double(value)));
    }
    void add(const std::string& extension, const std::string& key, const TextureSlot& slot, float scale = 1) {
        if (!slot.used()) return;
        Object info = {{"index", Value(slot.texture)}, {"texCoord", Value(slot.uv_set)}};
        if (slot.has_transform) info["extensions"] = Value(Object{{"KHR_texture_transform", transform(slot)}});
        if (scale != 1) info["scale"] = Value(double(scale));
        add(extension, key, Value(info));
    }

    template <class Info>
    void write_slot(Info& info, const TextureSlot& slot) {
        info.index = slot.texture;
        info.texCoord = slot.uv_set;
        if (slot.used() && slot.has_transform) info.extensions["KHR_texture_transform"] = transform(slot);
    }
    Value transform(const TextureSlot& slot) {
        use_("KHR_texture_transform");
        const UvPlacement p = uv_placement(slot.transform);
        return Value(Object{{"offset", array({p.offset.x, p.offset.y})},
                            {"rotation", Value(double(p.rotation))},
                            {"scale", array({p.scale.x, p.scale.y})}});
    }

    const Material& m_;
    const std::function<void(const std::string&)>& use_;
    tinygltf::Material entry_;
    std::map<std::string, Object> extensions_;
};

}  // namespace

tinygltf::Material gltf_material(const Material& material,
                                 const std::function<void(const std::string&)>& use_extension) {
    return MaterialWriter(material, use_extension).write();
}

}  // namespace pluvia
