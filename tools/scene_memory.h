// About how much memory a render of a scene takes.
#pragma once

#include "renderer/scene/scene.h"

#include <cstddef>

namespace pluvia {

/// Bytes. What depends on the picture's size, its layers and the rain comes on top.
struct SceneMemory {
    size_t geometry = 0;   // vertices, triangles and instances
    size_t textures = 0;   // 4 bytes per texel
    size_t hierarchy = 0;  // over the triangles; an estimate
    size_t program = 0;    // libraries and tables, scene or not; an estimate

    size_t total() const { return geometry + textures + hierarchy + program; }
};

SceneMemory estimate_memory(const Scene& scene);

}  // namespace pluvia
