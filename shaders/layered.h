// A metallic-roughness surface under sheen (KHR_materials_sheen) and a clear coat (KHR_materials_clearcoat): cloth, car
// paint, varnish. Each layer takes from what lies below it the share that it reflects itself, never less, so that no
// light is made. A coat whose normal is the base's loses none over a white diffuse base; over a rough specular base and
// under sheen a few percent are lost, since of two directions the one that the layer reflects more decides: that keeps
// the surface reciprocal. Conventions: bsdf_sample.h; the base: metallic_roughness.h.
#pragma once

#include "renderer/core/transform.h"
#include "shaders/bsdf_sample.h"
#include "shaders/metallic_roughness.h"
#include "shaders/sheen.h"

#include <optional>

namespace pluvia {

struct Layered {
    MetallicRoughness base;
    Sheen sheen;
    float coat = 0;                // strength of the clear coat, 0 to 1
    float coat_roughness = 0;      // perceptual, 0 to 1
    float coat_ior = 1.5f;         // of the coat
    Vec3 coat_normal = {0, 0, 1};  // unit, in the frame of the base's normal
};

struct PreparedLayered {
    PreparedMetallicRoughness base;
    PreparedMetallicRoughness coat;  // only its specular reflection
    ShadingBasis coat_basis{Vec3(0, 0, 1)};
    bool has_coat = false, tilted = false;
    Rgb sheen_color;
    float sheen_alpha = 1, sheen_roughness = 1, sheen_weight = 0;  // strongest channel of the colour; 0: no sheen
    // For wo: shares that coat and sheen let through, and the factor by which the diffuse base under the coat changes.
    float coat_passed = 1, sheen_passed = 1, diffuse_scale = 1;
    float coat_chance = 0, sheen_chance = 0;
};

PreparedLayered prepare(const Layered& material, Vec3 wo);

/// Zero where wo or wi is not above the base.
BsdfValue evaluate(const PreparedLayered& material, Vec3 wi);

/// Empty where the drawn direction would enter the surface. u_lobe and u: uniform in [0, 1).
std::optional<BsdfSample> sample(const PreparedLayered& material, float u_lobe, Vec2 u);

}  // namespace pluvia
