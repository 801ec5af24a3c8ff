// Where the sun stands at a place and time. The light it gives is in sky.h.
#pragma once

namespace pluvia {

/// A moment by the local clock, and the place. Daylight saving time is part of utc_offset.
struct PlaceAndTime {
    int year = 2025, month = 6, day = 21;  // Gregorian calendar, month and day from 1
    double hour = 12;                      // local clock; outside 0 to 24 it leads into the days around
    double utc_offset = 0;                 // hours that the local clock is ahead of UTC
    double latitude = 0;                   // radians, north positive, -pi/2 to pi/2
    double longitude = 0;                  // radians, east positive
};

/// Angles in radians.
struct SunPosition {
    double elevation = 0;  // of the disc's centre above the horizon, without refraction; -pi/2 to pi/2
    double azimuth = 0;    // clockwise from north seen from above, 0 to 2 pi; arbitrary where the sun is in the zenith
};

/// Position of the sun within 0.01 degrees between 1900 and 2100 (against the Solar Position Algorithm, Reda and
/// Andreas 2004). Refraction, left out, lifts the sun by 0.5 degrees at the horizon and by 0.1 at 10 degrees.
/// Throws usage_error for a date that does not exist and a latitude out of range.
/// Source: NOAA solar calculator, after Meeus 1998, Astronomical Algorithms, chapters 25 and 28 (low accuracy).
SunPosition sun_position(const PlaceAndTime& at);

}  // namespace pluvia
