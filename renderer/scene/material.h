// Material: how a surface looks, as glTF describes it, and the textures that it looks up. Part of Scene (scene.h);
// surface.h evaluates it at a hit.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/vec.h"

#include <limits>
#include <string>

namespace pluvia {

enum class Wrap { repeat, mirror, clamp };

/// A picture with the way it is looked up. Whether its bytes are sRGB or linear is decided by the slot that uses it.
/// There are no smaller copies for distant surfaces: a pixel's samples average what it covers.
struct Texture {
    int image = -1;  // index into Scene::images
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false;  // magnification filter; otherwise bilinear

    friend bool operator==(const Texture&, const Texture&) = default;
};

/// Place in the picture for a place in a uv set: offset + u column_u + v column_v.
struct UvTransform {
    Vec2 column_u = {1, 0}, column_v = {0, 1}, offset;

    Vec2 operator()(Vec2 uv) const { return offset + column_u * uv.x + column_v * uv.y; }
    friend bool operator==(const UvTransform&, const UvTransform&) = default;
};
/// Scaled first, then turned counter-clockwise as the picture is seen (v points down), then moved; rotation in radians.
/// Source: KHR_texture_transform, in the sense in which its test model and other readers have it.
UvTransform uv_transform(Vec2 offset, float rotation, Vec2 scale);
/// The three from a transform that was made of them, to rounding; a negative scale of u comes back as half a turn.
struct UvPlacement {
    Vec2 offset;
    float rotation;
    Vec2 scale;
};
UvPlacement uv_placement(const UvTransform& transform);

/// Where a material looks up one of its properties.
struct TextureSlot {
    int texture = -1;            // index into Scene::textures, -1 = none
    int uv_set = 0;              // 0 = Mesh::uvs, 1 = Mesh::uvs1
    bool has_transform = false;  // whether `transform` is applied
    UvTransform transform;

    TextureSlot(int texture_ = -1) : texture(texture_) {}
    bool used() const { return texture >= 0; }
    friend bool operator==(const TextureSlot&, const TextureSlot&) = default;
};

enum class AlphaMode { opaque, mask, blend };

/// glTF metallic-roughness material with its extensions. Textures multiply the factors. Occlusion is not among them: it
/// stands for shadowed light, which paths compute.
struct Material {
    std::string name;
    Rgb base_color = Rgb(1);
    float alpha = 1;
    float metallic = 1, roughness = 1;  // roughness is perceptual: GGX alpha is its square
    float specular = 1;                 // scales the reflectance of the dielectric at all angles
    Rgb specular_color = Rgb(1);        // scales it at normal incidence; 0 or more, the reflectance stays below 1
    float ior = 1.5f;
    float transmission = 0;          // share of light that passes or enters instead of meeting the diffuse lobe
    float thickness = 0;             // metres; 0: a thin sheet, above: a closed body, as thick as its mesh is
    Rgb attenuation_color = Rgb(1);  // what of white light is left in that body after attenuation_distance metres
    float attenuation_distance = std::numeric_limits<float>::infinity();
    float clearcoat = 0, clearcoat_roughness = 0;
    Rgb sheen_color = Rgb(0);
    float sheen_roughness = 0;
    float anisotropy = 0;                 // strength with which reflections are drawn out in one direction, 0 to 1
    float anisotropy_rotation = 0;        // of that direction from the tangent, radians counter-clockwise
    bool unlit = false;                   // shows base_color times Scene::unlit_luminance and reflects nothing
    Rgb emission;                         // cd/m2: emissive factor times strength
    TextureSlot base_color_texture = {};  // sRGB, alpha linear
    TextureSlot metallic_roughness_texture = {};   // linear: roughness in g, metallic in b
    TextureSlot normal_texture = {};               // linear, tangent space
    TextureSlot emission_texture = {};             // sRGB
    TextureSlot specular_texture = {};             // linear, in alpha
    TextureSlot specular_color_texture = {};       // sRGB
    TextureSlot transmission_texture = {};         // linear, in r
    TextureSlot clearcoat_texture = {};            // linear, in r
    TextureSlot clearcoat_roughness_texture = {};  // linear, in g
    TextureSlot clearcoat_normal_texture = {};     // as normal_texture, which does not move the coat
    TextureSlot sheen_color_texture = {};          // sRGB
    TextureSlot sheen_roughness_texture = {};      // linear, in alpha
    TextureSlot anisotropy_texture = {};           // linear: direction in r and g, strength in b
    float normal_scale = 1, clearcoat_normal_scale = 1;
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;
    bool double_sided = false;  // decides whether the back emits; seen and lit are all surfaces from both sides
    bool lamp = false;          // its emission can be switched: see lamps.h
    bool wet = true;            // takes water where the ground is wet

    bool emits() const { return !is_black(emission); }
    bool has_volume() const { return transmission > 0 && thickness > 0; }
    /// Whose texture coordinates tangents follow where a file brings none.
    const TextureSlot& tangent_slot() const { return normal_texture.used() ? normal_texture : anisotropy_texture; }
    bool is_layered() const { return clearcoat > 0 || !is_black(sheen_color); }

    /// Calls visit(slot, name in glTF) for each texture slot of a material.
    template <class M, class Visit>
    static void for_each_slot(M& m, Visit visit) {
        visit(m.base_color_texture, "baseColorTexture");
        visit(m.metallic_roughness_texture, "metallicRoughnessTexture");
        visit(m.normal_texture, "normalTexture");
        visit(m.emission_texture, "emissiveTexture");
        visit(m.specular_texture, "specularTexture");
        visit(m.specular_color_texture, "specularColorTexture");
        visit(m.transmission_texture, "transmissionTexture");
        visit(m.clearcoat_texture, "clearcoatTexture");
        visit(m.clearcoat_roughness_texture, "clearcoatRoughnessTexture");
        visit(m.clearcoat_normal_texture, "clearcoatNormalTexture");
        visit(m.sheen_color_texture, "sheenColorTexture");
        visit(m.sheen_roughness_texture, "sheenRoughnessTexture");
        visit(m.anisotropy_texture, "anisotropyTexture");
    }
};

}  // namespace pluvia
