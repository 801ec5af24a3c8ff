// Pictures and textures of a glTF file, and where materials look them up.
#pragma once

#include "renderer/scene/gltf_value.h"
#include "renderer/scene/scene.h"

#include <tiny_gltf.h>

namespace pluvia {

/// Fills Scene::images and textures in the file's order. Of a texture that comes in several formats the one that
/// EXT_texture_webp or MSFT_texture_dds names is taken; pictures that only serve as the fallback of such textures are
/// not decoded and stay black texels. where: the file, for messages.
void read_textures(const tinygltf::Model& model, const std::string& where, Scene& scene, bool pictures);

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

/// Adds a texture whose green is 1 - glossiness times the alpha of another, and returns its index.
int add_roughness_of_glossiness(Scene& scene, int texture, float glossiness);

}  // namespace pluvia
