// How a spherical water drop scatters light, by geometric optics: the paths of a ray by the number of its passages, and
// the phase function of a drop whose disk is lit evenly. Diffraction is left out (it stays within 0.1 degrees of
// straight on for drops above 1 mm), and so is absorption: albedo 1.
// The turn angle is between the directions in which light travels before and after the drop: 0 = straight through.
#pragma once

#include "renderer/core/vec.h"

#include <array>

namespace pluvia {

/// Number of paths told apart: 0 is the outer reflection, p >= 1 leaves after p - 1 inner reflections. The last one
/// stands for all later ones too.
constexpr int drop_orders = 8;

/// Where the light of a ray that meets a drop goes.
struct DropPaths {
    std::array<double, drop_orders> weight;  // share of unpolarised light; they add up to 1
    std::array<double, drop_orders> turn;    // radians turned in the plane of the ray and the centre, not folded: >= 0
};

/// incidence: angle between ray and surface normal, 0 to pi/2; its sine is the distance from the drop's axis in radii.
/// Source: van de Hulst 1957, "Light Scattering by Small Particles", section 12.31, and Fresnel's equations for each
/// polarisation.
DropPaths drop_paths(double incidence);

/// Phase function, 1/sr, integrating to 1 over the sphere; constant within bins of a quarter of a degree.
/// cos_theta: cosine of the turn angle, -1 to 1.
float drop_phase(float cos_theta);

/// Direction of travel after the drop, with pdf exactly drop_phase(dot(direction, result)).
/// direction: of travel before, unit; u: uniform in [0, 1)^2.
Vec3 sample_drop_phase(Vec3 direction, Vec2 u);

/// Mean cosine of the turn angle.
double drop_asymmetry();

}  // namespace pluvia
