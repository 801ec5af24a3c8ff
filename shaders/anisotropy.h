// GGX microfacets that are wider along one direction of the surface than across it, as those of brushed metal are
// (KHR_materials_anisotropy). Used by metallic_roughness.h; the isotropic distribution and sources: microfacet.h.
#pragma once

#include "renderer/core/vec.h"
#include "shaders/microfacet.h"

namespace pluvia {

struct Anisotropy {
    float strength = 0;       // 0: none, 1: along the direction as rough as can be
    Vec2 direction = {1, 0};  // unit, in the shading frame: where reflections are drawn out
};

/// The distribution for one roughness and anisotropy. Directions are in the shading frame.
/// Source: Heitz 2014, "Understanding the Masking-Shadowing Function", section 5.4; the widths:
/// KHR_materials_anisotropy.
class AnisotropicGgx {
public:
    AnisotropicGgx() = default;  // used() is false, nothing else may be asked
    /// roughness: perceptual, min_roughness to 1; its square is the width across the direction. strength: above 0,
    /// to 1.
    AnisotropicGgx(float roughness, const Anisotropy& anisotropy);

    bool used() const { return alpha_along_ > 0; }
    float alpha_along() const { return alpha_along_; }

    /// |(alpha_along w.x, alpha_across w.y, w.z)| = mu (1 + 2 Lambda), as Ggx::masking_root(). w: unit.
    float masking_root(Vec3 w) const {
        const Vec2 flat = local(w);
        const float x = alpha_along_ * flat.x, y = alpha_across_ * flat.y;
        return std::sqrt(x * x + y * y + w.z * w.z);
    }

    /// Density D of microfacet normals, 1/sr, for the half vector h = wo + wi of any length.
    float density(Vec3 h) const {
        const Vec2 flat = local(h);
        const float x2 = flat.x * flat.x, y2 = flat.y * flat.y, z2 = h.z * h.z, product = alpha_along_ * alpha_across_;
        const float ratio = alpha_along_ / alpha_across_, spread = x2 / ratio + y2 * ratio + z2 * product;
        const float length_squared = x2 + y2 + z2;
        return product * (length_squared * length_squared) / (pi * (spread * spread));
    }

    /// Microfacet normal among those visible from wo. u: uniform in [0, 1)^2.
    Vec3 sample_visible_normal(Vec3 wo, Vec2 u) const;

    /// Directional albedos of a reflector, w.z >= 0. From a table that is built at first use, in about 0.3 s; the error
    /// of `lost` is below 4e-3 (1e-3 in the mean), that of `grazing` below 0.02, nearer to the horizon than 3 degrees
    /// 0.05.
    GgxAlbedo albedo(Vec3 w) const;
    /// Cosine-weighted mean of albedo() over the hemisphere.
    GgxAlbedo average_albedo() const;

private:
    /// The plane's part of w, x along the direction.
    Vec2 local(Vec3 w) const {
        return {direction_.x * w.x + direction_.y * w.y, direction_.x * w.y - direction_.y * w.x};
    }

    float alpha_along_ = 0, alpha_across_ = 0;
    Vec2 direction_ = {1, 0};
    float row_ = 0, stretch_ = 0;  // place in the table
};

}  // namespace pluvia
