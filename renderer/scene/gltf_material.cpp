#include "renderer/scene/gltf_material.h"

#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/gltf_lamp.h"

#include <fmt/format.h>

#include <algorithm>

namespace pluvia {
namespace {

Rgb rgb_from(const std::vector<double>& v, Rgb otherwise) {
    return v.size() >= 3 ? Rgb(float(v[0]), float(v[1]), float(v[2])) : otherwise;
}

/// A number inside a material's extension, or the value that the extension gives it when absent.
double extension_number(const tinygltf::Material& material, const char* extension, const char* key, double otherwise) {
    const auto found = material.extensions.find(extension);
    if (found == material.extensions.end() || !found->second.Has(key)) return otherwise;
    const tinygltf::Value& value = found->second.Get(key);
    return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

constexpr double max_ior = 1e6;  // reflects all but 4e-6

class MaterialReader {
public:
    MaterialReader(const tinygltf::Model& model, const std::string& where, Scene& scene)
        : model_(model), where_(where), scene_(scene) {}

    Material read(const tinygltf::Material& source) {
        Material m;
        m.name = source.name;
        m.lamp = is_marked_lamp(source.extras);
        const auto& pbr = source.pbrMetallicRoughness;
        m.base_color = rgb_from(pbr.baseColorFactor, Rgb(1));
        m.alpha = pbr.baseColorFactor.size() == 4 ? in_range(source, "alpha", pbr.baseColorFactor[3], 0, 1) : 1.0f;
        m.metallic = in_range(source, "metallicFactor", pbr.metallicFactor, 0, 1);
        m.roughness = in_range(source, "roughnessFactor", pbr.roughnessFactor, 0, 1);
        m.base_color_texture = texture(source, pbr.baseColorTexture, "base colour");
        m.metallic_roughness_texture = texture(source, pbr.metallicRoughnessTexture, "metallic-roughness");
        m.normal_texture = texture(source, source.normalTexture, "normal");
        m.normal_scale = float(source.normalTexture.scale);
        const double strength = extension_number(source, "KHR_materials_emissive_strength", "emissiveStrength", 1);
        if (source.emissiveFactor.size() == 3)
            m.emission = {emission(source, source.emissiveFactor[0] * strength),
                          emission(source, source.emissiveFactor[1] * strength),
                          emission(source, source.emissiveFactor[2] * strength)};
        m.emission_texture = texture(source, source.emissiveTexture, "emissive");
        m.specular = in_range(source, "specularFactor",
                              extension_number(source, "KHR_materials_specular", "specularFactor", 1), 0, 1);
        const double ior = extension_number(source, "KHR_materials_ior", "ior", 1.5);
        // 0 stands for a surface that reflects everything (KHR_materials_ior, for converted older materials).
        m.ior = in_range(source, "ior", ior == 0 ? max_ior : ior, 1, max_ior);
        m.transmission =
            in_range(source, "transmissionFactor",
                     extension_number(source, "KHR_materials_transmission", "transmissionFactor", 0), 0, 1);
        m.alpha_mode = source.alphaMode == "MASK"    ? AlphaMode::mask
                       : source.alphaMode == "BLEND" ? AlphaMode::blend
                                                     : AlphaMode::opaque;
        m.alpha_cutoff = float(source.alphaCutoff);
        m.double_sided = source.doubleSided;
        if (m.transmission > 0 && m.roughness > 0.1f)
            warn(source, "its transmission is rendered smooth, without its roughness");
        for (const auto& [name, value] : source.extensions)
            if (value.IsObject())
                for (const std::string& key : value.Keys())
                    if (key.ends_with("Texture")) warn(source, fmt::format("{} of {} is not supported", key, name));
        return m;
    }

private:
    /// The value, or the nearest that is allowed and a warning: a surface that reflects more than it receives would
    /// never let a path end.
    float in_range(const tinygltf::Material& material, const char* name, double value, double lower, double upper) {
        const double inside = std::clamp(value, lower, upper);
        if (inside != value)
            warn(material, fmt::format("its {} is out of range (got {}, expected {} to {}), {} is taken instead", name,
                                       value, lower, upper, inside));
        return float(inside);
    }
    float emission(const tinygltf::Material& material, double luminance) {
        return in_range(material, "emission", luminance, 0, 1e12);  // cd/m2; the sun has 1.6e9
    }

    template <class Info>
    int texture(const tinygltf::Material& material, const Info& info, const char* slot) {
        if (info.index == -1) return -1;
        if (info.index < 0 || info.index >= int(model_.textures.size()))
            throw input_error(fmt::format("{}: material \"{}\"", where_, material.name),
                              fmt::format("its {} texture does not exist (got {}, expected below {})", slot, info.index,
                                          model_.textures.size()));
        if (info.texCoord != 0)
            warn(material,
                 fmt::format("its {} texture uses TEXCOORD_{}, TEXCOORD_0 is taken instead", slot, info.texCoord));
        if (info.extensions.count("KHR_texture_transform"))
            warn(material, fmt::format("KHR_texture_transform of its {} texture is not supported", slot));
        return info.index;
    }

    void warn(const tinygltf::Material& material, const std::string& text) {
        scene_.warnings.push_back(fmt::format("material \"{}\": {}", material.name, text));
    }

    const tinygltf::Model& model_;
    const std::string& where_;
    Scene& scene_;
};

Wrap wrap_from(int gltf) {
    if (gltf == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    return gltf == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

Texture read_texture(const tinygltf::Model& model, const tinygltf::Texture& source, int index, const std::string& where,
                     Scene& scene) {
    if (source.source < 0 || source.source >= int(model.images.size()))
        throw input_error(fmt::format("{}: texture {}", where, index),
                          fmt::format("has no image that is supported (got {}, expected below {})", source.source,
                                      model.images.size()));
    Texture texture{.image = source.source};
    if (source.sampler >= 0 && source.sampler < int(model.samplers.size())) {
        const tinygltf::Sampler& sampler = model.samplers[source.sampler];
        texture.wrap_u = wrap_from(sampler.wrapS);
        texture.wrap_v = wrap_from(sampler.wrapT);
        texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    } else if (source.sampler != -1) {
        scene.warnings.push_back(fmt::format("texture {}: its sampler does not exist, the default is taken", index));
    }
    return texture;
}

}  // namespace

void read_materials(const tinygltf::Model& model, const std::string& where, Scene& scene) {
    for (size_t i = 0; i < model.images.size(); ++i) {
        const tinygltf::Image& image = model.images[i];
        const std::string image_where = fmt::format("{}: image {} \"{}\"", where, i, image.name);
        // The parser leaves the encoded bytes of data URIs and files in `image`, embedded ones in their buffer view.
        if (image.bufferView >= 0)
            scene.images.push_back(decode_rgba8(buffer_view_bytes(model, image.bufferView, image_where), image_where));
        else if (!image.image.empty())
            scene.images.push_back(decode_rgba8(std::as_bytes(std::span(image.image)), image_where));
        else
            throw input_error(
                image_where,
                fmt::format("its file cannot be read (got \"{}\", expected one beside the scene)", image.uri));
    }
    for (size_t i = 0; i < model.textures.size(); ++i)
        scene.textures.push_back(read_texture(model, model.textures[i], int(i), where, scene));
    MaterialReader reader(model, where, scene);
    for (const tinygltf::Material& material : model.materials) scene.materials.push_back(reader.read(material));
    scene.materials.push_back(reader.read(tinygltf::Material()));
    scene.materials.back().name = "default";
}

}  // namespace pluvia
