// How far objects reach: boxes in space and in a picture, whether or not something stands in front of them.
#pragma once

#include "renderer/core/view.h"
#include "renderer/scene/label_objects.h"

#include <vector>

namespace pluvia {

/// Pixels: x to the right, y down, (0, 0) the upper left corner of the picture. The right and lower edge are beyond it.
struct PixelBox {
    double left = 1e300, top = 1e300, right = -1e300, bottom = -1e300;

    bool empty() const { return left >= right || top >= bottom; }
    double area() const { return empty() ? 0 : (right - left) * (bottom - top); }
    void add(double x, double y) {
        left = std::min(left, x), top = std::min(top, y);
        right = std::max(right, x), bottom = std::max(bottom, y);
    }
};
PixelBox intersection(const PixelBox& a, const PixelBox& b);

/// A box with the orientation of the object's first node, around all of the object.
struct OrientedBox {
    Vec3d centre;   // in the scene's coordinates
    Vec3d axes[3];  // unit, right-handed; the third is the object's front, as glTF has assets face +z
    Vec3d size;     // metres along the axes
};

struct ObjectExtent {
    OrientedBox box;
    /// Of the projection of all that is in front of the camera; beyond the picture's edges too. Empty where all is
    /// behind.
    PixelBox projected;
    /// Pixels of the picture whose centre shows the object where nothing stands before it.
    int64_t pixels = 0;
};

/// Nearer to the camera than this nothing is projected, metres of view depth.
constexpr double nearest_projected = 0.01;

/// Of every object, in the order of objects.objects.
std::vector<ObjectExtent> object_extents(const Scene& scene, const SceneObjects& objects, const View& view);

}  // namespace pluvia
