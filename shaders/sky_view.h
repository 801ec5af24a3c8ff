// What of the sun's light a clear atmosphere sends into an eye: along one ray, and as a picture of the sky. sky.h puts
// clouds, night and discs to it.
#pragma once

#include "shaders/sky_tables.h"

#include <vector>

namespace pluvia {

/// Radiance per steradian that the atmosphere and the ground below it scatter into a ray, as a part of the sun's
/// irradiance. r: km from the planet's centre, not below the ground; mu: cosine of the ray's angle to the zenith; mu_s:
/// that of the sun; nu: cosine of the angle between ray and sun. Light scattered forwards is sent as Henyey and
/// Greenstein's peak, and all that is scattered several times within the peak with it.
Bands scattered_radiance(const SkyTables& tables, double r, double mu, double mu_s, double nu, int steps = 64);

/// Part of the sun's light that arrives at a height in km; a sun below the horizon gives none. sun_elevation in
/// radians.
Bands direct_transmittance(const SkyTables& tables, double sun_elevation, double altitude = 0);

/// The clear sky above one place as a table by elevation and azimuth away from the sun, linear in between. Elevations
/// are dense at the horizon; the two sides of the sun are the same numbers.
class SkyView {
public:
    static constexpr int azimuths = 129,
                         elevations = 128;  // on half a circle; from the horizon to the zenith

    /// sun_elevation: radians, -pi/2 to pi/2. altitude: of the eye in km.
    SkyView(const SkyTables& tables, double sun_elevation, double altitude = 0);

    /// cd/m2 under a sun at 1 AU. elevation: radians, below 0 as at 0; azimuth: radians away from the sun's.
    Rgb radiance(double elevation, double azimuth) const;
    const std::vector<Rgb>& values() const { return values_; }  // rows of azimuths from the horizon up

private:
    std::vector<Rgb> values_;
};

}  // namespace pluvia
