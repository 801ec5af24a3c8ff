// How much air, aerosol and ozone lie between a point and space: the table behind every transmittance. Columns and not
// transmittances are stored: one table serves all bands, and nothing underflows at the horizon.
#pragma once

#include "shaders/atmosphere.h"

#include <span>
#include <vector>

namespace pluvia {

/// Distances in km; r is the distance from the planet's centre, mu the cosine of the angle to the zenith. Whether a ray
/// meets the ground is decided by the straight line: light is not bent.
bool hits_ground(const Atmosphere& atmosphere, double r, double mu);
double distance_to_ground(const Atmosphere& atmosphere, double r, double mu);
double distance_to_top(const Atmosphere& atmosphere, double r, double mu);

class ColumnTable {
public:
    static constexpr int directions = 256, heights = 64;
    static constexpr size_t value_count = size_t(directions) * heights * 3;

    /// Integrates the columns, in parallel; the same bytes for any number of threads.
    explicit ColumnTable(const Atmosphere& atmosphere);
    /// From the values() of a table of the same atmosphere.
    ColumnTable(const Atmosphere& atmosphere, std::span<const float> values);

    /// Amounts along the ray to space in km. The ray must not meet the ground.
    Atmosphere::Amounts to_space(double r, double mu) const;
    std::span<const float> values() const { return values_; }

private:
    double ground_, top_,
        top_distance_;  // km; the last from the ground along the horizon
    std::vector<float> values_;
};

}  // namespace pluvia
