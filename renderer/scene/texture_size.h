// Smaller copies of a scene's pictures, for machines with little memory.
#pragma once

#include "renderer/scene/scene.h"

namespace pluvia {

/// Replaces pictures with a side above `largest` texels (1 or more) by ones whose sides are theirs halved as often as
/// it takes, rounded up. A texel is the mean of what it covers: of light where a colour is read from the picture, and
/// then by its opacity, so that what is cut away colours no rim; else of the stored values. BIASED: near surfaces blur,
/// normals flatten, highlights of rough and smooth parts mix.
void shrink_textures(Scene& scene, int largest);

}  // namespace pluvia
