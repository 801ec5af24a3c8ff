// The GGX distribution of microfacets (isotropic, Smith shadowing) and its tabulated albedos. Everything is in the
// shading frame of bsdf_sample.h. Materials built on it: metallic_roughness.h.
// Source: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces"; Heitz 2014, "Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs".
#pragma once

#include "renderer/core/units.h"
#include "renderer/core/vec.h"
#include "shaders/fresnel.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

/// Smallest perceptual roughness; smoother surfaces are taken as this one, with alpha = 0.001. Directions carry errors
/// of 6e-8, which the half vector inherits divided by |wo + wi|: at this width a slope is still known to 0.3 % of the
/// width where wo and wi are one percent above the horizon. The reflection blurs over 0.1 degrees.
constexpr float min_roughness = 0.031622777f;

/// The distribution for one width alpha, the square of perceptual roughness.
struct Ggx {
    float alpha = 1, alpha_squared = 1;

    constexpr Ggx() = default;
    constexpr explicit Ggx(float alpha_) : alpha(alpha_), alpha_squared(alpha_ * alpha_) {}

    /// sqrt(alpha^2 + (1 - alpha^2) mu^2) = mu (1 + 2 Lambda(mu)), from which masking follows without dividing by mu.
    float masking_root(float mu) const { return std::sqrt(alpha_squared + (1 - alpha_squared) * (mu * mu)); }

    /// Density D of microfacet normals, 1/sr, for the half vector h = wo + wi of any length.
    float density(Vec3 h) const {
        const float across = h.x * h.x + h.y * h.y, along = h.z * h.z;
        const float spread = alpha_squared * along + across, length_squared = across + along;
        return alpha_squared * (length_squared * length_squared) / (pi * (spread * spread));
    }
};

/// What masking needs of the fixed direction wo.
struct GgxView {
    float mu = 1;    // cosine of wo, > 0
    float root = 1;  // masking_root(mu)

    GgxView() = default;
    GgxView(const Ggx& ggx, float mu_) : mu(mu_), root(ggx.masking_root(mu_)) {}
};

/// Height-correlated masking and shadowing G2 / (4 mu_o mu_i). Source: Heitz 2014, equation 99.
inline float visibility(const GgxView& view, float mu_i, float root_i) {
    return 0.5f / (view.mu * root_i + mu_i * view.root);
}
inline float visibility(const Ggx& ggx, const GgxView& view, float mu_i) {
    return visibility(view, mu_i, ggx.masking_root(mu_i));
}

/// Microfacet normal among those visible from wo. u: uniform in [0, 1)^2.
/// Source: Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
inline Vec3 sample_visible_normal(const Ggx& ggx, Vec3 wo, Vec2 u) {
    const Vec3 w = normalize(Vec3(ggx.alpha * wo.x, ggx.alpha * wo.y, wo.z));  // as if the surface had alpha = 1
    const float phi = 2 * pi * u.x;
    // The cap's height z above -w.z is kept as it is: forming z first and adding w.z again would cancel at grazing.
    const float rise = (1 - u.y) * (1 + w.z), z = rise - w.z;
    const float r = std::sqrt(std::max(0.0f, (1 - z) * (1 + z)));
    return normalize(Vec3(ggx.alpha * (r * std::cos(phi) + w.x), ggx.alpha * (r * std::sin(phi) + w.y), rise));
}

/// Density per solid angle of wi = wo mirrored at a visible normal: D G1(wo) / (4 mu_o).
inline float pdf_visible_reflection(const GgxView& view, float density) {
    return density / (2 * (view.mu + view.root));
}

/// Directional albedos of a GGX reflector at one cosine mu. With Schlick's Fresnel the single-scattering albedo is
/// f0 (1 - lost - grazing) + f90 grazing.
struct GgxAlbedo {
    float lost;     // 1 - E(mu): what a perfect mirror of microfacets does not return at the first bounce
    float grazing;  // mean of (1 - wo.h)^5 over what returns
};

/// Albedos for one roughness, and a choice of directions by what is lost: the place between two rows of a table that is
/// built at first use, by quadrature in about 0.1 s.
class GgxAlbedoRow {
public:
    GgxAlbedoRow() = default;
    /// roughness: perceptual, min_roughness to 1.
    explicit GgxAlbedoRow(float roughness);

    /// mu: 0 to 1. Error below 8e-4.
    GgxAlbedo at(float mu) const {
        // The table's columns are even in sqrt(mu / (mu + alpha)): masking turns on where mu is about alpha, so the
        // same columns serve the smoothest and the roughest surface; the root resolves the steep start at mu = 0.
        const float inverse = 1 / (mu + alpha_), smooth = alpha_ * inverse;
        const float x = std::sqrt(mu * inverse) * column_scale_;
        const int column = std::clamp(int(x), 0, columns - 2);  // a NaN stays a value, not an address
        const float tx = x - float(column);
        const Texel *a = lower_ + column, *b = a + columns;
        const auto blend = [&](float a0, float a1, float b0, float b1) {
            const float low = a0 + tx * (a1 - a0), high = b0 + tx * (b1 - b0);
            return low + row_offset_ * (high - low);
        };
        const float lost = smooth * smooth * blend(a[0].loss, a[1].loss, b[0].loss, b[1].loss);
        const float shift = roughness_ * blend(a[0].shift, a[1].shift, b[0].shift, b[1].shift);
        return {lost, (1 - lost) * schlick_weight(mu + shift)};
    }

    /// Cosine with density 1 / (log(1 + 1/alpha) (mu + alpha)), close to that of mu lost(mu): what smooth surfaces lose
    /// lies near the horizon, where a cosine-weighted choice would hardly ever look. u: uniform in [0, 1).
    float sample_lost_cosine(float u) const { return std::min(1.0f, alpha_ * std::expm1(u * log_range_)); }
    /// Its density with respect to mu.
    float pdf_lost_cosine(float mu) const { return 1 / (mu + alpha_) / log_range_; }

    /// What is tabulated varies slowly over all widths: the loss divided by (alpha / (mu + alpha))^2, and, divided by
    /// the perceptual roughness, the difference between mu and the cosine at which Schlick's term equals its mean.
    struct Texel {
        float loss, shift;
    };
    static constexpr int columns = 96;

private:
    const Texel* lower_ = nullptr;  // the next row follows at once
    float roughness_ = 1, alpha_ = 1, row_offset_ = 0, column_scale_ = 0, log_range_ = 1;
};

/// Cosine-weighted mean over the hemisphere, 2 integral(albedo(mu) mu dmu). roughness: min_roughness to 1.
GgxAlbedo average_ggx_albedo(float roughness);

}  // namespace pluvia
