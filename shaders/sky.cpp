#include "shaders/sky.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"
#include "shaders/daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi;
constexpr int picture_width = 512, picture_height = 256;
constexpr float ground_albedo = 0.2f;
constexpr double overcast_transmittance = 0.25, rain_cloud_transmittance = 0.16;  // Kasten and Czeplak 1980

/// Part of the sun's disc, between 0 and 1, above the horizon when its centre is this many of its radii above it.
double part_above_horizon(double radii) {
    if (radii <= -1) return 0;
    if (radii >= 1) return 1;
    return 0.5 + (radii * std::sqrt(1 - radii * radii) + std::asin(radii)) / pi_d;
}

/// The five numbers of Perez' all-weather pattern: two of the gradient from zenith to horizon, three of the glow
/// around the sun. Each is slope * turbidity + offset in Preetham, Shirley and Smits 1999, appendix 2.
struct Perez {
    double a, b, c, d, e;

    double gradient(double cos_theta) const { return 1 + a * std::exp(b / cos_theta); }
    double glow(double gamma) const { return 1 + c * std::exp(d * gamma) + e * std::cos(gamma) * std::cos(gamma); }
};

Perez perez_luminance(double t) {
    return {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
            0.1206 * t - 2.5771, -0.0670 * t + 0.3703};
}
Perez perez_x(double t) {
    return {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125,
            -0.0641 * t - 0.8989, -0.0033 * t + 0.0452};
}
Perez perez_y(double t) {
    return {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102,
            -0.0441 * t - 1.6537, -0.0109 * t + 0.0529};
}

/// Polynomial in the sun's zenith angle.
double cubic(double theta, double c3, double c2, double c1, double c0) {
    return ((c3 * theta + c2) * theta + c1) * theta + c0;
}
/// Chromaticity of the zenith. Source: Preetham, Shirley and Smits 1999, appendix 2.
double zenith_x(double t, double theta) {
    return t * t * cubic(theta, 0.00166, -0.00375, 0.00209, 0) +
           t * cubic(theta, -0.02903, 0.06377, -0.03202, 0.00394) +
           cubic(theta, 0.11693, -0.21196, 0.06052, 0.25886);
}
double zenith_y(double t, double theta) {
    return t * t * cubic(theta, 0.00275, -0.00610, 0.00317, 0) +
           t * cubic(theta, -0.04214, 0.08970, -0.04153, 0.00516) +
           cubic(theta, 0.15346, -0.26756, 0.06670, 0.26688);
}

using Picture = Image<Rgb>;

/// Elevation in the middle of a picture's row.
double row_elevation(int y) { return pi_d * (0.5 - (y + 0.5) / picture_height); }

/// Irradiance by the upper half of the picture on a horizontal surface.
Rgb sky_irradiance(const Picture& picture) {
    double r = 0, g = 0, b = 0;
    for (int y = 0; y < picture_height / 2; ++y) {
        const double top = std::cos(pi_d * y / picture_height), bottom = std::cos(pi_d * (y + 1) / picture_height);
        const double weight = (top * top - bottom * bottom) * (pi_d / picture_width);
        for (int x = 0; x < picture_width; ++x) {
            const Rgb c = picture.at(x, y);
            r += c.r * weight, g += c.g * weight, b += c.b * weight;
        }
    }
    return {float(r), float(g), float(b)};
}

/// Clear sky around a sun above or on the horizon, at an arbitrary level; the lower half stays black.
Picture clear_pattern(Vec3d sun, double turbidity) {
    const Perez luminances = perez_luminance(turbidity), xs = perez_x(turbidity), ys = perez_y(turbidity);
    const double theta = std::acos(std::clamp(sun.y, 0.0, 1.0));
    const double x_scale = zenith_x(turbidity, theta) / (xs.gradient(1) * xs.glow(theta));
    const double y_scale = zenith_y(turbidity, theta) / (ys.gradient(1) * ys.glow(theta));
    Picture picture(picture_width, picture_height);
    for (int row = 0; row < picture_height / 2; ++row) {
        const double elevation = row_elevation(row), cos_theta = std::sin(elevation);
        const double level = luminances.gradient(cos_theta);
        const double row_x = x_scale * xs.gradient(cos_theta), row_y = y_scale * ys.gradient(cos_theta);
        for (int column = 0; column < picture_width; ++column) {
            const double azimuth = 2 * pi_d * ((column + 0.5) / picture_width - 0.25);
            const Vec3d direction = direction_from_azimuth(azimuth, elevation);
            const double gamma = std::acos(std::clamp(dot(direction, sun), -1.0, 1.0));
            const double x = row_x * xs.glow(gamma), y = row_y * ys.glow(gamma);
            const double Y = level * luminances.glow(gamma);
            picture.at(column, row) = rec709_from_xyz(Y * x / y, Y, Y * (1 - x - y) / y);
        }
    }
    return picture;
}

/// CIE standard overcast sky, zenith luminance 1; the lower half stays black. Source: Moon and Spencer 1942.
Picture overcast_pattern() {
    Picture picture(picture_width, picture_height);
    for (int row = 0; row < picture_height / 2; ++row)
        for (int column = 0; column < picture_width; ++column)
            picture.at(column, row) = Rgb(float((1 + 2 * std::sin(row_elevation(row))) / 3));
    return picture;
}

/// Scales the sky to an illuminance and adds a constant one, both in lux.
void set_level(Picture& picture, double illuminance, double constant_illuminance) {
    const auto factor = float(illuminance / luminance(sky_irradiance(picture)));
    const Rgb constant(float(constant_illuminance / pi_d));
    for (int y = 0; y < picture_height / 2; ++y)
        for (int x = 0; x < picture_width; ++x) picture.at(x, y) = picture.at(x, y) * factor + constant;
}

void add_ground(Picture& picture, Rgb irradiance) {
    const Rgb radiance = irradiance * (ground_albedo / pi);
    for (int y = picture_height / 2; y < picture_height; ++y)
        for (int x = 0; x < picture_width; ++x) picture.at(x, y) = radiance;
}

void check(const SkySettings& s) {
    if (!(s.turbidity >= 2 && s.turbidity <= 10))
        throw usage_error("sky", "turbidity out of range (got " + std::to_string(s.turbidity) + ", expected 2 to 10)");
    if (!(std::abs(s.sun_elevation) <= pi_d / 2 + 1e-9))
        throw usage_error("sky", "sun elevation out of range (got " + std::to_string(s.sun_elevation * (180 / pi_d)) +
                                     " degrees, expected -90 to 90)");
    if (!std::isfinite(s.sun_azimuth)) throw usage_error("sky", "sun azimuth is not a number");
}

Environment clouded_sky(double illuminance) {
    Picture picture = overcast_pattern();
    set_level(picture, illuminance, 0);
    add_ground(picture, sky_irradiance(picture));
    return Environment(std::move(picture));
}

Environment clear_sky(const SkySettings& settings) {
    const double elevation = settings.sun_elevation;
    SunDisc disc;
    disc.direction = Vec3(direction_from_azimuth(settings.sun_azimuth, elevation));
    const Rgb direct_normal = sunlight(elevation, settings.turbidity) *
                              float(part_above_horizon(elevation / disc.angular_radius));
    disc.radiance = direct_normal / disc.solid_angle();
    const Rgb direct = direct_normal * float(std::max(0.0, std::sin(elevation)));

    Picture picture = clear_pattern(direction_from_azimuth(settings.sun_azimuth, std::max(0.0, elevation)),
                                    settings.turbidity);
    const double total = clear_sky_illuminance(elevation) - night_sky_illuminance;
    set_level(picture, total - luminance(direct), night_sky_illuminance);
    add_ground(picture, sky_irradiance(picture) + direct);
    return Environment(std::move(picture), disc);
}

}  // namespace

Environment make_sky(const SkySettings& settings) {
    check(settings);
    if (settings.weather == Weather::clear) return clear_sky(settings);
    const bool rain = settings.weather == Weather::rain;
    return clouded_sky((rain ? rain_cloud_transmittance : overcast_transmittance) *
                       clear_sky_illuminance(settings.sun_elevation));
}

}  // namespace pluvia
