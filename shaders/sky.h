// The sky over a street by day and night, clear or clouded, as an Environment in absolute units: the sun's and the
// moon's light in air (sky_view.h), clouds (clouds.h), the night's own light (night.h), and the discs.
#pragma once

#include "shaders/clouds.h"
#include "shaders/environment.h"
#include "shaders/sky_tables.h"

#include <optional>

namespace pluvia {

struct Moon {
    double elevation = 0, azimuth = 0;  // radians, as the sun's
    double parallax = 0.0166;           // radians
    double phase_angle = 0;             // radians, 0 = full
};

/// Angles in radians. Elevations are those at which the discs are seen, refraction included: -pi/2 to pi/2; azimuths
/// run clockwise from north (-Z) seen from above.
struct SkySettings {
    double sun_elevation = 0.7, sun_azimuth = 2.6;
    double sun_distance = 1;  // astronomical units
    std::optional<Moon> moon;
    Clouds clouds;
    double city_glow = 0;  // cd/m2 in the zenith of closed cloud
    int texels = 512;      // of the picture, in each direction: even, 2 to 8192
};

/// Sky, discs and ground. The picture has 512 x 512 texels unless told otherwise: towards the horizon the sky changes
/// within a third of a degree of height, but nowhere that fast along it, and what shines on a street, its upper half,
/// stays in the fast caches. Its lower half is ground of the tables' albedo in the light of the upper half and the
/// discs, so that what mirrors it is never black.
///
/// Clouds leave exactly illuminance_ratio() of what sun, moon and stars give on the horizontal. A part 1 - cover of the
/// clear sky is seen as it is; the rest of the light comes from the CIE overcast sky, whose colour is cloud_color().
/// The discs have disc_ratio() of their light, which is none under closed cloud. Throws usage_error for values out of
/// range and angles that are not finite.
Environment make_sky(const SkyTables& tables, const SkySettings& settings);

}  // namespace pluvia
