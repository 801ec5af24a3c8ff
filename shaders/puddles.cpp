#include "shaders/puddles.h"

#include "renderer/core/random.h"

#include <algorithm>

namespace pluvia {
namespace {

float fade(float t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

float smooth_step(float a, float b, float x) {
    const float t = std::clamp((x - a) / (b - a), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

/// Gradient noise of one octave, within -1 to 1.
float gradient_noise(Vec3d p) {
    const double fx = std::floor(p.x), fy = std::floor(p.y), fz = std::floor(p.z);
    const auto x = int64_t(fx), y = int64_t(fy), z = int64_t(fz);
    const Vec3 d(float(p.x - fx), float(p.y - fy), float(p.z - fz));
    const auto corner = [&](int i, int j, int k) {
        const uint64_t key = hash_key(uint64_t(x + i), y + j, z + k);
        // To the middles of a cube's edges: even enough, and no normalisation.
        const auto part = [&](int shift) { return float(int((key >> shift) & 0xffff) - 0x8000) * 0x1p-15f; };
        return part(0) * (d.x - float(i)) + part(16) * (d.y - float(j)) + part(32) * (d.z - float(k));
    };
    const float s = fade(d.x), t = fade(d.y), u = fade(d.z);
    const auto along_x = [&](int j, int k) {
        const float a = corner(0, j, k);
        return a + s * (corner(1, j, k) - a);
    };
    const auto along_y = [&](int k) {
        const float a = along_x(0, k);
        return a + t * (along_x(1, k) - a);
    };
    const float a = along_y(0);
    return a + u * (along_y(1) - a);
}

}  // namespace

float ground_noise(Vec3d p) {
    const Vec3d shift(0.37, 0.61, 0.19);  // so that octaves do not share their zeros
    return 1.6f * (gradient_noise(p) + 0.5f * gradient_noise(p * 2.3 + shift) + 0.25f * gradient_noise(p * 5.1));
}

Puddle puddle_at(Vec3d world, float share) {
    if (share <= 0) return {};
    if (share >= 1) return {1, 1};
    constexpr double across = 2.6, upwards = 0.7;  // metres: steps and kerbs part puddles
    // The standard deviation of the noise, and the soft border in units of it.
    constexpr float deviation = 0.33f, border = 0.13f;
    const float height = ground_noise({world.x / across, world.y / upwards, world.z / across}) / deviation;
    // Level that leaves the share below it: the noise is about normal, whose quantiles are close to logistic ones.
    const float below = 0.588f * std::log(share / (1 - share)) - height;
    return {smooth_step(-border, border, below), smooth_step(-7 * border, -border, below)};
}

}  // namespace pluvia
