// The layers of a frame: which channels a file has, and how a pixel's sums become their values.
// Per pixel and intensity the film keeps the background B, the light M of it that passes the rain, the streaks' light C
// and their coverage A, and the light I scattered in by finer rain; then rainy = M + C + I, so
// rainy = background * transmittance + rain + inscatter to rounding.
#pragma once

#include "renderer/core/rgb.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pluvia {

/// "050", or "012p5" where there is a fraction: how an intensity is written in channel and file names.
std::string intensity_label(double intensity_mm_per_h);

/// Sums over the samples of one pixel at one intensity. Kept in double: thousands of samples add to one value.
struct RainSums {
    std::array<double, 3> removed = {};    // background radiance that does not pass the rain
    std::array<double, 3> light = {};      // radiance of streaks
    std::array<double, 3> inscatter = {};  // radiance of the medium
    double coverage = 0;                   // by streaks
    double wide_coverage = 0;              // by those at least a pixel wide
    double blocked = 0;                    // 1 - transmission
};
struct PixelSums {
    std::array<double, 3> background = {};
    std::vector<RainSums> rain;  // one per intensity
};

/// What the ray through the centre of a pixel meets at mid-exposure.
struct CentreDepth {
    float z, distance;           // metres, +inf for the sky
    std::vector<float> rainy_z;  // per intensity: depth of the nearest streak at least a pixel wide, else z
};

/// Channel names in the order in which develop() writes values.
std::vector<std::string> layer_channels(const std::vector<double>& intensities_mm_per_h);

/// Values of one pixel, in the order of layer_channels. samples: number of samples in the sums.
void develop(const PixelSums& sums, const CentreDepth& depth, int samples, float* values);

/// Rows of a finished picture, one plane per channel.
struct Band {
    int y = 0, rows = 0, width = 0;
    std::vector<std::vector<float>> planes;  // rows * width each
    std::vector<std::vector<uint32_t>> ids;  // the same, for label layers that hold ids

    Band(int y_, int rows_, int width_, size_t channels, size_t id_channels = 0)
        : y(y_),
          rows(rows_),
          width(width_),
          planes(channels, std::vector<float>(size_t(rows_) * width_)),
          ids(id_channels, std::vector<uint32_t>(size_t(rows_) * width_)) {}
};

}  // namespace pluvia
