// The BSDF that a material has at a point of a triangle: factors times textures.
#pragma once

#include "renderer/scene/triangle.h"

namespace pluvia {

/// Base colour times texture times vertex colour, each channel 0 to 1.
Rgb base_color(const Scene& scene, const Material& material, const Triangle& triangle, Counters& counters);

/// Share of the material that transmits; the rest is opaque. 0 to 1.
float transmission_at(const Scene& scene, const Material& material, const Triangle& triangle, Counters& counters);

/// The dielectric or metal, or one of the sheets of which a partly transmitting material is mixed, chosen by u; without
/// the layers above it. from_front: whether the triangle's front is seen.
Bsdf bsdf_at(const Scene& scene, const Material& material, const Triangle& triangle, bool from_front, float u,
             Counters& counters);

/// Puts sheen and clear coat over what bsdf_at() gave, unless that transmits. coat_normal: in the frame of the base's
/// normal.
void add_layers(const Scene& scene, const Material& material, const Triangle& triangle, Vec3 coat_normal, Bsdf& bsdf,
                Counters& counters);

}  // namespace pluvia
