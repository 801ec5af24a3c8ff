// What a SkyGuide learns from: paths through a picture that look for the sky.
#pragma once

#include "renderer/accel/ray_scene.h"
#include "renderer/core/view.h"
#include "renderer/scene/lights.h"
#include "renderer/transport/sky_guide.h"
#include "renderer/transport/wet_ground.h"

namespace pluvia {

/// Whether light samples of this sky are worth a guide: it has a picture, no sun outshines it, and no lamps by night.
/// There what the sun lights next or what lamps light makes the noise, and the guide would cost more than it saves.
bool is_worth_guiding(const Lights& lights);

/// Those of a few paths through pixels all over the picture, the same for any number of threads. wet_ground: null where
/// all is dry.
std::vector<SkySight> find_sky_sights(const RayScene& ray_scene, const Environment& environment, const View& view,
                                      const WetGround* wet_ground, uint64_t seed, Counters& counters);

}  // namespace pluvia
