// What the signs of the Japanese shopping street say: food, drink, songs and coffee.
#pragma once

#include "scenes/lit_signs.h"

#include <vector>

namespace pluvia {

std::vector<SignPrint> tall_prints();    // stand out from walls, twice to four times as high as wide
std::vector<SignPrint> wide_prints();    // over shops, four times as wide as high
std::vector<SignPrint> castor_prints();  // on the ground

}  // namespace pluvia
