// Wet ground: water on the surfaces of a scene, put on when a path meets them. A film wherever rain reaches, puddles on
// what is level, rings of drops on the puddles. The scene itself stays as its file has it.
#pragma once

#include "renderer/rain/ripples.h"
#include "renderer/transport/rain_shadow.h"

#include <cstdint>

namespace pluvia {

/// Of the clean picture, whatever it rains in the others.
struct WetSettings {
    float wetness = 0;            // 0 = dry, 1 = a closed film
    float puddles = 0;            // share of level ground that water stands on, 0 to 1
    double ripples_mm_per_h = 0;  // intensity of the rain that rings on puddles come from

    bool any() const { return wetness > 0 || puddles > 0; }
};

class WetGround {
public:
    /// time: of the picture, seconds of the sequence. Keeps references.
    WetGround(const Scene& scene, const RainShadow& shadow, const WetSettings& settings, double time, uint64_t seed);

    /// Puts water on a surface that a ray with this direction has met at `point`; calls after which nothing has changed
    /// are not counted. Materials that opt out and surfaces that look down stay dry.
    void wet(Surface& surface, const SurfacePoint& point, Vec3 direction, Counters& counters) const;

private:
    const Scene* scene_;
    const RainShadow* shadow_;
    WetSettings settings_;
    double time_;
    Ripples ripples_;
};

}  // namespace pluvia
