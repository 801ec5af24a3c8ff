#include "scenes/noise.h"

#include "renderer/core/random.h"

#include <cmath>

namespace pluvia {
namespace {

int wrapped(int i, int period) {
    return ((i % period) + period) % period;
}

uint64_t cell_key(int x, int y, int period_x, int period_y, uint64_t seed) {
    return mix_bits(seed * 0x9e3779b97f4a7c15ull +
                    ((uint64_t(wrapped(x, period_x)) << 32) | uint64_t(wrapped(y, period_y))));
}

}  // namespace

float noise(Vec2 p, int period_x, int period_y, uint64_t seed) {
    const float fx = std::floor(p.x), fy = std::floor(p.y);
    const int x = int(fx), y = int(fy);
    const float s = smooth_step(0, 1, p.x - fx), t = smooth_step(0, 1, p.y - fy);
    const auto value = [&](int i, int j) { return unit_float(cell_key(x + i, y + j, period_x, period_y, seed)); };
    return (value(0, 0) * (1 - s) + value(1, 0) * s) * (1 - t) + (value(0, 1) * (1 - s) + value(1, 1) * s) * t;
}

float fractal_noise(Vec2 p, int period_x, int period_y, int octaves, uint64_t seed) {
    float sum = 0, total = 0, weight = 1;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * noise(p, period_x, period_y, seed + uint64_t(octave));
        total += weight;
        weight *= 0.5f;
        p = p * 2.0f;
        period_x *= 2, period_y *= 2;
    }
    return sum / total;
}

CellNoise cell_noise(Vec2 p, int period_x, int period_y, uint64_t seed) {
    const int x = int(std::floor(p.x)), y = int(std::floor(p.y));
    CellNoise nearest = {4, 0};
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            const uint64_t key = cell_key(x + i, y + j, period_x, period_y, seed);
            const float dx = float(x + i) + unit_float(mix_bits(key ^ 1)) - p.x;
            const float dy = float(y + j) + unit_float(mix_bits(key ^ 2)) - p.y;
            const float squared = dx * dx + dy * dy;
            if (squared < nearest.distance) nearest = {squared, unit_float(mix_bits(key ^ 3))};
        }
    nearest.distance = std::sqrt(nearest.distance);
    return nearest;
}

}  // namespace pluvia
