// Light of drops in front of a picture: of lamps, of what the picture shows, and of what is far around.
#pragma once

#include "renderer/transport/drop_light.h"
#include "renderer/transport/far_light.h"
#include "renderer/transport/path.h"
#include "renderer/transport/picture_source.h"

namespace pluvia {

/// Lamps and the surfaces that the tracer's scene has are looked for; what is farther is far's. near: metres of view
/// depth where rain begins.
DropLight picture_drop_light(const PathTracer& tracer, const FarLight& far, const PictureSource& picture,
                             const View& view, uint64_t seed, float near, Counters& counters);

}  // namespace pluvia
