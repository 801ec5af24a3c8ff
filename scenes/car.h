// Cars: a body drawn over cross-sections, a cabin of dark glass with painted pillars, wheels and what is fixed on.
// Those that drive have their lamps on.
#pragma once

#include "scenes/palette.h"

namespace pluvia {

struct CarShape {
    float length = 4.55f, width = 1.8f, height = 1.44f;  // metres
    float bonnet = 0.92f, boot = 0.98f;                  // heights of the body before and behind the cabin
    float cabin_front = 0.75f, cabin_rear = -1.75f;      // z of the feet of windscreen and rear window
    float roof_front = 0.0f, roof_rear = -1.05f;         // z of the roof's ends
    bool taxi_sign = false;
    bool lamps_on = false;  // see car_lamps.h
};
CarShape saloon();
CarShape hatchback();
CarShape estate();

/// Front towards +z, origin on the ground in the middle. paint: a finish such as "car_red".
Assembly car(Palette& palette, const CarShape& shape, const std::string& paint);

}  // namespace pluvia
