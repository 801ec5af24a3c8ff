// Light that has been scattered: its mean over all directions, by height and sun. Air and the scaled aerosol send it on
// almost evenly, so that this mean is all that later scattering needs. sky_view.h makes pictures of it.
#pragma once

#include "shaders/column_table.h"

namespace pluvia {

/// The sun's light at a point after extinction in the scaled medium, as a part of that outside; black in the planet's
/// shadow. mu_s: cosine of the angle between the sun and the zenith there.
Bands scaled_sunlight(const Atmosphere& atmosphere, const ColumnTable& columns, double r, double mu_s);

struct ScatteringSize {
    int heights = 32, suns = 128;
    int directions = 16;  // from the zenith to the horizon, as many from there to the nadir
    int azimuths = 8;     // on half a circle
    int steps = 24;
    int max_orders = 12;  // of scattering; fewer where one adds less than a thousandth
};

class ScatteringTable {
public:
    /// Sums orders of scattering, each from the one before; the ground counts as a scatterer. In parallel, with the
    /// same bytes for any number of threads.
    ScatteringTable(const Atmosphere& atmosphere, const ColumnTable& columns, const ScatteringSize& size = {});
    /// From the values() of a table of the same atmosphere and size.
    ScatteringTable(const Atmosphere& atmosphere, const ScatteringSize& size, std::span<const float> values);
    static size_t value_count(const ScatteringSize& size) {
        return size_t(size.heights + 1) * size_t(size.suns) * band_count;
    }

    /// Mean radiance per steradian of all scattered light at a height in km, as a part of the sun's irradiance.
    Bands mean_radiance(double height, double mu_s) const;
    /// Irradiance of scattered light on the ground, as a part of the sun's.
    Bands ground_irradiance(double mu_s) const;
    std::span<const float> values() const;

private:
    Bands row(const std::vector<Bands>& rows, int first, double mu_s) const;

    double top_height_;
    int heights_, suns_;
    std::vector<Bands> values_;  // rows of suns, one per height; after them the
                                 // irradiance on the ground
};

}  // namespace pluvia
