// Where the sun stands at a place and time, and by how much air lifts what stands low. The moon is in moon_position.h,
// the light of both in sky.h.
#pragma once

namespace pluvia {

/// A moment by the local clock, and the place. Daylight saving time is part of utc_offset.
struct PlaceAndTime {
    int year = 2025, month = 6,
        day = 21;           // Gregorian calendar, month and day from 1
    double hour = 12;       // local clock; outside 0 to 24 it leads into the days around
    double utc_offset = 0;  // hours that the local clock is ahead of UTC
    double latitude = 0;    // radians, north positive, -pi/2 to pi/2
    double longitude = 0;   // radians, east positive
};

/// A moment in universal time. Hour 24 of a day and hour 0 of the next are the same moment to the last bit.
struct Moment {
    double days = 0;  // from noon of 1 January 2000 to the midnight before
    double hour = 0;  // of that day, 0 to 24

    double julian_centuries() const { return (days + hour / 24) / 36525; }
};
/// Throws usage_error for a date that does not exist and a latitude out of range.
Moment moment_of(const PlaceAndTime& at);

/// Direction in radians.
struct Horizontal {
    double elevation = 0;  // above the horizon, without refraction; -pi/2 to pi/2
    double azimuth = 0;    // clockwise from north seen from above, 0 to 2 pi;
                           // arbitrary in the zenith
};
/// declination and hour_angle (westward) in radians.
Horizontal horizontal_from_equatorial(double declination, double hour_angle, double latitude);

struct SunPosition : Horizontal {
    double distance = 1;            // astronomical units
    double ecliptic_longitude = 0;  // radians
};

/// Position of the sun's centre within 0.01 degrees between 1900 and 2100 (against the Solar Position Algorithm, Reda
/// and Andreas 2004). Throws as moment_of. Source: NOAA solar calculator, after Meeus 1998, Astronomical Algorithms,
/// chapters 25 and 28 (low accuracy).
SunPosition sun_position(const PlaceAndTime& at);

/// Angle in radians by which air lifts what stands at an elevation: 0.48 degrees at the horizon; below -0.6 degrees,
/// where no formula is made for, it falls smoothly to 0 at -5 degrees. Source: Saemundsson 1986, as Meeus 1998, eq.
/// 16.4.
double refraction(double elevation);

}  // namespace pluvia
