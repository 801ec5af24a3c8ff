// What stands on the pavements of a city. Each in its own frame: y up, front towards +z, origin on the ground.
#pragma once

#include "scenes/palette.h"

namespace pluvia {

/// Post on a plinth with an arm towards +z; the luminaire hangs 5.6 m high and 1.3 m out, 5 000 lm, 2700 K. A lamp.
Assembly street_lamp(Palette& palette);
Assembly hydrant(Palette& palette);
Assembly trash_can(Palette& palette);      // ribbed zinc with a lid
Assembly litter_basket(Palette& palette);  // wire
Assembly mail_box(Palette& palette);
Assembly parking_meter(Palette& palette);
Assembly park_bench(Palette& palette);
Assembly sandwich_board(Palette& palette, const std::string& line_1, const std::string& line_2);
Assembly traffic_cone(Palette& palette);
/// Plate with an arrow to the left and ONE WAY, or with the letters of a street's name, on a post.
Assembly one_way_sign(Palette& palette);
Assembly name_sign(Palette& palette, const std::string& name);
/// Box hedge in a tub.
Assembly planter(Palette& palette, uint64_t seed);
/// A bag of rubbish, tied.
Assembly rubbish_bag(Palette& palette, uint64_t seed);

}  // namespace pluvia
