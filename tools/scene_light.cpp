#include "tools/scene_light.h"

#include "renderer/scene/lamps.h"

namespace pluvia {

void prepare_scene(Scene& scene, const RenderOptions& options, const FrameSettings& settings) {
    if (lamp_count(scene) > 0 && !lamps_are_on(options.light, settings.environment)) switch_off_lamps(scene);
    scene.unlit_luminance = unlit_luminance(settings.ev100, settings.environment);
}

}  // namespace pluvia
