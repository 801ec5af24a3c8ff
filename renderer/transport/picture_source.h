// A picture with its depth as the source of camera segments: what a camera ray meets without rain, for rain on pictures
// that already exist. What lights the drops in front of it is made in picture_scene.h; the other source are the paths
// of path.h.
#pragma once

#include "renderer/core/ray.h"
#include "renderer/image/image.h"
#include "renderer/transport/path.h"

namespace pluvia {

struct PictureSource {
    Image<Rgb> radiance;  // cd/m2, linear Rec.709
    Image<float> z;       // metres along the view axis, above 0; +inf = sky

    /// For any ray through pixel x, y. ray: view coordinates, from a point of the lens.
    PathResult along(int x, int y, const Ray& ray) const { return {radiance.at(x, y), z.at(x, y) / ray.direction.z}; }
};

}  // namespace pluvia
