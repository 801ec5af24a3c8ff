// What feeds and cools the houses of a Japanese street. Facade frame as in wall.h for what hangs on walls.
#pragma once

#include "scenes/palette.h"

namespace pluvia {

Assembly air_conditioner(Palette& palette);  // outdoor unit on brackets, 0.78 m wide, with its pipe
Assembly meter_box(Palette& palette);
Assembly utility_pole(Palette& palette);  // of concrete, 7.8 m, with a transformer; origin on the ground
/// Cable that sags by `sag` metres between two points.
void add_cable(Assembly& assembly, Palette& palette, Vec3 from, Vec3 to, float sag, float radius = 0.008f);

}  // namespace pluvia
