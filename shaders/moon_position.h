// Where the moon stands at a place and time, and how much of its face the sun
// lights.
#pragma once

#include "shaders/sun_position.h"

namespace pluvia {

struct MoonPosition : Horizontal {  // seen from the place, not from the planet's centre
    double parallax = 0.0166;       // radians, of the equator's radius seen from the
                                    // moon: its nearness
    double phase_angle = 0;         // radians between the directions to sun and earth
                                    // seen from the moon: 0 is full
};

/// Position within 0.4 degrees and phase angle within 1. Throws as moment_of.
/// Source: the low-precision series of the Astronomical Almanac (page D46),
/// after van Flandern and Pulkkinen 1979.
MoonPosition moon_position(const PlaceAndTime& at);

}  // namespace pluvia
