#include "shaders/sky_tables.h"

#include "renderer/core/random.h"

#include <bit>

namespace pluvia {
namespace {

constexpr uint64_t model_version = 1;  // to be raised with every change of what the tables hold

}  // namespace

SkyTables make_sky_tables(const AtmosphereSettings& settings, const ScatteringSize& size) {
    const Atmosphere atmosphere(settings);
    ColumnTable columns(atmosphere);
    ScatteringTable scattering(atmosphere, columns, size);
    return {atmosphere, std::move(columns), std::move(scattering)};
}

std::vector<float> values_of(const SkyTables& tables) {
    const auto columns = tables.columns.values(), scattering = tables.scattering.values();
    std::vector<float> values(columns.begin(), columns.end());
    values.insert(values.end(), scattering.begin(), scattering.end());
    return values;
}

size_t sky_value_count() {
    return ColumnTable::value_count + ScatteringTable::value_count({});
}

SkyTables tables_from_values(const AtmosphereSettings& settings, std::span<const float> values) {
    const Atmosphere atmosphere(settings);
    return {atmosphere, ColumnTable(atmosphere, values.first(ColumnTable::value_count)),
            ScatteringTable(atmosphere, {}, values.subspan(ColumnTable::value_count))};
}

uint64_t sky_tables_key(const AtmosphereSettings& s) {
    uint64_t key = hash_key(model_version, uint64_t(sky_value_count()));
    const auto add = [&](double value) { key = hash_key(key, std::bit_cast<uint64_t>(value)); };
    for (const double value :
         {s.planet_radius, s.top_height, s.rayleigh_height, s.ozone_dobson, s.beta, s.angstrom_exponent,
          s.aerosol_height, s.aerosol_albedo, s.asymmetry, s.forward_fraction, s.ground_albedo})
        add(value);
    for (const AirDensity& point : s.air) add(point.height), add(point.relative);
    return key;
}

}  // namespace pluvia
