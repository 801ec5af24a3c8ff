// Which bodies of glass or water are closed.
#pragma once

#include "renderer/scene/scene.h"

namespace pluvia {

/// Light that enters a body must leave it. Meshes whose material has a volume but whose surface has an edge get a copy
/// of the material without volume: they are rendered as thin sheets, and a warning names them.
void make_open_volumes_thin(Scene& scene);

}  // namespace pluvia
