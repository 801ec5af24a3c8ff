// Noise that tiles, for pictures of materials. Pure functions of place and seed.
#pragma once

#include "renderer/core/vec.h"

#include <cmath>

namespace pluvia {

/// Smooth value noise, 0 to 1, mean 0.5; one random value per unit cell. It repeats after period_x and period_y cells.
float noise(Vec2 p, int period_x, int period_y, uint64_t seed);

/// Sum of octaves of noise, each twice as fine and half as strong, scaled back to 0..1.
float fractal_noise(Vec2 p, int period_x, int period_y, int octaves, uint64_t seed);

/// Distance to the nearest of random points, one per unit cell, about 0 to 1, with a random value 0..1 of that point.
/// Source: Worley 1996, "A Cellular Texture Basis Function".
struct CellNoise {
    float distance, value;
};
CellNoise cell_noise(Vec2 p, int period_x, int period_y, uint64_t seed);

/// 0 below a, 1 above b, smooth between; a < b.
constexpr float smooth_step(float a, float b, float x) {
    const float t = x <= a ? 0.0f : x >= b ? 1.0f : (x - a) / (b - a);
    return t * t * (3 - 2 * t);
}

/// 1 at x = 0, falling to 0 at |x| = width.
constexpr float bump(float x, float width) {
    return 1 - smooth_step(0, width, x < 0 ? -x : x);
}

/// bump(x, width) around every whole number: the joints of a pattern of period 1.
inline float joint(float x, float width) {
    const float d = x - std::floor(x);
    return bump(d < 0.5f ? d : 1 - d, width);
}

}  // namespace pluvia
