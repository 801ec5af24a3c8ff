// What a drop shows if all that it sees is infinitely far: light from all around, blurred by the drop's phase function,
// as a table over the camera's directions. Quick and without noise; drop_light.h adds what is near.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/vec.h"
#include "renderer/image/image.h"

#include <functional>

namespace pluvia {

class FarLight {
public:
    /// From a unit direction towards the light, cd/m2. radiance: as the camera sees it; open: if no surface stood
    /// there.
    FarLight(const std::function<Rgb(Vec3)>& radiance, const std::function<Rgb(Vec3)>& open);

    /// Radiance of a drop towards the camera, cd/m2. direction: of the camera's ray, unit. Light of one radiance from
    /// everywhere comes back as it is, to rounding.
    Rgb of_drop(Vec3 direction) const;

    /// What it was made of: means over cells of about 3 degrees.
    Rgb radiance(Vec3 direction) const { return cell(radiance_, direction); }
    Rgb open(Vec3 direction) const { return cell(open_, direction); }

private:
    static Rgb cell(const Image<Rgb>& cells, Vec3 direction);

    Image<Rgb> radiance_, open_, table_;  // equirectangular, as environments are
};

}  // namespace pluvia
