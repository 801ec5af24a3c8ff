// Direct light: what a surface scatters of the light that reaches it straight from lamps and sky.
// Of several light samples the one that would bring most is tested for visibility: a shadow ray costs more than asking
// a Bsdf and a light, and neither the light tree nor the sky's tables know which of them a glossy surface mirrors.
// Source: Talbot, Cline and Egbert 2005, "Importance Resampling for Global Illumination".
#pragma once

#include "renderer/accel/ray_scene.h"
#include "renderer/core/random.h"
#include "renderer/core/sampling.h"
#include "renderer/scene/lights.h"

#include <algorithm>

namespace pluvia {

class SkyGuide;

constexpr int most_light_samples = 16;

/// Samples of lamps that compete at a vertex for one shadow ray, where `at_first` do at the first. Fewer after
/// scattering, where their noise is less of the picture's: measured on lit streets, time and error weighed.
constexpr int light_samples_at(int at_first, int bounce) {
    return std::max(std::min(at_first, 2), at_first >> std::min(bounce, 2));
}

/// In place of a number of samples of lamps: rays that meet lamps by themselves do not count.
constexpr int samples_alone = 0;

/// Where light samples were drawn, as far as the weight of a ray that left there needs it.
struct RayOrigin {
    float pdf = 0;      // of the ray's direction, per solid angle; 0 = no light sample was drawn there (camera, delta)
    Receiver receiver;  // what the light samples were drawn for
    int local_samples = 1;           // of lamps
    bool parts_sky_and_sun = false;  // of these samples each, instead of one of all that is distant

    /// Weight of light that the ray has met against samples of it, where pdf > 0. light_pdf: of one sample.
    float weight_of_local(float light_pdf) const {
        return local_samples == samples_alone ? 0 : power_heuristic(pdf, float(local_samples) * light_pdf);
    }
};

/// Light of the environment that a ray meets, weighed against samples of it. guide: that they were drawn with; null:
/// none.
Rgb distant_light(const Lights& lights, const SkyGuide* guide, const RayOrigin& origin, Vec3 direction);

/// For what lights are chosen: those below the horizon, too, where they shine through.
inline Receiver receiver_at(const Surface& surface, const PreparedBsdf& bsdf) {
    return {surface.position, is_translucent(bsdf) ? Vec3() : surface.shading_normal};
}

/// A scattering vertex of a path.
struct Vertex {
    const Scene& scene;
    const Surface& surface;
    const PreparedBsdf& bsdf;
    const ShadingBasis& basis;
    const Sampler& sampler;
    const VertexNumbers& u;
    int bounce;
    int light_samples;  // of lamps, up to most_light_samples
    float relevance;    // 1 / (light at the vertex, in cd/m2, below which a shadow ray is worth tracing only at times)
};

/// Weight of a shadow ray that brings at most `expected`, in cd/m2, where relevance is as for a vertex: 0 where
/// roulette leaves it out. key: of a random number.
float shadow_ray_weight(float expected, float relevance, uint64_t key);

/// Share of a light sample that arrives at a point: 1, 0, or what smooth panes on the way let straight through.
Rgb visible_share(const RayScene& ray_scene, Vec3 from, const LightSample& light, OpacityTest opacity,
                  Counters& counters);

/// Radiance that the surface scatters towards the ray it was met by, weighed against sampling the Bsdf. guide: of
/// samples of the sky; null: none.
Rgb direct_light(const RayScene& ray_scene, const Lights& lights, const SkyGuide* guide, const Vertex& vertex,
                 Counters& counters);

}  // namespace pluvia
