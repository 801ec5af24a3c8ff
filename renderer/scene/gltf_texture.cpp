#include "renderer/scene/gltf_texture.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf_accessor.h"
#include "renderer/scene/gltf_value.h"

#include <fmt/format.h>

#include <cmath>

namespace pluvia {
namespace {

/// Extensions whose object names the picture to take instead of the texture's own source.
constexpr const char* source_extensions[] = {"EXT_texture_webp", "MSFT_texture_dds"};

int chosen_image(const tinygltf::Texture& texture) {
    for (const char* name : source_extensions)
        if (const auto* extension = find(texture.extensions, name)) return index(find(extension, "source"));
    return texture.source;
}

Image<Rgba8> read_image(const tinygltf::Model& model, const tinygltf::Image& image, const std::string& where) {
    // The parser leaves the encoded bytes of data URIs and files in `image`, embedded ones in their buffer view.
    if (image.bufferView >= 0) return decode_rgba8(buffer_view_bytes(model, image.bufferView, where), where);
    if (!image.image.empty()) return decode_rgba8(std::as_bytes(std::span(image.image)), where);
    throw input_error(where,
                      fmt::format("its file cannot be read (got \"{}\", expected one beside the scene)", image.uri));
}

Wrap wrap_from(int gltf) {
    if (gltf == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
    return gltf == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

Texture read_texture(const tinygltf::Model& model, const tinygltf::Texture& source, int number,
                     const std::string& where, std::vector<std::string>& warnings) {
    Texture texture{.image = chosen_image(source)};
    if (texture.image < 0 || texture.image >= int(model.images.size()))
        throw input_error(fmt::format("{}: texture {}", where, number),
                          fmt::format("has no image that is supported (got {}, expected below {})", texture.image,
                                      model.images.size()));
    if (source.sampler >= 0 && source.sampler < int(model.samplers.size())) {
        const tinygltf::Sampler& sampler = model.samplers[source.sampler];
        texture.wrap_u = wrap_from(sampler.wrapS);
        texture.wrap_v = wrap_from(sampler.wrapT);
        texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    } else if (source.sampler != -1) {
        warnings.push_back(fmt::format("texture {}: its sampler does not exist, the default is taken", number));
    }
    return texture;
}

}  // namespace

void read_textures(const tinygltf::Model& model, const std::string& where, Scene& scene) {
    for (size_t i = 0; i < model.textures.size(); ++i)
        scene.textures.push_back(read_texture(model, model.textures[i], int(i), where, scene.warnings));
    scene.images.assign(model.images.size(), Image<Rgba8>(1, 1));
}

void read_pictures(const tinygltf::Model& model, const std::string& where, Scene& scene) {
    std::vector<bool> seen(scene.images.size());
    for (const Material& m : scene.materials)
        Material::for_each_slot(m, [&](const TextureSlot& slot, const char*) {
            if (slot.used()) seen[scene.textures[slot.texture].image] = true;
        });
    parallel_for(int(model.images.size()), [&](int i) {
        const tinygltf::Image& image = model.images[i];
        if (seen[i])
            scene.images[i] = read_image(model, image, fmt::format("{}: image {} \"{}\"", where, i, image.name));
    });
}

int add_roughness_of_glossiness(Scene& scene, int texture, std::vector<RoughnessPicture>& pictures, float glossiness) {
    Texture rough = scene.textures[texture];
    pictures.push_back({int(scene.images.size()), rough.image, glossiness});
    rough.image = pictures.back().image;
    scene.images.push_back(Image<Rgba8>(1, 1));
    scene.textures.push_back(rough);
    return int(scene.textures.size()) - 1;
}

void make_roughness(Scene& scene, const RoughnessPicture& picture) {
    Image<Rgba8> image = scene.images[picture.source];
    for (Rgba8& p : image.pixels) p = {0, uint8_t(std::lround(255 - picture.glossiness * float(p.a))), 0, 255};
    scene.images[picture.image] = std::move(image);
}

TextureSlot SlotReader::read(int texture, int uv_set, const tinygltf::Value* transform, const char* name) const {
    if (texture == -1) return {};
    if (texture < 0 || texture >= int(model.textures.size()))
        throw input_error(where + ": " + material,
                          fmt::format("its {}'s texture does not exist (got {}, expected below {})", name, texture,
                                      model.textures.size()));
    TextureSlot slot(texture);
    slot.uv_set = uv_set;
    if (transform) {
        slot.uv_set = int(number(find(transform, "texCoord"), uv_set));
        slot.transform =
            uv_transform(pair(find(transform, "offset"), {0, 0}), float(number(find(transform, "rotation"), 0)),
                         pair(find(transform, "scale"), {1, 1}));
        slot.has_transform = slot.transform != UvTransform();
    }
    if (slot.uv_set != 0 && slot.uv_set != 1) {
        warnings.push_back(
            fmt::format("{}: its {} uses TEXCOORD_{}, TEXCOORD_0 is taken instead", material, name, slot.uv_set));
        slot.uv_set = 0;
    }
    return slot;
}

TextureSlot SlotReader::read(const tinygltf::Value* extension, const char* name) const {
    const tinygltf::Value* info = find(extension, name);
    if (!info) return {};
    return read(index(find(info, "index")), int(number(find(info, "texCoord"), 0)),
                find(find(info, "extensions"), "KHR_texture_transform"), name);
}

}  // namespace pluvia
