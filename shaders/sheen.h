// Sheen: light that fibres standing on a cloth scatter towards grazing angles (KHR_materials_sheen).
// Conventions: bsdf_sample.h; layered.h puts it over a material.
// Source: Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF".
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/vec.h"

namespace pluvia {

/// Smallest perceptual roughness; smoother cloth is taken as this one: below it the model exists only within a degree
/// of the horizon.
constexpr float min_sheen_roughness = 0.1f;

struct Sheen {
    Rgb color = Rgb(0);   // 0 to 1; black: no sheen
    float roughness = 0;  // perceptual, 0 to 1
};

/// Reflectance of white fibres, 1/sr, without the cosine. Both directions above the surface.
/// alpha: square of the perceptual roughness.
float sheen_reflectance(float alpha, Vec3 wo, Vec3 wi);

/// Directional albedo of white fibres, at most 1, interpolated in a table that is built at first use.
/// mu: 0 to 1; roughness: min_sheen_roughness to 1.
float sheen_albedo(float mu, float roughness);

}  // namespace pluvia
