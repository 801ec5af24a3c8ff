// Pictures and textures of a glTF file, and where materials look them up.
#pragma once

#include "renderer/scene/gltf_value.h"
#include "renderer/scene/scene.h"

#include <tiny_gltf.h>

namespace pluvia {

/// Fills Scene::textures in the file's order, and Scene::images with black texels. Of a texture that comes in several
/// formats the one that EXT_texture_webp or MSFT_texture_dds names is taken. where: the file, for messages.
void read_textures(const tinygltf::Model& model, const std::string& where, Scene& scene);

/// Decodes the pictures that Scene::materials look at. Others stay black texels: those of occlusion maps, which have no
/// effect, and the fallbacks of textures that come in another format.
void read_pictures(const tinygltf::Model& model, const std::string& where, Scene& scene);

/// Reads the slots of one material. Uv sets beyond the second are named in a warning and the first is taken.
struct SlotReader {
    const tinygltf::Model& model;
    const std::string& where;    // the file
    const std::string material;  // as messages name it
    std::vector<std::string>& warnings;

    /// A slot of the core specification. name: of the slot, for messages.
    template <class Info>
    TextureSlot read(const Info& info, const char* name) const {
        return read(info.index, info.texCoord, find(info.extensions, "KHR_texture_transform"), name);
    }
    /// The textureInfo `name` inside an extension; null: an unused slot.
    TextureSlot read(const tinygltf::Value* extension, const char* name) const;

private:
    TextureSlot read(int texture, int uv_set, const tinygltf::Value* transform, const char* name) const;
};

/// A picture whose green is 1 - glossiness times the alpha of another; both are indices of Scene::images.
struct RoughnessPicture {
    int image, source;
    float glossiness;
};
/// Adds a texture of such a picture of another texture's, to be made when that is decoded, and returns its index.
int add_roughness_of_glossiness(Scene& scene, int texture, std::vector<RoughnessPicture>& pictures, float glossiness);
void make_roughness(Scene& scene, const RoughnessPicture& picture);

}  // namespace pluvia
