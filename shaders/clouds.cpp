#include "shaders/clouds.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

double illuminance_ratio(const Clouds& clouds) {
    return 1 - (1 - clouds.transmittance) * std::pow(clouds.cover, 3.4);
}

double disc_ratio(const Clouds& clouds) {
    return illuminance_ratio(clouds) * (1 - clouds.cover * clouds.cover);
}

double overcast_luminance(double sine_of_elevation) {
    return (1 + 2 * sine_of_elevation) / 3;
}

Rgb cloud_color(Rgb light, double sun_elevation) {
    const float y = luminance(light);
    if (!(y > 0)) return Rgb(1);
    constexpr double night = -0.10, day = 0.035;  // -6 and 2 degrees
    const double t = std::clamp((sun_elevation - night) / (day - night), 0.0, 1.0);
    constexpr float whitening = 0.7f;
    return mix(light / y, Rgb(1), whitening * float(t * t * (3 - 2 * t)));
}

}  // namespace pluvia
