// What rain of an intensity consists of, and how much of it a camera resolves: closed forms and integrals over its
// picture. The drops themselves are found by streaks.h.
#pragma once

#include "renderer/core/view.h"
#include "renderer/rain/streaks.h"

namespace pluvia {

/// Of the drops from smallest_drop to largest_drop; zeros, and an infinite visibility, where there is no rain.
struct RainStatistics {
    double drops_per_m3 = 0;
    double median_volume_diameter = 0;  // metres; half of the water is in larger drops
    double liquid_water = 0;            // kg of water in a cubic metre of air
    double extinction = 0;              // 1/m
    double visibility = 0;              // metres at which contrast falls to 2 % (Koschmieder 1924)
    double volume_flux = 0;             // m/s of water on level ground
};
RainStatistics rain_statistics(double intensity_mm_per_h);

/// Mean number of drops that are in the picture at one instant and at least min_width_pixels wide, without ground or
/// roofs: W H / f^2 times the integral of z^2 N(D >= width z / f) over the view depth z.
double expected_streaks(const View& view, const RainSettings& settings, double intensity_mm_per_h);

/// Share of the optical depth up to a distance along the view axis (beyond settings.near) that is streaks, 0 to 1.
double resolved_share(const View& view, const RainSettings& settings, double intensity_mm_per_h, double distance);

}  // namespace pluvia
