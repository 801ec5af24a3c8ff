#include "renderer/scene/surface_bsdf.h"

namespace pluvia {
namespace {

struct MetalAndRoughness {
    float metallic, roughness;
};

MetalAndRoughness metal_and_roughness(const Scene& scene, const Material& material, const Triangle& t,
                                      Counters& counters) {
    MetalAndRoughness m{material.metallic, material.roughness};
    if (material.metallic_roughness_texture.used()) {
        const Vec3 stored = slot_linear(scene, material.metallic_roughness_texture, t);
        m.roughness *= stored.y;
        m.metallic *= stored.z;
        counters.count(Feature::texture);
    }
    return m;
}

float transmission_of(const Scene& scene, const Material& material, const Triangle& t, float metallic,
                      Counters& counters) {
    float transmission = material.transmission * (1 - metallic);
    if (material.transmission_texture.used()) {
        transmission *= slot_linear(scene, material.transmission_texture, t).x;
        counters.count(Feature::texture);
    }
    return transmission;
}

Bsdf transmitting_bsdf(const Material& material, Rgb color, float roughness, bool from_front, Counters& counters) {
    if (material.has_volume()) {
        counters.count(Feature::glass);
        return Glass{color, roughness, from_front ? material.ior : 1 / material.ior};
    }
    if (roughness <= min_roughness) {
        counters.count(Feature::pane);
        return Pane{color, material.ior};
    }
    counters.count(Feature::frosted_pane);
    return FrostedPane{color, roughness, material.ior};
}

}  // namespace

Rgb base_color(const Scene& scene, const Material& material, const Triangle& t, Counters& counters) {
    Rgb color = material.base_color;
    if (material.base_color_texture.used()) {
        color *= slot_color(scene, material.base_color_texture, t);
        counters.count(Feature::texture);
    }
    if (!t.mesh.colors.empty()) {
        color *= t.interpolate(t.mesh.colors);
        counters.count(Feature::vertex_color);
    }
    // Files may hold factors above 1; a surface that reflects more than it receives would never let a path end.
    return {std::clamp(color.r, 0.0f, 1.0f), std::clamp(color.g, 0.0f, 1.0f), std::clamp(color.b, 0.0f, 1.0f)};
}

float transmission_at(const Scene& scene, const Material& material, const Triangle& t, Counters& counters) {
    return transmission_of(scene, material, t, metal_and_roughness(scene, material, t, counters).metallic, counters);
}

Bsdf bsdf_at(const Scene& scene, const Material& material, const Triangle& t, bool from_front, float u,
             Counters& counters) {
    const Rgb color = base_color(scene, material, t, counters);
    const auto [metallic, roughness] = metal_and_roughness(scene, material, t, counters);
    if (material.transmission > 0 && u < transmission_of(scene, material, t, metallic, counters))
        return transmitting_bsdf(material, color, roughness, from_front, counters);
    MetallicRoughness m{color, metallic, roughness, material.specular, material.specular_color, material.ior};
    if (material.specular_texture.used()) {
        m.specular *= slot_alpha(scene, material.specular_texture, t);
        counters.count(Feature::texture);
    }
    if (material.specular_color_texture.used()) {
        m.specular_color *= slot_color(scene, material.specular_color_texture, t);
        counters.count(Feature::texture);
    }
    return m;
}

void add_layers(const Scene& scene, const Material& material, const Triangle& t, Vec3 coat_normal, Bsdf& bsdf,
                Counters& counters) {
    const auto* base = std::get_if<MetallicRoughness>(&bsdf);
    if (!base) return;
    Layered layered{.base = *base,
                    .sheen = {material.sheen_color, material.sheen_roughness},
                    .coat = material.clearcoat,
                    .coat_roughness = material.clearcoat_roughness,
                    .coat_normal = coat_normal};
    if (material.clearcoat_texture.used()) layered.coat *= slot_linear(scene, material.clearcoat_texture, t).x;
    if (material.clearcoat_roughness_texture.used())
        layered.coat_roughness *= slot_linear(scene, material.clearcoat_roughness_texture, t).y;
    if (material.sheen_color_texture.used()) layered.sheen.color *= slot_color(scene, material.sheen_color_texture, t);
    if (material.sheen_roughness_texture.used())
        layered.sheen.roughness *= slot_alpha(scene, material.sheen_roughness_texture, t);
    if (layered.coat > 0) counters.count(Feature::clearcoat);
    if (!is_black(layered.sheen.color)) counters.count(Feature::sheen);
    bsdf = layered;
}

}  // namespace pluvia
