// The kinds of houses of city streets.
#pragma once

#include "scenes/facade.h"

namespace pluvia {

/// One of ten kinds, 'A' to 'J'.
TownHouse city_house(char letter);

}  // namespace pluvia
