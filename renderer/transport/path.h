// Radiance along a ray: an unbiased path tracer with next-event estimation, multiple importance sampling and roulette.
#pragma once

#include "renderer/transport/direct_light.h"
#include "renderer/transport/wet_ground.h"

#include <limits>

namespace pluvia {

struct PathSettings {
    /// Scattering events after which a path is cut. Unlimited by default; any limit loses light and so biases.
    int max_bounces = std::numeric_limits<int>::max();
    /// Samples of lamps that compete for a shadow ray at a path's first vertex, 1 to most_light_samples: half as many
    /// at the second, a quarter from there on.
    int light_samples = 8;
    /// Paths that carry less than this share of the light they meet end by roulette, so that those that live on carry
    /// that share; not before their second scattering event. At 0.25 time times error is least on streets by day, at
    /// dusk and at night.
    float path_roulette = 0.25f;
    /// Shadow rays that bring less than this share of a pixel's light are traced for some samples only. What they add
    /// to a sample's relative variance is at most this times the share of that light. 0: all are traced.
    float shadow_roulette = 0.25f;
};

/// What the light of a path is worth, which decides how often roulette ends it or leaves out a shadow ray.
struct PathWorth {
    float pixel_luminance = 0;  // of the pixel as far as known, in cd/m2; 0: unknown
    float importance = 1;       // share of what the path brings that its pixel gets
};

struct PathResult {
    Rgb radiance;
    float distance = std::numeric_limits<float>::infinity();  // to the first surface that does not let the ray pass
    SurfacePoint first = {};                                  // on it; instance -1 where there is none
};

class PathTracer {
public:
    /// Keeps references. wet_ground: null where all is dry. sky_guide: null: the sky is sampled as if all of it were
    /// visible.
    PathTracer(const Scene& scene, const RayScene& ray_scene, const Lights& lights, const PathSettings& settings,
               const WetGround* wet_ground = nullptr, const SkyGuide* sky_guide = nullptr)
        : scene_(&scene),
          ray_scene_(&ray_scene),
          lights_(&lights),
          settings_(settings),
          wet_ground_(wet_ground),
          sky_guide_(sky_guide) {}

    /// bounce: scattering events before this ray; it selects the random numbers and counts towards max_bounces.
    PathResult trace(Ray ray, RayOrigin origin, const Sampler& sampler, int bounce, Counters& counters,
                     const PathWorth& worth = {}) const;

    /// See Vertex::relevance. Infinite where all shadow rays are traced.
    float relevance(Rgb throughput, const PathWorth& worth) const {
        const float least = settings_.shadow_roulette * worth.pixel_luminance;
        const float share = worth.importance * max_component(throughput);
        return least > 0 ? share / least : std::numeric_limits<float>::infinity();
    }

    const Lights& lights() const { return *lights_; }
    const RayScene& ray_scene() const { return *ray_scene_; }

private:
    const Scene* scene_;
    const RayScene* ray_scene_;
    const Lights* lights_;
    PathSettings settings_;
    const WetGround* wet_ground_;
    const SkyGuide* sky_guide_;
};

}  // namespace pluvia
