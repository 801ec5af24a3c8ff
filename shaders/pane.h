// A smooth sheet of glass, thin compared with its distance: window panes (glTF KHR_materials_transmission without a
// volume). Light is mirrored or goes straight on. Conventions: bsdf_sample.h.
#pragma once

#include "shaders/bsdf_sample.h"
#include "shaders/fresnel.h"

#include <optional>

namespace pluvia {

struct Pane {
    Rgb tint = Rgb(1);  // colour of what passes, 0 to 1
    float ior = 1.5f;   // >= 1
};

/// A Pane seen from one direction.
struct PreparedPane {
    Vec3 wo;
    float reflectance = 0;
    Rgb transmittance;
    float reflection_chance = 0;  // probability that sample() takes the mirror direction
};

/// Share of unpolarised light that a clear sheet mirrors: both faces and all reflections between them, without
/// interference. Per polarisation R + (1-R)^2 R (1 + R^2 + R^4 ...) = 2R/(1+R). The rest, (1-R)/(1+R), passes.
/// cos_i: 0 to 1. Source: Stokes 1862, "On the Intensity of the Light Reflected from or Transmitted through a Pile of
/// Plates".
inline float pane_reflectance(float cos_i, float ior) {
    const Reflectance<float> face = fresnel_dielectric(cos_i, ior);
    return face.s / (1 + face.s) + face.p / (1 + face.p);
}

inline PreparedPane prepare(const Pane& pane, Vec3 wo) {
    PreparedPane seen;
    seen.wo = wo;
    if (wo.z <= 0) return seen;
    seen.reflectance = pane_reflectance(wo.z, pane.ior);
    seen.transmittance = pane.tint * (1 - seen.reflectance);
    const float total = seen.reflectance + luminance(seen.transmittance);
    if (total > 0) seen.reflection_chance = seen.reflectance / total;
    return seen;
}

/// Always zero: both lobes are deltas.
inline BsdfValue evaluate(const PreparedPane&, Vec3) {
    return {};
}

/// Empty where wo is not above the surface. u_lobe: uniform in [0, 1).
inline std::optional<BsdfSample> sample(const PreparedPane& pane, float u_lobe, Vec2) {
    if (pane.wo.z <= 0) return std::nullopt;
    if (u_lobe < pane.reflection_chance) {
        return BsdfSample{.wi = {-pane.wo.x, -pane.wo.y, pane.wo.z},
                          .weight = Rgb(pane.reflectance / pane.reflection_chance),
                          .delta = true};
    }
    return BsdfSample{.wi = -pane.wo,
                      .weight = pane.transmittance / (1 - pane.reflection_chance),
                      .delta = true,
                      .transmitted = true};
}

}  // namespace pluvia
