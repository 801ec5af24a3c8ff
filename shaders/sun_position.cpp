#include "shaders/sun_position.h"

#include "renderer/core/error.h"

#include <chrono>
#include <cmath>
#include <numbers>
#include <string>

namespace pluvia {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;

/// Days from noon (UTC) of 1 January 2000 to midnight (UTC) of a date.
double days_since_2000(int year, int month, int day) {
    using namespace std::chrono;
    const year_month_day date{std::chrono::year(year), std::chrono::month(unsigned(month)),
                              std::chrono::day(unsigned(day))};
    if (!date.ok())
        throw usage_error("date", "no such day (got " + std::to_string(year) + "-" + std::to_string(month) + "-" +
                                      std::to_string(day) + ", expected a day of the calendar)");
    return double((sys_days(date) - sys_days(std::chrono::year(2000) / 1 / 1)).count()) - 0.5;
}

}  // namespace

Moment moment_of(const PlaceAndTime& at) {
    if (!(std::abs(at.latitude) <= pi / 2 + 1e-9))
        throw usage_error(
            "latitude", "out of range (got " + std::to_string(at.latitude / degree) + " degrees, expected -90 to 90)");
    const double hour = at.hour - at.utc_offset, whole_days = std::floor(hour / 24);
    return {days_since_2000(at.year, at.month, at.day) + whole_days, hour - 24 * whole_days};
}

Horizontal horizontal_from_equatorial(double declination, double hour_angle, double latitude) {
    const double up =
        std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(hour_angle);
    const double east = -std::cos(declination) * std::sin(hour_angle);
    const double north =
        std::sin(declination) * std::cos(latitude) - std::cos(declination) * std::sin(latitude) * std::cos(hour_angle);
    const double azimuth = std::atan2(east, north);
    return {std::atan2(up, std::hypot(east, north)), azimuth < 0 ? azimuth + 2 * pi : azimuth};
}

SunPosition sun_position(const PlaceAndTime& at) {
    const Moment moment = moment_of(at);
    const double T = moment.julian_centuries();
    const double mean_longitude = degree * (280.46646 + T * (36000.76983 + 0.0003032 * T));
    const double M = degree * (357.52911 + T * (35999.05029 - 0.0001537 * T));  // mean anomaly
    const double e = 0.016708634 - T * (0.000042037 + 1.267e-7 * T);            // eccentricity of the orbit
    const double centre = degree * ((1.914602 - T * (0.004817 + 1.4e-5 * T)) * std::sin(M) +
                                    (0.019993 - 0.000101 * T) * std::sin(2 * M) + 0.000289 * std::sin(3 * M));
    const double node = degree * (125.04 - 1934.136 * T);  // of the Moon: nutation
    const double longitude = mean_longitude + centre - degree * (0.00569 + 0.00478 * std::sin(node));
    const double obliquity = degree * (23.439291 - 0.0130042 * T + 0.00256 * std::cos(node));
    const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));

    const double y = std::tan(obliquity / 2) * std::tan(obliquity / 2);
    const double equation_of_time =  // true minus mean solar time, as an angle
        y * std::sin(2 * mean_longitude) - 2 * e * std::sin(M) +
        4 * e * y * std::sin(M) * std::cos(2 * mean_longitude) - 0.5 * y * y * std::sin(4 * mean_longitude) -
        1.25 * e * e * std::sin(2 * M);
    const double hour_angle = (moment.hour - 12) * (15 * degree) + at.longitude + equation_of_time;
    const double distance = 1.000001018 * (1 - e * e) / (1 + e * std::cos(M + centre));
    return {horizontal_from_equatorial(declination, hour_angle, at.latitude), distance, longitude};
}

double refraction(double elevation) {
    const double h = elevation / degree;
    const auto lift = [](double degrees) {  // Saemundsson's formula, in degrees
        return 1.02 / 60 / std::tan((degrees + 10.3 / (degrees + 5.11)) * degree);
    };
    constexpr double lowest = -0.575, end = -5;
    if (h >= lowest) return std::max(0.0, lift(h)) * degree;
    if (h <= end) return 0;
    // A cubic that continues value and slope, so that the sun does not change its
    // pace.
    constexpr double width = lowest - end, step = 1e-4;
    const double slope = (lift(lowest + step) - lift(lowest)) / step * width, t = (h - end) / width;
    return (lift(lowest) * t * t * (3 - 2 * t) + slope * t * t * (t - 1)) * degree;
}

}  // namespace pluvia
