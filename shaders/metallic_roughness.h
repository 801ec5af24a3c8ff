// The metallic-roughness material of glTF: a rough metal, or a rough dielectric coat over a diffuse base, or a mixture
// of the two by `metallic`. All are reciprocal; nothing is lost to missing multiple scattering: with a white base
// colour the surface reflects all it receives, unless its dielectric reflection is coloured: what reaches the base is
// what the strongest channel leaves, so that the base is not seen in the complementary colour (KHR_materials_specular).
// Conventions: bsdf_sample.h; the microfacet distributions: microfacet.h, anisotropy.h.
#pragma once

#include "shaders/anisotropy.h"
#include "shaders/bsdf_sample.h"
#include "shaders/microfacet.h"

#include <optional>

namespace pluvia {

struct MetallicRoughness {
    Rgb base_color = Rgb(1);  // reflectance of metal and of the diffuse base, 0 to 1
    float metallic = 0;       // share of the surface that is metal, 0 to 1
    float roughness = 1;      // perceptual, 0 to 1; its square is the width alpha of the microfacet distribution
    float specular = 1;       // strength of the dielectric reflection (KHR_materials_specular), 0 to 1; 0: pure Lambert
    Rgb specular_color = Rgb(1);  // of that reflection at normal incidence, >= 0
    float ior = 1.5f;             // of the dielectric coat, >= 1
    Anisotropy anisotropy = {};   // of the microfacets
};

/// A MetallicRoughness seen from one direction: what depends on wo alone is computed once for all wi.
struct PreparedMetallicRoughness {
    Vec3 wo;
    bool lambert = false;  // no specular reflection at all: only `diffuse` and `wo` are used
    // Probabilities with which sample() draws as each lobe does.
    float specular_chance = 0, diffuse_chance = 0, multiple_chance = 0;
    float reflected = 0;  // about the luminance of what returns in all directions, by which layers share out chances
    Rgb f0;               // Schlick's reflectance at normal incidence
    float f90 = 0;        // and at grazing
    Ggx ggx;              // of anisotropic microfacets, `ggx` and `albedo` are as wide as their widest direction
    GgxView view;
    GgxAlbedoRow albedo;
    AnisotropicGgx anisotropic;  // used instead where it is
    Rgb multiple;                // multiple scattering: f = multiple (1 - E(wi)), 1/sr
    Rgb diffuse;                 // diffuse base: f = diffuse (1 - E_d(wi)), 1/sr; Lambert: f itself
    // Albedo of the coat as a linear function of the tabulated ones: E_d = constant + lost_slope lost + ...
    float coat_constant = 0, coat_lost_slope = 0, coat_grazing_slope = 0;

    /// Albedos of the microfacets for a direction above the surface.
    GgxAlbedo albedo_at(Vec3 w) const { return anisotropic.used() ? anisotropic.albedo(w) : albedo.at(w.z); }
    /// 1 - E_d: share that passes the coat to the diffuse base.
    float coat_passed(GgxAlbedo a) const {
        return 1 - coat_constant - coat_lost_slope * a.lost - coat_grazing_slope * a.grazing;
    }
};

PreparedMetallicRoughness prepare(const MetallicRoughness& material, Vec3 wo);

/// Zero where wo or wi is not above the surface.
BsdfValue evaluate(const PreparedMetallicRoughness& material, Vec3 wi);

/// f |cos theta_i| of the specular lobes and of the diffuse base apart, for layers above that treat them differently.
struct MetallicRoughnessParts {
    Rgb specular, diffuse;
    float pdf = 0;
};
MetallicRoughnessParts evaluate_parts(const PreparedMetallicRoughness& material, Vec3 wi);

/// A direction drawn with the pdf of evaluate(); it may lie below the surface. wo must be above it.
Vec3 sample_direction(const PreparedMetallicRoughness& material, float u_lobe, Vec2 u);

/// Empty where the drawn direction would enter the surface, or nothing is reflected: the path ends.
/// u_lobe and u: uniform in [0, 1).
std::optional<BsdfSample> sample(const PreparedMetallicRoughness& material, float u_lobe, Vec2 u);

}  // namespace pluvia
