// Camera rays: from a position on the picture into the view and into the scene.
#pragma once

#include "renderer/core/ray.h"
#include "renderer/core/view.h"
#include "renderer/scene/scene.h"

namespace pluvia {

/// The camera ray of a lens that is no pinhole, as view_ray.
Ray lens_ray(const View& view, Vec2 pixel, Vec2 lens);
/// One camera ray in view coordinates: through a point of the lens and the point in focus behind a pixel position.
/// lens: uniform in [0, 1)^2; unused by a pinhole.
inline Ray view_ray(const View& view, Vec2 pixel, Vec2 lens) {
    return view.lens_radius > 0 ? lens_ray(view, pixel, lens) : Ray{Vec3(), normalize(view.view_direction(pixel))};
}

/// The scene's box with a margin, where the camera is farther from it than it is wide; else an empty one.
Bounds far_bounds(const Scene& scene, const View& view);

struct SceneRay {
    Ray ray;            // scene coordinates, from the lens
    Ray near;           // the same from where it may meet something
    double before = 0;  // metres between their origins
};

/// far_scene: of far_bounds().
SceneRay scene_ray(const View& view, const Bounds& far_scene, const Ray& ray);

}  // namespace pluvia
