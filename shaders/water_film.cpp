#include "shaders/water_film.h"

#include "renderer/core/units.h"

#include <algorithm>

namespace pluvia {
namespace {

float mixed(float a, float b, float t) {
    return a + (b - a) * t;
}

/// Perceptual roughness of the film's surface over a base of this roughness. Water is smooth over what is finer than
/// the film is thick, a few tenths of a millimetre, and follows what is coarser, which is more of a rough base.
float film_roughness(float base_roughness, const WaterCover& water) {
    const float film = (0.12f + 0.3f * base_roughness * base_roughness) * (1 + 0.5f * water.uneven);
    return std::min(base_roughness, film) * (1 - water.pool);
}

/// 1 where the surface has pores that water darkens, 0 where it is polished.
float soaked(const MetallicRoughness& m, const WaterCover& water) {
    if (m.specular == 0) return water.any();  // no interface of its own: matt at any roughness
    return water.any() * std::clamp((m.roughness - 0.1f) / 0.3f, 0.0f, 1.0f) * (1 - m.metallic);
}

MetallicRoughness darkened(MetallicRoughness m, const WaterCover& water) {
    m.base_color = mix(m.base_color, wet_albedo(m.base_color), soaked(m, water));
    return m;
}

Layered under_coat(const MetallicRoughness& base, const WaterCover& water) {
    return {.base = darkened(base, water),
            .sheen = {},
            .coat = water.any(),
            .coat_roughness = film_roughness(base.roughness, water),
            .coat_ior = water_ior};
}

Bsdf wet(const MetallicRoughness& dry, const WaterCover& water) {
    if (dry.metallic > 0) return under_coat(dry, water);
    MetallicRoughness m = darkened(dry, water);
    const float cover = water.any();
    // What is below the film's interface is nearly matched by the water: only the film's own reflection is left.
    m.roughness = mixed(dry.roughness, film_roughness(dry.roughness, water), cover);
    m.ior = mixed(dry.ior, water_ior, cover);
    m.specular = mixed(dry.specular, 1, cover);
    m.specular_color = mix(dry.specular_color, Rgb(1), cover);
    m.anisotropy.strength = dry.anisotropy.strength * (1 - cover);
    return m;
}

Bsdf wet(const Layered& dry, const WaterCover& water) {
    Layered m = dry;
    const float cover = water.any();
    m.sheen.color = dry.sheen.color * (1 - cover);
    if (dry.coat == 0) {
        const Layered film = under_coat(dry.base, water);
        m.base = film.base;
        m.coat = film.coat, m.coat_roughness = film.coat_roughness, m.coat_ior = film.coat_ior;
        return m;
    }
    m.coat = mixed(dry.coat, 1, cover);
    m.coat_roughness = mixed(dry.coat_roughness, film_roughness(dry.coat_roughness, water), cover);
    m.coat_ior = mixed(dry.coat_ior, water_ior, cover);
    return m;
}

template <class Model>
Bsdf wet(const Model& dry, const WaterCover&) {
    return dry;
}

float wet_albedo(float dry) {
    constexpr float reflected = 0.0664f;  // of diffuse light, from above: Fresnel's equations for n = 1.333
    constexpr float held = 1 - (1 - reflected) / (water_ior * water_ior);
    return dry * (1 - held) / (1 - held * dry);
}

}  // namespace

Rgb wet_albedo(Rgb dry) {
    return {wet_albedo(dry.r), wet_albedo(dry.g), wet_albedo(dry.b)};
}

Bsdf under_water(const Bsdf& dry, const WaterCover& water) {
    if (water.any() <= 0) return dry;
    return std::visit([&](const auto& model) { return wet(model, water); }, dry);
}

}  // namespace pluvia
