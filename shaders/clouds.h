// How clouds change the light of a clear sky: how much of it is left, how much of that is the sun's own, and from where
// in the sky the rest comes.
#pragma once

#include "renderer/core/rgb.h"

#include <array>

namespace pluvia {

/// Closed cloud of a kind, by the share of a clear sky's illuminance that it lets through. Sources: Kasten and Czeplak
/// 1980 for the first five; heavy rain and thunderstorms between these and the thousandth that US Naval Observatory
/// Circular 171 names as the extreme.
struct CloudType {
    const char* name;
    double transmittance;
};
constexpr std::array<CloudType, 7> cloud_types = {{{"cirrus", 0.61},
                                                   {"altocumulus", 0.27},
                                                   {"cumulus", 0.25},
                                                   {"stratus", 0.18},
                                                   {"nimbostratus", 0.16},
                                                   {"heavy-rain", 0.08},
                                                   {"thunderstorm", 0.02}}};

/// What people say of the sky, as cover and type.
struct WeatherPreset {
    const char* name;
    double cover;
    const char* cloud_type;
};
constexpr std::array<WeatherPreset, 8> weather_presets = {{{"clear", 0, "cumulus"},
                                                           {"fair", 0.4, "cumulus"},
                                                           {"cloudy", 0.75, "cumulus"},
                                                           {"overcast", 1, "cumulus"},
                                                           {"drizzle", 1, "stratus"},
                                                           {"rain", 1, "nimbostratus"},
                                                           {"heavy-rain", 1, "heavy-rain"},
                                                           {"thunderstorm", 1, "thunderstorm"}}};

struct Clouds {
    double cover = 0;             // 0 to 1, of the sky
    double transmittance = 0.25;  // of closed cloud, above 0 to 1
};

/// Horizontal illuminance under clouds over that of the clear sky: 1 - (1 - t) cover^3.4, falling. Source: Kasten and
/// Czeplak 1980, who found it independent of the sun's height.
double illuminance_ratio(const Clouds& clouds);

/// Light of the sun's disc over that in a clear sky: the ratio times 1 - cover^2, exactly 0 under closed cloud. Source:
/// Kasten and Czeplak 1980, whose share of diffuse light, 0.3 + 0.7 cover^2, leaves that of 0.7 in clear air.
double disc_ratio(const Clouds& clouds);

/// Luminance of the CIE standard overcast sky over that of its zenith, 1/3 at the horizon. Source: Moon and Spencer
/// 1942.
double overcast_luminance(double sine_of_elevation);
/// Its horizontal illuminance over the luminance of the zenith: 7 pi / 9.
constexpr double overcast_illuminance = 7 * 3.14159265358979323846 / 9;

/// Colour with luminance 1 of closed cloud above which a clear sky sends `light`: water droplets favour no wavelength,
/// and what passes to and fro between cloud and ground by day comes near to white. sun_elevation: radians; when the sun
/// is far below the horizon the cloud keeps the colour of what lights it.
Rgb cloud_color(Rgb light, double sun_elevation);

}  // namespace pluvia
