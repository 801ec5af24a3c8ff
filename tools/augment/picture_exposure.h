// The exposure of a picture that does not say how it was taken: a guess from what streets have by day and by night.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/image.h"

#include <string>

namespace pluvia {

struct ExposureEstimate {
    double ev100;
    /// What was taken to have a luminance that is known: "sky by day", "surfaces by day", "surfaces by night" or, of a
    /// black picture, "nothing".
    std::string by;
};

/// picture: exposed light, 1 = white. z: metres, +inf = sky. Night is where the sky is below 0.1 and darker
/// than the surfaces or, where less than 1 % of the picture is sky, where the mean is below 0.05. By day the sky has
/// 4000 cd/m2, the mean of clear and overcast ones at 20 degrees of sun, or surfaces 1300 (albedo 0.2 under 20,000
/// lux); by night surfaces have 1 cd/m2, as lit streets are built for (EN 13201, classes M3 to M4). Right to about two
/// stops. A black picture has EV 12.
ExposureEstimate estimate_exposure(const Image<Rgb>& picture, const Image<float>& z);

}  // namespace pluvia
