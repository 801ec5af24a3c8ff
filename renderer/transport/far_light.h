// What a drop shows if all that it sees is infinitely far: light from all around, blurred by the drop's phase function,
// as a table over the camera's directions. Quick and without noise, for the medium of fine rain in front of pictures.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/vec.h"
#include "renderer/image/image.h"

#include <functional>

namespace pluvia {

class FarLight {
public:
    /// radiance: from a unit direction towards the light, cd/m2.
    explicit FarLight(const std::function<Rgb(Vec3)>& radiance);

    /// Radiance of a drop towards the camera, cd/m2. direction: of the camera's ray, unit. Light of one radiance from
    /// everywhere comes back as it is, to rounding.
    Rgb of_drop(Vec3 direction) const;

private:
    Image<Rgb> table_;  // equirectangular, as environments are
};

}  // namespace pluvia
