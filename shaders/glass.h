// The surface of a solid or liquid body of glass, water, ...: light is reflected or refracted, at a smooth interface or
// at GGX microfacets (KHR_materials_transmission with KHR_materials_volume). Conventions: bsdf_sample.h; the microfacet
// distribution: microfacet.h; thin sheets: pane.h, frosted_pane.h; what the body absorbs: renderer/transport/media.h.
//
// Radiance here is basic radiance, L / n^2 with n the index where it travels: refraction conserves it, so that all
// albedos are 1 where nothing is absorbed. Reciprocity then reads n_o^2 f(wo, wi) = n_i^2 f(wi, wo), n_o and n_i the
// indices on the sides of wo and wi (Veach 1997, section 5.2).
// Source: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; masking of refracted light as
// of reflected light (Pharr, Jakob and Humphreys 2023, section 9.7); what single scattering loses returns as in Kulla
// and Conty 2017, split so that it is reciprocal.
#pragma once

#include "shaders/bsdf_sample.h"
#include "shaders/microfacet.h"

#include <optional>

namespace pluvia {

struct Glass {
    Rgb tint = Rgb(1);    // of what passes, 0 to 1
    float roughness = 0;  // perceptual, 0 to 1; at min_roughness and below the surface is smooth
    float eta = 1.5f;     // index behind the surface over that on the side of wo, > 0
};

/// Share of light that rough glass does not return after meeting one microfacet, from either side.
class GlassLoss {
public:
    GlassLoss() = default;
    /// Tables for an index are built at its first use, by quadrature in about 0.1 s.
    GlassLoss(float eta, float roughness);

    /// mu: cosine, 0 to 1.
    float near_side(float mu) const { return at(0, mu); }
    float far_side(float mu) const { return at(1, mu); }
    /// Cosine-weighted means.
    float near_average() const { return average_[0]; }
    float far_average() const { return average_[1]; }

    static constexpr int columns = 48;

private:
    float at(int side, float mu) const;

    const float* lower_[2] = {nullptr, nullptr};  // rows of the table; the next follows at once
    float average_[2] = {0, 0};
    float alpha_ = 1, row_offset_ = 0, column_scale_ = 0;
};

struct PreparedGlass {
    Vec3 wo;
    Rgb tint;
    float eta = 1;
    bool smooth = true;
    float reflectance = 1;  // smooth: of unpolarised light
    Ggx ggx;
    GgxView view;
    GgxAlbedoRow row;  // draws cosines of the multiple scattering
    GlassLoss loss;
    float lost = 0;             // of wo: share of the multiple scattering
    float multiple_passed = 0;  // of that share, what leaves on the far side
};

PreparedGlass prepare(const Glass& glass, Vec3 wo);

/// Zero for smooth glass and where wo is not above the surface.
BsdfValue evaluate(const PreparedGlass& glass, Vec3 wi);

/// Empty where the drawn microfacet sends light to the side where it cannot go. u_lobe and u: uniform in [0, 1).
std::optional<BsdfSample> sample(const PreparedGlass& glass, float u_lobe, Vec2 u);

}  // namespace pluvia
