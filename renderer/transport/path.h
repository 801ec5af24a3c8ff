// Radiance along a ray: an unbiased path tracer with next-event estimation, multiple importance sampling and roulette.
#pragma once

#include "renderer/accel/ray_scene.h"
#include "renderer/core/random.h"
#include "renderer/scene/lights.h"

#include <limits>

namespace pluvia {

struct PathSettings {
    /// Scattering events after which a path is cut. Unlimited by default; any limit loses light and so biases.
    int max_bounces = std::numeric_limits<int>::max();
};

/// Where a ray comes from, as far as its weight against light sampling needs it.
struct RayOrigin {
    float pdf = 0;      // of the ray's direction, per solid angle; 0 = no light sample was drawn there (camera, delta)
    Receiver receiver;  // what the light samples were drawn for
};

struct PathResult {
    Rgb radiance;
    float distance = std::numeric_limits<float>::infinity();  // to the first surface that does not let the ray pass
};

class PathTracer {
public:
    /// Keeps references.
    PathTracer(const Scene& scene, const RayScene& ray_scene, const Lights& lights, const PathSettings& settings)
        : scene_(&scene), ray_scene_(&ray_scene), lights_(&lights), settings_(settings) {}

    /// bounce: scattering events before this ray; it selects the random numbers and counts towards max_bounces.
    PathResult trace(Ray ray, RayOrigin origin, const Sampler& sampler, int bounce, Counters& counters) const;

    /// Share of a light sample that arrives at a point: 0 or 1.
    bool is_visible(Vec3 from, const LightSample& light, OpacityTest opacity, Counters& counters) const;

    const Lights& lights() const { return *lights_; }
    const RayScene& ray_scene() const { return *ray_scene_; }

private:
    Rgb sample_lights(const Surface& surface, const PreparedBsdf& bsdf, const ShadingBasis& basis,
                      const Sampler& sampler, const VertexNumbers& u, int bounce, Counters& counters) const;
    Rgb weigh(const LightSample& light, const Surface& surface, const PreparedBsdf& bsdf, const ShadingBasis& basis,
              OpacityTest opacity, Counters& counters) const;

    const Scene* scene_;
    const RayScene* ray_scene_;
    const Lights* lights_;
    PathSettings settings_;
};

}  // namespace pluvia
