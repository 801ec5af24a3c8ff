// View: what a camera sees during one exposure, as plain geometry. Rain needs no more than this of a camera.
// Axes: the camera looks along -z of its own frame, +y is up, +x right (as in glTF). Pixels: x to the right, y down,
// (0, 0) is the upper left corner of the upper left pixel.
#pragma once

#include "renderer/core/ray.h"
#include "renderer/core/transform.h"

namespace pluvia {

struct View {
    int width = 1024, height = 512;                             // pixels
    double focal_pixels = 1000;                                 // image-plane distance in pixels, the same in x and y
    Vec2 centre_offset;                                         // pixels from the middle of the picture to where the
                                                                // axis meets it; calibrated cameras have one
    Vec3d position;                                             // world, metres
    Vec3d right = {1, 0, 0}, up = {0, 1, 0}, back = {0, 0, 1};  // camera axes in the world, orthonormal
    Vec3d velocity;                                             // of the camera, m/s
    Vec3d angular_velocity;                                     // of its turning, rad/s about this axis of the world
    double lens_radius = 0;                                     // metres; 0 = pinhole
    double focus_distance = 10;                                 // view depth in focus, metres; unused by a pinhole
    double shutter_open = 0;                                    // seconds of the sequence
    double exposure_time = 1.0 / 60;                            // seconds

    /// Where the axis meets the picture, in pixels.
    Vec2 centre() const { return {0.5f * float(width) + centre_offset.x, 0.5f * float(height) + centre_offset.y}; }
    /// Camera coordinates of a point of the world: x right, y up, z = view depth (positive in front of the camera).
    Vec3d view_from_world(Vec3d p) const {
        const Vec3d d = p - position;
        return {dot(d, right), dot(d, up), -dot(d, back)};
    }
    Vec3d world_vector_from_view(Vec3d v) const { return right * v.x + up * v.y - back * v.z; }

    /// Pixel position of a point with view coordinates v, seen through the centre of the lens; v.z > 0.
    Vec2 pixel_from_view(Vec3 v) const {
        const float s = float(focal_pixels) / v.z;
        const Vec2 c = centre();
        return {c.x + v.x * s, c.y - v.y * s};
    }
    /// Direction in view coordinates, scaled to depth 1, through the centre of the lens.
    Vec3 view_direction(Vec2 pixel) const {
        const float s = 1 / float(focal_pixels);
        const Vec2 c = centre();
        return {(pixel.x - c.x) * s, (c.y - pixel.y) * s, 1};
    }
    /// Radius in pixels of the disk into which a point at this view depth is blurred.
    double blur_radius_pixels(double depth) const {
        return lens_radius * focal_pixels * std::abs(1 / depth - 1 / focus_distance);
    }
};

}  // namespace pluvia
