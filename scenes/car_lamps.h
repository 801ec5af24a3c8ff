// What shines of a car that drives by night: dipped head lamps and tail lamps.
#pragma once

#include "scenes/car.h"

#include <vector>

namespace pluvia {

/// The dipped beams of both head lamps in the car's frame, two spots of each: one of 20 000 cd, as ECE R112 allows,
/// that ends where the way ahead does, and a wide one of 2 000 cd over the ground before the car.
std::vector<PunctualLight> dipped_beams(const CarShape& shape);

// Finishes: glass of which those see the light who stand beside the beams. Lamps.
/// 10 000 cd/m2: about 80 cd from 80 cm2.
int head_lamp_glow(Palette& palette);
/// 150 cd/m2: about 9 cd from a lamp's 0.06 m2; ECE R7 has 4 to 17.
int tail_lamp_glow(Palette& palette);

}  // namespace pluvia
