// Texture look-ups at a point of a surface: bilinear or nearest, with the wrap modes of glTF.
#pragma once

#include "renderer/scene/scene.h"

namespace pluvia {

/// Colour of an sRGB-coded texture in linear Rec.709. uv (0, 0) is the upper left corner.
Rgb lookup_color(const Scene& scene, int texture, Vec2 uv);
/// The three stored channels of a linear texture, 0 to 1.
Vec3 lookup_linear(const Scene& scene, int texture, Vec2 uv);
/// The stored alpha, 0 to 1.
float lookup_alpha(const Scene& scene, int texture, Vec2 uv);
/// Asks for the texels of a look-up that is to come, so that several are on their way from memory at once.
void prefetch_texels(const Scene& scene, int texture, Vec2 uv);

}  // namespace pluvia
