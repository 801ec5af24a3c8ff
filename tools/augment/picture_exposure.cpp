#include "tools/augment/picture_exposure.h"

#include "renderer/image/exposure.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

ExposureEstimate estimate_exposure(const Image<Rgb>& picture, const Image<float>& z) {
    constexpr double day_sky = 4000, day_surfaces = 1300, night_surfaces = 1;  // cd/m2
    double sky = 0, surfaces = 0;
    int64_t sky_count = 0;
    const auto count = int64_t(picture.pixels.size());
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
        const bool is_sky = std::isinf(z.pixels[i]);
        (is_sky ? sky : surfaces) += double(luminance(picture.pixels[i]));
        sky_count += is_sky;
    }
    const double sky_mean = sky_count > 0 ? sky / double(sky_count) : 0;
    const double surface_mean = sky_count < count ? surfaces / double(count - sky_count) : 0;
    const bool has_sky = sky_count * 100 >= count, has_surfaces = surface_mean > 0;
    // White is 1 / exposure_scale(ev): the exposure at which `shown` of white is `known` cd/m2.
    const auto taken_at = [](double known, double shown) {
        return std::log2(known / shown * double(exposure_scale(0)));
    };
    const bool night = has_sky ? sky_mean < std::min(0.1, surface_mean) : surface_mean < 0.05;
    if (night && has_surfaces) return {taken_at(night_surfaces, surface_mean), "surfaces by night"};
    if (has_sky && sky_mean > 0) return {taken_at(day_sky, sky_mean), "sky by day"};
    if (has_surfaces) return {taken_at(day_surfaces, surface_mean), "surfaces by day"};
    return {12, "nothing"};
}

}  // namespace pluvia
