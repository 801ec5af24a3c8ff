#include "shaders/night.h"

#include "shaders/blackbody.h"
#include "shaders/sky_view.h"

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double mean_parallax = 0.951 * degree;

/// The sun's light with a slope over wavelength, at the same luminance.
Bands with_slope(double part_per_200_nm) {
    Bands slope;
    for (int i = 0; i < band_count; ++i)
        slope[i] = float(1 + part_per_200_nm * (bands[size_t(i)].wavelength - 0.45) / 0.2);
    return slope * float(luminance_from_bands(Bands(1)) / luminance_from_bands(slope));
}

}  // namespace

double moon_over_sun(double phase_angle, double parallax) {
    constexpr double full = 2.36e-6;
    const double a = phase_angle / degree, nearness = parallax / mean_parallax;
    return full * std::pow(10, -0.4 * (0.026 * a + 4e-9 * a * a * a * a)) * nearness * nearness;
}

double moon_radius(double parallax) {
    return std::asin(0.272481 * std::sin(parallax));  // radius of the moon over the earth's
}

Bands moon_reddening() {
    return with_slope(0.35);
}

Rgb night_sky_radiance(const SkyTables& tables, double elevation) {
    constexpr double zenith = 3e-4;
    static const Bands slope = with_slope(0.25);  // some 4700 K
    const Bands passed = direct_transmittance(tables, std::max(0.0, elevation)) * slope;
    const double level = zenith * (2 - std::sin(elevation)) / luminance_from_bands(Bands(1));
    return rec709_from_xyz(xyz_from_bands(passed * float(level)));
}

Rgb city_glow_radiance(double glow, double cloud_cover, double elevation) {
    static const Rgb color = blackbody_color(3000);
    constexpr double clear_share = 0.1;
    const double zenith = glow * (clear_share + (1 - clear_share) * cloud_cover);
    return color * float(zenith * (1 + 0.5 * (1 - std::sin(elevation))));
}

}  // namespace pluvia
