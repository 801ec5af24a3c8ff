// A rough sheet of glass, thin compared with its distance: frosted windows, plastic foil. Light is reflected or passes,
// both spread by GGX microfacets; what passes keeps its mean direction. The smooth sheet: pane.h.
// Conventions: bsdf_sample.h; the microfacet distribution: microfacet.h. Reciprocal; a clear sheet keeps all light.
#pragma once

#include "shaders/bsdf_sample.h"
#include "shaders/microfacet.h"

#include <optional>

namespace pluvia {

struct FrostedPane {
    Rgb tint = Rgb(1);    // colour of what passes, 0 to 1
    float roughness = 1;  // perceptual, min_roughness to 1
    float ior = 1.5f;     // >= 1
};

struct PreparedFrostedPane {
    Vec3 wo;
    Rgb tint;
    float ior = 1;
    Ggx ggx;
    GgxView view;
    GgxAlbedoRow albedo;
    float lost = 0;  // of wo: what is not returned at the first microfacet
    float average_lost = 1;
    float multiple_reflected = 0;  // share of what is lost that comes back; the rest passes
};

PreparedFrostedPane prepare(const FrostedPane& pane, Vec3 wo);

/// Zero where wo is not above the surface.
BsdfValue evaluate(const PreparedFrostedPane& pane, Vec3 wi);

/// Empty where the drawn direction would leave through the wrong side. u_lobe and u: uniform in [0, 1).
std::optional<BsdfSample> sample(const PreparedFrostedPane& pane, float u_lobe, Vec2 u);

}  // namespace pluvia
