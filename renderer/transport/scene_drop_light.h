// Light of drops in a scene by paths from random places of the view, as rain_stage.h has it of each drop.
#pragma once

#include "renderer/scene/scene.h"
#include "renderer/transport/drop_light.h"
#include "renderer/transport/path.h"
#include "renderer/transport/rain_shadow.h"

namespace pluvia {

/// All light but for what lamps bring to the drops straight, which is too sharp for a table. far_scene: of
/// far_bounds(). shadow: no drops are looked for where it is not open; null: everywhere. near: metres of view depth
/// where rain begins.
DropLight scene_drop_light(const PathTracer& tracer, const View& view, const Bounds& far_scene,
                           const RainShadow* shadow, uint64_t seed, float near, Counters& counters);

}  // namespace pluvia
