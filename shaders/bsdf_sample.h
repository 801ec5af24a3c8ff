// What evaluating and sampling a BSDF give back, and the conventions that all of them share. Read next: bsdf.h.
// Everything is in the shading frame: +z is the shading normal on the side of the viewer; wo (towards the viewer) and
// wi (towards the light) are unit vectors that leave the surface. Turning the frame for surfaces seen from behind is
// the caller's work: a direction wo with z <= 0 sees black.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/vec.h"

namespace pluvia {

/// A BSDF for one pair of directions. All zero where there is no scattering and for delta lobes.
struct BsdfValue {
    Rgb f_cos;      // bsdf times |cos theta_i|, 1/sr
    float pdf = 0;  // with which sample() would choose wi, per solid angle, 1/sr
};

/// A direction drawn by a BSDF.
struct BsdfSample {
    Vec3 wi;
    Rgb weight;                // f |cos theta_i| / pdf; for a delta lobe its reflectance over the chance of choosing it
    float pdf = 0;             // 1/sr; 0 where delta
    bool delta = false;        // one of finitely many directions: no light can be sampled for it
    bool transmitted = false;  // wi is on the other side of the surface than wo
};

}  // namespace pluvia
