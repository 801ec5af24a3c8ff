// What options and the light around a scene make of it before it is rendered.
#pragma once

#include "tools/frame_render.h"

namespace pluvia {

/// Switches its lamps on or off and gives unlit surfaces their light.
void prepare_scene(Scene& scene, const RenderOptions& options, const FrameSettings& settings);

}  // namespace pluvia
