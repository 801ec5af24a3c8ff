// How bright the scene is shown: from an exposure value to a scale, and an exposure value from a metered picture.
// Exposed light becomes display values in color.h.
#pragma once

#include "renderer/core/rgb.h"

#include <array>
#include <cstdint>

namespace pluvia {

/// Exposure values at ISO 100 that automatic exposure keeps to: a night without moon or town, to snow in the sun with
/// room above.
constexpr double min_auto_ev100 = -2, max_auto_ev100 = 20;

/// Factor from luminance in cd/m2 to exposed light, where 1 is the brightest that a sensor at ISO 100 records.
/// Source: Lagarde and de Rousiers 2014, "Moving Frostbite to PBR", section 5.1.2, q = 0.65 (ISO 12232 saturation
/// speed): 1 / (1.2 * 2^EV).
float exposure_scale(double ev100);

/// Counts of pixels by luminance. Integers only, so that neither order nor threads change the result.
class LuminanceHistogram {
public:
    /// radiance in cd/m2. Pixels without luminance (zero, negative, NaN) are not counted; +inf is in the last bin.
    void add(Rgb radiance);
    void merge(const LuminanceHistogram& other);

    /// Exposure value of a light meter, log2(8 L) (reflected light, K = 12.5, ISO 2720), with L the geometric mean of
    /// the luminances between the 5th and 95th percentile. From EV 8 down to 4 pictures turn half a stop darker,
    /// as those of lit nights are taken; below 1 it follows a quarter of the way, so that dark nights look dark. Within
    /// min_auto_ev100 to max_auto_ev100, and 0 when nothing was counted. Of a sequence one value, of the histograms of
    /// all its frames merged, keeps the light from pulsing.
    double auto_ev100() const;

private:
    static constexpr int bins_per_stop = 32;
    static constexpr int min_stop = -24, max_stop = 36;  // log2 of cd/m2: far below starlight to above the sun's disk
    static constexpr int bin_count = (max_stop - min_stop) * bins_per_stop;

    std::array<uint64_t, bin_count> counts_ = {};
};

}  // namespace pluvia
