// Lamps: what of a scene shines by switch. A scene is read with its lamps on; by day they are switched off.
// Marked are materials, instances and punctual lights; gltf_extras.h has the mark as a file carries it.
#pragma once

#include "renderer/scene/scene.h"

namespace pluvia {

/// Materials, instances and punctual lights that are marked as lamps.
int lamp_count(const Scene& scene);

/// Takes the light from all that is marked: materials emit nothing, instances get their mesh with a material that does
/// not emit, punctual lights are removed. The rest of the scene shines as before.
void switch_off_lamps(Scene& scene);

}  // namespace pluvia
