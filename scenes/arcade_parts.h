// Steps of build_arcade, for arcade.cpp.
#pragma once

#include "scenes/arcade.h"
#include "scenes/palette.h"

namespace pluvia {

void add_ground(const ArcadePlan& plan, Street& street, Palette& palette);
void add_poles(const ArcadePlan& plan, Street& street, Palette& palette);
void add_things(const ArcadePlan& plan, Street& street, Palette& palette);

}  // namespace pluvia
