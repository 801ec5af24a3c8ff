// The sky over a street by day and night, clear or clouded, as an Environment in absolute units.
// How much light that is comes from daylight.h, the sun's place from a clock by sun_position.h.
#pragma once

#include "shaders/environment.h"

namespace pluvia {

/// clear: no cloud. overcast: closed cloud, no sun disc. rain: the darker closed cloud that rains.
enum class Weather { clear, overcast, rain };

struct SkySettings {
    Weather weather = Weather::clear;
    double sun_elevation = 0.7;  // radians above the horizon, -pi/2 to pi/2
    double sun_azimuth = 2.6;    // radians clockwise from north (-Z) seen from above
    double turbidity = 3;        // of the clear sky: 2 (very clear) to 10 (hazy)
};

/// Sky, sun and ground for a place of the sun. The picture has 512 x 256 texels; the lower half is ground of albedo 0.2
/// in the light of the upper half and the sun, so that what mirrors it is never black.
///
/// clear: pattern and colour of Preetham, Shirley and Smits 1999 (with a sun that has set: those of one on the horizon)
/// over the constant night sky. The level is not theirs, which is 9 klx at sunset where 0.8 are measured: sky and sun
/// together give clear_sky_illuminance, whatever the turbidity, so that haze moves light from the disc to the sky. The
/// disc gives sunlight(), by its part above the horizon, and is gone when it has set.
/// overcast: the CIE standard overcast sky (Moon and Spencer 1942), grey, with 0.25 of clear_sky_illuminance. rain: the
/// same with 0.16. Factors: Kasten and Czeplak 1980, 8 oktas of any cloud and of nimbostratus, at any sun elevation.
/// Colours that Rec.709 cannot show, such as the setting sun's, are desaturated at constant luminance until no
/// component is negative.
/// Throws usage_error for a turbidity or sun_elevation out of range and angles that are not finite.
Environment make_sky(const SkySettings& settings);

}  // namespace pluvia
