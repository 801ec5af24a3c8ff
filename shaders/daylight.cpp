#include "shaders/daylight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double degrees_from_radians = 180 / std::numbers::pi;

/// The light outside the atmosphere (lux, as CIE 1931 XYZ) and the optical depth of 300 DU of ozone in the zenith, in
/// bands of 27.5 nm from 390 to 720 nm. Sources: ASTM G173 extraterrestrial spectrum; ozone at 233 K, Serdyuchenko
/// et al. 2014.
struct Band {
    double wavelength;  // micrometres
    double x, y, z;
    double ozone;
};
constexpr std::array<Band, 12> bands = {{
    {0.40375, 998.9, 28.1, 4766.5, 0.00011},
    {0.43125, 8626.1, 457.1, 42651.3, 0.00059},
    {0.45875, 10666.0, 2258.4, 60659.7, 0.00228},
    {0.48625, 2381.2, 6997.7, 23310.9, 0.00638},
    {0.51375, 1417.2, 20361.2, 4844.7, 0.01279},
    {0.54125, 10966.8, 33138.5, 763.5, 0.02390},
    {0.56875, 25414.4, 32622.4, 94.4, 0.03562},
    {0.59625, 34376.3, 22660.9, 31.1, 0.03822},
    {0.62375, 24258.2, 10771.6, 4.5, 0.03072},
    {0.65125, 8368.3, 3192.5, 0.2, 0.01932},
    {0.67875, 1619.8, 591.4, 0.0, 0.01108},
    {0.70625, 230.4, 83.2, 0.0, 0.00592},
}};

/// Length of the light's way through the air, 1 for a sun in the zenith. Source: Kasten and Young 1989, eq. 3.
double air_mass(double sun_elevation) {
    const double degrees = sun_elevation * degrees_from_radians;
    return 1 / (std::sin(sun_elevation) + 0.50572 * std::pow(degrees + 6.07995, -1.6364));
}

}  // namespace

Rgb rec709_from_xyz(double x, double y, double z) {
    const Rgb c = {float(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
                   float(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
                   float(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
    const float grey = luminance(c), least = std::min({c.r, c.g, c.b});
    if (least >= 0) return c;
    const Rgb inside = mix(Rgb(grey), c, grey / (grey - least));
    return {std::max(0.0f, inside.r), std::max(0.0f, inside.g), std::max(0.0f, inside.b)};  // rounding
}

double clear_sky_illuminance(double sun_elevation) {
    constexpr double outside = 133775;        // lux, of the sun outside the atmosphere
    constexpr double scale_heights = 753.66;  // radius of the Earth over the thickness of the air
    const double sine = std::sin(sun_elevation), degrees = sun_elevation * degrees_from_radians;
    const double s = std::asin(std::cos(sun_elevation) * scale_heights / (scale_heights + 1));
    const double m = scale_heights * (std::cos(s) - sine) + std::cos(s);  // air mass, defined below the horizon as well
    const double direct = std::exp(-0.21 * m) * std::max(0.0, sine);
    const double sky = 0.0289 * std::exp(-0.042 * m) * (1 + (degrees + 90) * sine / 57.29577951);
    return outside * (direct + sky) + night_sky_illuminance;
}

Rgb sunlight(double sun_elevation, double turbidity) {
    const double mass = air_mass(std::max(0.0, sun_elevation));
    const double haze_at_1_um = 0.04608 * turbidity - 0.04586;
    double x = 0, y = 0, z = 0;
    for (const Band& band : bands) {
        const double l2 = 1 / (band.wavelength * band.wavelength);
        const double air = 0.008569 * l2 * l2 * (1 + 0.0113 * l2 + 0.00013 * l2 * l2);
        const double haze = haze_at_1_um * std::pow(band.wavelength, -1.3);
        const double transmittance = std::exp(-mass * (air + haze + band.ozone));
        x += band.x * transmittance, y += band.y * transmittance, z += band.z * transmittance;
    }
    return rec709_from_xyz(x, y, z);
}

}  // namespace pluvia
