#include "renderer/transport/camera_ray.h"

#include "renderer/core/sampling.h"

#include <cmath>
#include <limits>

namespace pluvia {
namespace {

/// Metres from the origin to where the ray enters the box; infinite where it does not.
double way_to(const Bounds& box, Vec3d origin, Vec3d direction) {
    double enter = 0, leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (box.lower[axis] - origin[axis]) / direction[axis],
                     b = (box.upper[axis] - origin[axis]) / direction[axis];
        enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

}  // namespace

Ray lens_ray(const View& view, Vec2 pixel, Vec2 lens) {
    const Vec2 d = sample_disk(lens);
    const Vec3 origin(float(view.lens_radius) * d.x, float(view.lens_radius) * d.y, 0);
    // Both ends of the ray scaled by 1 / focus distance, so that focus at infinity is an ordinary case.
    return {origin, normalize(view.view_direction(pixel) - origin / float(view.focus_distance))};
}

Bounds far_bounds(const Scene& scene, const View& view) {
    Bounds box = bounds(scene);
    if (box.empty()) return {};
    const double width = length(box.upper - box.lower);
    const Vec3d outside = max(max(box.lower - view.position, view.position - box.upper), Vec3d());
    if (length(outside) <= width) return {};
    const Vec3d margin(0.01 * width, 0.01 * width, 0.01 * width);
    return {box.lower - margin, box.upper + margin};
}

SceneRay scene_ray(const View& view, const Bounds& far_scene, const Ray& ray) {
    const Vec3d origin = view.position + view.world_vector_from_view(Vec3d(ray.origin)),
                direction = view.world_vector_from_view(Vec3d(ray.direction));
    SceneRay result{{Vec3(origin), Vec3(direction)}, {Vec3(origin), Vec3(direction)}};
    if (far_scene.empty()) return result;
    // In double: seen from 1000 km, a ray in single precision passes 6 cm beside where it should.
    const double way = way_to(far_scene, origin, direction);
    if (std::isinf(way)) return result;
    result.near.origin = Vec3(origin + direction * way), result.before = way;
    return result;
}

}  // namespace pluvia
