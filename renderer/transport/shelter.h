// Which drops a roof keeps away: only transport may ask rays, so it is decided here and not in renderer/rain.
#pragma once

#include "renderer/accel/ray_scene.h"
#include "renderer/core/view.h"
#include "renderer/rain/streaks.h"

namespace pluvia {

/// Removes the drops whose way down from the top of the rain meets a surface. Order is kept.
void remove_sheltered(std::vector<Streak>& streaks, const View& view, const RayScene& ray_scene, Counters& counters);

}  // namespace pluvia
