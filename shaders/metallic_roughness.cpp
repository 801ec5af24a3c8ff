#include "shaders/metallic_roughness.h"

#include "renderer/core/sampling.h"
#include "shaders/fresnel.h"

namespace pluvia {
namespace {

/// Colour of light that has met the microfacets more than once, per channel; 1 where nothing is absorbed.
/// f0, f90: Schlick's reflectances; average_lost: 1 - E_avg.
/// Source: Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks"; the numerator is squared because
/// light in this lobe has been reflected at least twice (Hill 2018, "A Multi-Faceted Exploration").
float multiple_scattering(float f0, float f90, float average_lost) {
    const float mean = f0 + (f90 - f0) * (1.0f / 21);  // 2 integral(F(mu) mu dmu)
    return mean * mean * (1 - average_lost) / (1 - mean * average_lost);
}
Rgb multiple_scattering(Rgb f0, float f90, float average_lost) {
    return {multiple_scattering(f0.r, f90, average_lost), multiple_scattering(f0.g, f90, average_lost),
            multiple_scattering(f0.b, f90, average_lost)};
}

/// Of the dielectric at normal incidence. Source: KHR_materials_specular, "Implementation".
Rgb coat_reflectance(const MetallicRoughness& m) {
    const float f0 = normal_reflectance(m.ior);
    const Rgb c = m.specular_color * f0;
    return Rgb(std::min(c.r, 1.0f), std::min(c.g, 1.0f), std::min(c.b, 1.0f)) * m.specular;
}

}  // namespace

// The glTF material is mix(dielectric, metal, metallic). Both share one microfacet distribution and reflect linearly in
// their Fresnel terms, so their specular lobes are added up before any direction is known. The diffuse base lies under
// the dielectric alone and gets what that coat lets through, in a reciprocal form:
// (1 - E_d(wo)) (1 - E_d(wi)) / (pi (1 - E_d,avg)), E_d the albedo of the coat. Source: Kelemen and Szirmay-Kalos 2001,
// "A Microfacet Based Coupled Specular-Matte BRDF Model with Importance Sampling", section 2.
PreparedMetallicRoughness prepare(const MetallicRoughness& material, Vec3 wo) {
    PreparedMetallicRoughness seen;
    seen.wo = wo;
    const Rgb diffuse_color = material.base_color * (1 - material.metallic);
    if (material.metallic == 0 && material.specular == 0) {
        seen.lambert = true;
        seen.diffuse = diffuse_color / pi;
        seen.reflected = luminance(diffuse_color);
        return seen;
    }
    if (wo.z <= 0) return seen;

    const float coat_f90 = material.specular;
    const Rgb coat_color = coat_reflectance(material);
    const float coat_f0 = max_component(coat_color);
    seen.f0 = mix(coat_color, material.base_color, material.metallic);
    seen.f90 = coat_f90 + (1 - coat_f90) * material.metallic;
    const float roughness = std::max(min_roughness, material.roughness);
    GgxAlbedo average;
    if (material.anisotropy.strength > 0) {
        seen.anisotropic = AnisotropicGgx(roughness, material.anisotropy);
        seen.ggx = Ggx(seen.anisotropic.alpha_along());
        seen.view.mu = wo.z;
        seen.view.root = seen.anisotropic.masking_root(wo);
        seen.albedo = GgxAlbedoRow(std::sqrt(seen.ggx.alpha));
        average = seen.anisotropic.average_albedo();
    } else {
        seen.ggx = Ggx(roughness * roughness);
        seen.view = GgxView(seen.ggx, wo.z);
        seen.albedo = GgxAlbedoRow(roughness);
        average = average_ggx_albedo(roughness);
    }
    const GgxAlbedo albedo = seen.albedo_at(wo);

    const float coat_multiple = multiple_scattering(coat_f0, coat_f90, average.lost);
    const Rgb coat_multiple_color =
        coat_color == Rgb(coat_f0) ? Rgb(coat_multiple) : multiple_scattering(coat_color, coat_f90, average.lost);
    const Rgb metal_multiple = multiple_scattering(material.base_color, 1, average.lost);
    seen.multiple = mix(coat_multiple_color, metal_multiple, material.metallic) * (albedo.lost / (pi * average.lost));

    // E_d = f0 (1 - lost - grazing) + f90 grazing + multiple lost.
    seen.coat_constant = coat_f0;
    seen.coat_lost_slope = coat_multiple - coat_f0;
    seen.coat_grazing_slope = coat_f90 - coat_f0;
    const float passed = seen.coat_passed(albedo);
    seen.diffuse = diffuse_color * (passed / (pi * seen.coat_passed(average)));

    const float specular = luminance(seen.f0 * (1 - albedo.lost - albedo.grazing) + Rgb(seen.f90 * albedo.grazing));
    const float diffuse = luminance(diffuse_color) * passed;
    const float multiple = luminance(seen.multiple) * pi * average.lost;
    const float total = specular + diffuse + multiple;
    if (total > 0) {
        seen.reflected = total;
        const float scale = 1 / total;
        seen.specular_chance = specular * scale;
        // What rough surfaces lose is lost at all angles and so returns about as a cosine; smooth ones lose it near the
        // horizon, where the choice by what is lost looks.
        seen.diffuse_chance = (diffuse + seen.ggx.alpha * multiple) * scale;
        seen.multiple_chance = (1 - seen.ggx.alpha) * multiple * scale;
    }
    return seen;
}

BsdfValue evaluate(const PreparedMetallicRoughness& seen, Vec3 wi) {
    if (seen.wo.z <= 0 || wi.z <= 0) return {};
    if (seen.lambert) return {seen.diffuse * wi.z, wi.z / pi};

    const Vec3 h = seen.wo + wi;
    const bool anisotropic = seen.anisotropic.used();
    const float density = anisotropic ? seen.anisotropic.density(h) : seen.ggx.density(h);
    const float root = anisotropic ? seen.anisotropic.masking_root(wi) : seen.ggx.masking_root(wi.z);
    const float cos_h = 0.5f * length(h);  // of wo and the half vector, whose length is twice that for unit wo and wi
    const Rgb fresnel = fresnel_schlick(seen.f0, seen.f90, std::min(1.0f, cos_h));
    const GgxAlbedo albedo = seen.albedo_at(wi);
    const Rgb rest = seen.multiple * albedo.lost + seen.diffuse * seen.coat_passed(albedo);
    return {(fresnel * (density * visibility(seen.view, wi.z, root)) + rest) * wi.z,
            seen.specular_chance * pdf_visible_reflection(seen.view, density) +
                seen.diffuse_chance * pdf_cosine_hemisphere(wi.z) +
                seen.multiple_chance * seen.albedo.pdf_lost_cosine(wi.z) / (2 * pi)};
}

MetallicRoughnessParts evaluate_parts(const PreparedMetallicRoughness& seen, Vec3 wi) {
    if (seen.wo.z <= 0 || wi.z <= 0) return {};
    const BsdfValue whole = evaluate(seen, wi);
    if (seen.lambert) return {Rgb(0), whole.f_cos, whole.pdf};
    const Rgb diffuse = seen.diffuse * (seen.coat_passed(seen.albedo_at(wi)) * wi.z);
    const Rgb s = whole.f_cos - diffuse;
    return {{std::max(0.0f, s.r), std::max(0.0f, s.g), std::max(0.0f, s.b)}, diffuse, whole.pdf};
}

Vec3 sample_direction(const PreparedMetallicRoughness& seen, float u_lobe, Vec2 u) {
    if (u_lobe < seen.specular_chance) {
        const Vec3 h = seen.anisotropic.used() ? seen.anisotropic.sample_visible_normal(seen.wo, u)
                                               : sample_visible_normal(seen.ggx, seen.wo, u);
        return h * (2 * dot(seen.wo, h)) - seen.wo;
    }
    if (seen.lambert || u_lobe < seen.specular_chance + seen.diffuse_chance) return sample_cosine_hemisphere(u);
    const float mu = seen.albedo.sample_lost_cosine(u.x), r = std::sqrt((1 - mu) * (1 + mu)), phi = 2 * pi * u.y;
    return {r * std::cos(phi), r * std::sin(phi), mu};
}

std::optional<BsdfSample> sample(const PreparedMetallicRoughness& seen, float u_lobe, Vec2 u) {
    if (seen.wo.z <= 0) return std::nullopt;
    const Vec3 wi = sample_direction(seen, u_lobe, u);
    // Every lobe reaches every direction, so the weight divides by the pdf of the mixture.
    const BsdfValue value = evaluate(seen, wi);
    if (value.pdf <= 0 || is_black(value.f_cos)) return std::nullopt;
    return BsdfSample{.wi = wi, .weight = value.f_cos / value.pdf, .pdf = value.pdf};
}

}  // namespace pluvia
