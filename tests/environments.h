// Environments that the tests of looking up and of sampling share.
#pragma once

#include "renderer/core/random.h"
#include "renderer/core/units.h"
#include "shaders/environment.h"

namespace pluvia {

/// Every texel different, with steps, zeros and a dark row.
inline Image<Rgb> rough_picture(int width, int height) {
    Image<Rgb> picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float value = unit_float(hash_key(7, x, y));
            if (y != height / 3) picture.at(x, y) = {value < 0.5f ? 0 : value * value * 1000, value, 3 * value};
        }
    return picture;
}

inline Disc small_sun() {
    Disc sun;
    sun.direction = Vec3(direction_from_azimuth(radians_from_degrees(130), radians_from_degrees(35)));
    sun.strips = {{9e6f, 8e6f, 6e6f}};
    return sun;
}

/// A sample from random numbers of its own.
inline EnvironmentSample draw(const Environment& environment, uint64_t seed, uint64_t index) {
    const uint64_t key = hash_key(seed, index);
    return environment.sample({unit_float(mix_bits(key + 1)), unit_float(mix_bits(key + 2))},
                              unit_float(mix_bits(key + 3)));
}

}  // namespace pluvia
