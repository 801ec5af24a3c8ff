#include "tools/learning/noise_field.h"

#include "renderer/core/random.h"

#include <cmath>
#include <numbers>

namespace pluvia {

std::vector<float> noise_field(uint64_t seed, uint32_t step, int channels, int x, int y, int width, int height) {
    std::vector<float> values;
    values.reserve(size_t(channels) * size_t(width) * size_t(height));
    for (int c = 0; c < channels; ++c) {
        const uint64_t key = hash_key(seed, step, uint64_t(c));
        for (int row = y; row < y + height; ++row)
            for (int column = x; column < x + width; ++column) {
                const uint64_t cell = hash_key(key, uint64_t(int64_t(column)), uint64_t(int64_t(row)));
                const double radius = std::sqrt(-2 * std::log(1 - unit_double(mix_bits(cell + 1))));
                values.push_back(float(radius * std::cos(2 * std::numbers::pi * unit_double(mix_bits(cell + 2)))));
            }
    }
    return values;
}

}  // namespace pluvia
