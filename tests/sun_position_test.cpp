// Where sun and moon stand, against almanacs.
#include "shaders/moon_position.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace pluvia;

namespace {

double degrees(double radians) {
    return radians / radians_from_degrees(1);
}

SunPosition sun_at(int year, int month, int day, double utc_hour, double latitude, double longitude) {
    return sun_position({.year = year,
                         .month = month,
                         .day = day,
                         .hour = utc_hour,
                         .utc_offset = 0,
                         .latitude = radians_from_degrees(latitude),
                         .longitude = radians_from_degrees(longitude)});
}

double noon_elevation(int month, int day, double latitude) {
    double highest = -90;
    for (double hour = 11; hour <= 13; hour += 0.02)
        highest = std::max(highest, degrees(sun_at(2025, month, day, hour, latitude, 0).elevation));
    return highest;
}

}  // namespace

TEST_CASE("the sun stands where the almanac says") {
    // Solar Position Algorithm (Reda and Andreas 2004), topocentric zenith and azimuth; where the published zenith
    // includes refraction, elevations are compared above 36 degrees, where it is below 0.025.
    struct Known {
        int year, month, day;
        double hour, latitude, longitude, elevation, azimuth, tolerance;
    };
    const Known known[] = {
        {2003, 10, 17, 19.508333, 39.742476, -105.1786, 90 - 50.11162, 194.34024, 0.03},
        {1910, 3, 15, 0.5, -36.840556, 174.74, 90 - 34.269919, 0.188643, 0.03},
        {1910, 3, 15, 3.5, -36.840556, 174.74, 90 - 53.637925, 298.894756, 0.03},
        {1910, 3, 15, 9.5, -36.840556, 174.74, 90 - 122.642657, 237.156205, 0.03},
    };
    for (const Known& k : known) {
        CAPTURE(k.hour);
        const SunPosition sun = sun_at(k.year, k.month, k.day, k.hour, k.latitude, k.longitude);
        CHECK(std::abs(degrees(sun.elevation) - k.elevation) < k.tolerance);
        CHECK(std::abs(std::remainder(degrees(sun.azimuth) - k.azimuth, 360)) < 0.01);
    }
}

TEST_CASE("the noon sun of solstices and equinoxes stands at the height of its latitude") {
    CHECK(std::abs(noon_elevation(6, 21, 51.5) - (90 - 51.5 + 23.44)) < 0.02);
    CHECK(std::abs(noon_elevation(12, 21, 51.5) - (90 - 51.5 - 23.44)) < 0.02);
    CHECK(std::abs(noon_elevation(3, 20, 51.5) - (90 - 51.5)) < 0.3);  // the equinox is at 9:01 UTC, not at noon
    CHECK(std::abs(noon_elevation(9, 22, 51.5) - (90 - 51.5)) < 0.3);
    CHECK(std::abs(noon_elevation(6, 21, 80) - 33.44) < 0.02);
    CHECK(degrees(sun_at(2025, 6, 21, 0, 80, 0).elevation) > 13);  // it does not set there
}

TEST_CASE("clock, time zone and longitude shift the sun alike") {
    PlaceAndTime at = {.year = 2025,
                       .month = 4,
                       .day = 10,
                       .hour = 16,
                       .utc_offset = 2,
                       .latitude = radians_from_degrees(50),
                       .longitude = radians_from_degrees(8)};
    const SunPosition summer_time = sun_position(at);
    at.hour = 15, at.utc_offset = 1;
    CHECK(sun_position(at).elevation == doctest::Approx(summer_time.elevation).epsilon(1e-12).scale(0));
    at.day = 11, at.hour = -9;
    CHECK(sun_position(at).elevation == doctest::Approx(summer_time.elevation).epsilon(1e-9).scale(0));
    CHECK(degrees(summer_time.azimuth) > 180);  // afternoon: in the west
}

TEST_CASE("a day that does not exist is refused") {
    CHECK_THROWS_WITH_AS(sun_position({.year = 2025, .month = 2, .day = 29}), doctest::Contains("2025-2-29"), Error);
    CHECK_THROWS_AS(sun_position({.month = 13}), Error);
    CHECK_THROWS_AS(sun_position({.latitude = 2}), Error);
}

TEST_CASE("hour 24 is hour 0 of the next day to the last bit") {
    for (const double offset : {0.0, 9.0, -5.5, 12.75, 0.1}) {
        PlaceAndTime late = {
            .year = 2024, .month = 2, .day = 28, .hour = 24, .utc_offset = offset, .latitude = 0.9, .longitude = 2};
        PlaceAndTime early = late;
        early.day = 29, early.hour = 0;
        CHECK(sun_position(late).elevation == sun_position(early).elevation);
        CHECK(sun_position(late).azimuth == sun_position(early).azimuth);
        CHECK(moon_position(late).elevation == moon_position(early).elevation);
        CHECK(moon_position(late).phase_angle == moon_position(early).phase_angle);
    }
}

TEST_CASE("the sun's distance is the almanac's") {
    // Reda and Andreas 2004, example: 0.996542 AU. Perihelion and aphelion of 2024: 0.98331 and 1.01673 AU.
    CHECK(sun_at(2003, 10, 17, 19.508333, 40, -105).distance == doctest::Approx(0.996542).epsilon(2e-5));
    CHECK(sun_at(2024, 1, 3, 1, 0, 0).distance == doctest::Approx(0.98331).epsilon(2e-5));
    CHECK(sun_at(2024, 7, 5, 5, 0, 0).distance == doctest::Approx(1.01673).epsilon(2e-5));
}

TEST_CASE("refraction lifts the sun as measured, and fades without a step below the horizon") {
    // Meeus 1998, example 16.a: 24.618 arc minutes for a true elevation of 33'14.76" - 28.754' at the horizon.
    CHECK(60 * degrees(refraction(radians_from_degrees(0.5541))) == doctest::Approx(24.618).epsilon(2e-3));
    CHECK(60 * degrees(refraction(0)) == doctest::Approx(28.98).epsilon(1e-3));
    CHECK(degrees(refraction(radians_from_degrees(90))) < 1e-4);
    CHECK(refraction(radians_from_degrees(-5)) == 0);
    const double step = 0.01;
    double before = 0, pace_before = 1;
    for (double elevation = -6; elevation < 90; elevation += step) {
        const double apparent = elevation + degrees(refraction(radians_from_degrees(elevation)));
        const double pace = elevation > -6 ? (apparent - before) / step : 1;
        CAPTURE(elevation);
        CHECK(pace > 0.7);  // the order of elevations is kept
        CHECK(pace < 1.3);
        CHECK(std::abs(pace - pace_before) < 0.02);
        before = apparent, pace_before = pace;
    }
}

TEST_CASE("the moon stands where the almanac says") {
    // Meeus 1998, example 47.a: 12 April 1992, 0 h TD: declination 13.768, parallax 0.991990 degrees. Seen from the
    // pole it stands at its declination, less its parallax. Example 48.a: 67.9 % of it lit.
    const MoonPosition moon =
        moon_position({.year = 1992, .month = 4, .day = 12, .hour = 0, .latitude = radians_from_degrees(90)});
    CHECK(std::abs(degrees(moon.elevation) - (13.768 - 0.991990 * std::cos(radians_from_degrees(13.8)))) < 0.4);
    CHECK(degrees(moon.parallax) == doctest::Approx(0.99199).epsilon(0.005));
    CHECK(std::abs(0.5 * (1 + std::cos(moon.phase_angle)) - 0.679) < 0.01);
    // Eclipses: the moon before the sun on 8 April 2024, 18:18 UT, seen from Mazatlan at 23.2 N, 106.4 W; total eclipse
    // of the moon on 14 March 2025, 6:59 UT.
    const PlaceAndTime mazatlan = {.year = 2024,
                                   .month = 4,
                                   .day = 8,
                                   .hour = 18.15,
                                   .latitude = radians_from_degrees(23.2),
                                   .longitude = radians_from_degrees(-106.4)};
    const MoonPosition new_moon = moon_position(mazatlan);
    const SunPosition sun = sun_position(mazatlan);
    CHECK(std::abs(degrees(new_moon.elevation - sun.elevation)) < 0.5);
    CHECK(std::abs(degrees(new_moon.azimuth - sun.azimuth)) * std::cos(sun.elevation) < 0.5);
    CHECK(degrees(moon_position({.year = 2025, .month = 3, .day = 14, .hour = 6.98}).phase_angle) < 1.5);
}

TEST_CASE("the moon takes 29.53 days from new to new") {
    PlaceAndTime at = {.year = 2024, .month = 1, .day = 1, .hour = 0};
    std::vector<double> full;
    double before = 0;
    bool falling = false;
    for (; at.hour < 24 * 366; at.hour += 1) {
        const double angle = moon_position(at).phase_angle;
        if (falling && angle > before) full.push_back(at.hour);
        falling = angle < before, before = angle;
    }
    REQUIRE(full.size() >= 12);
    CHECK((full.back() - full.front()) / double(full.size() - 1) / 24 == doctest::Approx(29.53).epsilon(0.01));
}
