// Light of the night: the moon by its phase, stars and airglow, and the glow of a town.
#pragma once

#include "shaders/sky_tables.h"

#include <array>

namespace pluvia {

/// Illuminance outside the atmosphere on a surface that faces the moon, over that of the sun at 1 AU: 2.36e-6 at full
/// moon. phase_angle: radians, 0 = full. parallax: radians. Source: Allen 1976, Astrophysical Quantities, section 66,
/// with a full moon of 0.314 lux at the mean distance.
double moon_over_sun(double phase_angle, double parallax);
/// Half angle of the moon's disc in radians.
double moon_radius(double parallax);
/// Moonlight over sunlight of the same luminance: the moon's ground is the darker the shorter the wavelength, by 1.35
/// from 650 to 450 nm.
Bands moon_reddening();

/// Stars, airglow and zodiacal light, in cd/m2: 2e-4 in the zenith, twice that on the horizon, before the air takes its
/// part. With it a moonless night has some 0.8 mlx (measured: 0.5 to 1). Source: Roach and Gordon 1973 for the level.
Rgb night_sky_radiance(const SkyTables& tables, double elevation);

/// Luminance in the zenith, in cd/m2, that a town gives to closed cloud above it; clear air scatters a tenth of it
/// back. Measured: 27 mcd/m2 over Potsdam (Puschnig et al. 2014), 100 to 300 over the centres of large cities.
struct CityGlow {
    const char* name;
    double luminance;
};
constexpr std::array<CityGlow, 4> city_glows = {{{"none", 0}, {"village", 0.002}, {"suburb", 0.025}, {"city", 0.2}}};

/// The glow in cd/m2 where closed cloud has `glow` in its zenith; lamps of 3000 K, half as bright again on the horizon.
Rgb city_glow_radiance(double glow, double cloud_cover, double elevation);

}  // namespace pluvia
