#include "shaders/bands.h"

#include <algorithm>

namespace pluvia {

const std::array<SpectralBand, band_count> bands = {{
    {0.40375, {998.9, 28.1, 4766.5}, 0.00011},
    {0.43125, {8626.1, 457.1, 42651.3}, 0.00059},
    {0.45875, {10666.0, 2258.4, 60659.7}, 0.00228},
    {0.48625, {2381.2, 6997.7, 23310.9}, 0.00638},
    {0.51375, {1417.2, 20361.2, 4844.7}, 0.01279},
    {0.54125, {10966.8, 33138.5, 763.5}, 0.02390},
    {0.56875, {25414.4, 32622.4, 94.4}, 0.03562},
    {0.59625, {34376.3, 22660.9, 31.1}, 0.03822},
    {0.62375, {24258.2, 10771.6, 4.5}, 0.03072},
    {0.65125, {8368.3, 3192.5, 0.2}, 0.01932},
    {0.67875, {1619.8, 591.4, 0.0}, 0.01108},
    {0.70625, {230.4, 83.2, 0.0}, 0.00592},
}};

Xyz xyz_from_bands(const Bands& transfer) {
    Xyz sum;
    for (int i = 0; i < band_count; ++i) {
        const Xyz& sun = bands[size_t(i)].sun;
        sum.x += sun.x * transfer[i], sum.y += sun.y * transfer[i], sum.z += sun.z * transfer[i];
    }
    return sum;
}

double luminance_from_bands(const Bands& transfer) {
    double y = 0;
    for (int i = 0; i < band_count; ++i) y += bands[size_t(i)].sun.y * transfer[i];
    return y;
}

Rgb rec709_from_xyz(const Xyz& xyz) {
    const auto [x, y, z] = xyz;
    const Rgb c = {float(3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
                   float(-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
                   float(0.0556434 * x - 0.2040259 * y + 1.0572252 * z)};
    const float grey = luminance(c), least = std::min({c.r, c.g, c.b});
    if (least >= 0) return c;
    const Rgb inside = mix(Rgb(grey), c, grey / (grey - least));
    return {std::max(0.0f, inside.r), std::max(0.0f, inside.g), std::max(0.0f, inside.b)};  // rounding
}

Xyz xyz_from_rec709(Rgb c) {
    return {0.4124564 * c.r + 0.3575761 * c.g + 0.1804375 * c.b, 0.2126729 * c.r + 0.7151522 * c.g + 0.0721750 * c.b,
            0.0193339 * c.r + 0.1191920 * c.g + 0.9503041 * c.b};
}

}  // namespace pluvia
