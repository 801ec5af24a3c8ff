#include "shaders/moon_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double degree = std::numbers::pi / 180;

}  // namespace

MoonPosition moon_position(const PlaceAndTime& at) {
    const Moment moment = moment_of(at);
    const double T = moment.julian_centuries();
    const auto sine = [&](double at_2000, double per_century) {
        return std::sin(degree * (at_2000 + per_century * T));
    };
    const auto cosine = [&](double at_2000, double per_century) {
        return std::cos(degree * (at_2000 + per_century * T));
    };
    const double longitude =
        degree * (218.32 + 481267.881 * T + 6.29 * sine(135.0, 477198.87) - 1.27 * sine(259.3, -413335.36) +
                  0.66 * sine(235.7, 890534.22) + 0.21 * sine(269.9, 954397.74) - 0.19 * sine(357.5, 35999.05) -
                  0.11 * sine(186.5, 966404.03));
    const double latitude = degree * (5.13 * sine(93.3, 483202.02) + 0.28 * sine(228.2, 960400.89) -
                                      0.28 * sine(318.3, 6003.15) - 0.17 * sine(217.6, -407332.21));
    const double parallax = degree * (0.9508 + 0.0518 * cosine(135.0, 477198.87) + 0.0095 * cosine(259.3, -413335.36) +
                                      0.0078 * cosine(235.7, 890534.22) + 0.0028 * cosine(269.9, 954397.74));

    const double obliquity = degree * (23.439291 - 0.0130042 * T);
    const double x = std::cos(latitude) * std::cos(longitude);
    const double y =
        std::cos(obliquity) * std::cos(latitude) * std::sin(longitude) - std::sin(obliquity) * std::sin(latitude);
    const double z =
        std::sin(obliquity) * std::cos(latitude) * std::sin(longitude) + std::cos(obliquity) * std::sin(latitude);
    const double right_ascension = std::atan2(y, x), declination = std::asin(std::clamp(z, -1.0, 1.0));
    // Mean sidereal time; Meeus 1998, eq. 12.4. Whole days are taken apart to
    // keep the digits.
    const double sidereal = degree * (280.46061837 + std::remainder(0.98564736629 * moment.days, 360.0) + 180.0 +
                                      360.98564736629 * moment.hour / 24);

    MoonPosition moon;
    static_cast<Horizontal&>(moon) =
        horizontal_from_equatorial(declination, sidereal + at.longitude - right_ascension, at.latitude);
    // From the planet's surface it stands lower than from its centre.
    moon.elevation = std::atan2(std::sin(moon.elevation) - std::sin(parallax), std::cos(moon.elevation));
    moon.parallax = parallax;
    const double elongation = std::acos(
        std::clamp(std::cos(latitude) * std::cos(longitude - sun_position(at).ecliptic_longitude), -1.0, 1.0));
    constexpr double sun_distance_in_moons = 389;  // mean
    moon.phase_angle = std::atan2(std::sin(elongation), 1 / sun_distance_in_moons - std::cos(elongation));
    return moon;
}

}  // namespace pluvia
