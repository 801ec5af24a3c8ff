// RayScene: the bounding volume hierarchy over a Scene, answering which surface a ray meets first and whether anything
// is in between. The Embree door: the version test is at the top of ray_scene.cpp and nowhere else.
#pragma once

#include "renderer/core/counters.h"
#include "renderer/core/ray.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/surface.h"

#include <memory>

namespace pluvia {

/// How partly transparent surfaces treat a ray: each lets it pass with probability 1 - opacity, decided by a hash of
/// key and triangle. The answer is therefore the same whatever the order in which triangles are visited, and unbiased
/// over keys.
struct OpacityTest {
    uint64_t key = 0;
    bool at_half = false;  // instead: pass where opacity < 0.5, for depth and labels
};

/// What stands between two points: nothing, only panes that may let light straight through (surface.h), or more.
enum class Obstruction { none, panes, full };

struct RayHit {
    float distance;
    SurfacePoint point;
};

class RayScene {
public:
    /// Keeps a reference to the scene. Throws Error (render_failed) when Embree has no memory.
    explicit RayScene(const Scene& scene);
    ~RayScene();
    RayScene(RayScene&&) noexcept;

    /// First surface along the ray that does not let it pass; false when there is none before ray.t_max.
    bool closest_hit(const Ray& ray, OpacityTest opacity, RayHit& hit, Counters& counters) const;
    /// Whether something stands between the origin and ray.t_max.
    bool occluded(const Ray& ray, OpacityTest opacity, Counters& counters) const;
    /// The same for light, which panes may let pass.
    Obstruction obstruction(const Ray& ray, OpacityTest opacity, Counters& counters) const;

    const Scene& scene() const { return *scene_; }

private:
    struct Embree;
    const Scene* scene_;
    std::unique_ptr<Embree> embree_;
};

}  // namespace pluvia
