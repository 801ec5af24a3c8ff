// All that the light of an atmosphere needs and that does not depend on time: made once, kept in a file.
#pragma once

#include "shaders/scattering_table.h"

#include <cstdint>
#include <span>
#include <vector>

namespace pluvia {

struct SkyTables {
    Atmosphere atmosphere;
    ColumnTable columns;
    ScatteringTable scattering;
};

/// Takes about two seconds of one core with the default size.
SkyTables make_sky_tables(const AtmosphereSettings& settings = {}, const ScatteringSize& size = {});

/// Tables of the default size as numbers, in the order that tables_from_values takes.
std::vector<float> values_of(const SkyTables& tables);
size_t sky_value_count();
/// values: sky_value_count() finite numbers that values_of() gave for the same settings.
SkyTables tables_from_values(const AtmosphereSettings& settings, std::span<const float> values);

/// Changes with every setting and with every change of the model, so that tables are never taken for others.
uint64_t sky_tables_key(const AtmosphereSettings& settings);

}  // namespace pluvia
