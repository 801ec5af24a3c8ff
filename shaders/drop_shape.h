// The shape of a falling drop: an oblate spheroid by size that oscillates about it. What light does in such a shape is
// in drop_trace.h.
// Frame: y up, against the drop's fall through the air; lengths in radii of the sphere of the same volume.
#pragma once

#include "renderer/core/vec.h"

#include <cmath>
#include <cstdint>

namespace pluvia {

/// Height over width of a drop that does not oscillate. diameter_mm: of the sphere of the same volume, up to 8.
/// Source: Beard and Chuang 1987, polynomial fit; 1 below 0.4 mm, where the fit is above 1.
double equilibrium_axis_ratio(double diameter_mm);

/// Angular frequency in rad/s of a drop's oscillation with n lobes (n = 2, 3). radius: metres.
/// Source: Rayleigh 1879: omega^2 = n (n - 1) (n + 2) sigma / (rho r^3), water at 20 C.
double oscillation_frequency(int n, double radius);

/// A drop at one moment: the sphere |p| = 1 with
/// |p| = 1 + a2 P20(cos theta) + a3 P31(cos theta) cos(phi - phi_drop), theta from the fall's axis, stretched to the
/// equilibrium spheroid. Modes and letters: Garg and Nayar 2006, "Photorealistic Rendering of Rain Streaks", section 3.
/// Volume is kept to the square of the amplitudes.
struct DropShape {
    float half_width = 1, half_height = 1;  // of the spheroid
    float a2 = 0, a3 = 0;                   // displacements at this moment
    float cos_phi = 1, sin_phi = 0;         // phi_drop, from x towards z

    /// Larger than every radius of the unstretched shape. |P31| <= 2.07.
    float largest_radius() const { return 1 + std::abs(a2) + 2.07f * std::abs(a3); }
};

/// How one drop oscillates.
struct DropOscillation {
    DropShape rest;
    double amplitude2 = 0, amplitude3 = 0;  // A20 and A31
    double omega2 = 0, omega3 = 0;          // rad/s
    double phase2 = 0, phase3 = 0;

    /// time: seconds.
    DropShape at(double time) const;
};

/// Size decides the spheroid and the frequencies, the key all that is random: phases and direction uniform, amplitudes
/// |normal| with standard deviations 0.05 and 0.03, at most 0.15 and 0.06, where the shape still bulges everywhere.
/// The spread of observed axis ratios, 0.03 to 0.1, is about 1.5 A20 (Andsager, Beard and Laird 1999).
/// radius: metres.
DropOscillation drop_oscillation(double radius, uint64_t key);

}  // namespace pluvia
