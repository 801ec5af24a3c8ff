// Pictures of what walls, roofs and paving are made of.
#include "scenes/noise.h"
#include "scenes/surfaces.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
SurfaceMaps wood() {
    return paint(768, 1024, {0.6f, 2.4f}, [](float x, float y) {
        // Growth rings cut lengthwise: a slow warp of u makes flames around knots, thin lines between.
        const float warp = fractal_noise({x * 6, y * 3}, 6, 3, 3, 11);
        const float ring = x * 34 + warp * 9;
        const float phase = ring - std::floor(ring);
        const float late = smooth_step(0.35f, 0.95f, phase) * (1 - smooth_step(0.95f, 1, phase));  // dark late wood
        const float fibre = fractal_noise({x * 220, y * 10}, 220, 10, 3, 12);
        const float blotch = fractal_noise({x * 5, y * 2}, 5, 2, 4, 13);
        const float weather = smooth_step(0.45f, 0.8f, fractal_noise({x * 24, y * 3}, 24, 3, 4, 14));
        const float crack = smooth_step(0.73f, 0.8f, noise({x * 90, y * 5}, 90, 5, 15));
        const float tone = 0.6f + 0.5f * fibre + 0.35f * (blotch - 0.5f) - 0.3f * late - 0.35f * crack;
        Texel t;
        t.albedo = mix(Rgb(0.30f, 0.215f, 0.15f), Rgb(0.33f, 0.28f, 0.23f), weather) * std::clamp(tone, 0.15f, 1.4f);
        t.roughness = 0.5f + 0.2f * fibre + 0.15f * weather;
        t.height = 0.0011f * fibre + 0.0007f * (1 - late) - 0.0018f * crack;
        return t;
    });
}

SurfaceMaps plaster() {
    return paint(512, 512, {2, 2}, [](float x, float y) {
        const float grain = fractal_noise({x * 180, y * 180}, 180, 180, 2, 21);
        const float trowel = fractal_noise({x * 10 + 2 * noise({x * 4, y * 4}, 4, 4, 22), y * 22}, 10, 22, 4, 23);
        const float cloud = fractal_noise({x * 3, y * 3}, 3, 3, 5, 24);
        const float streak = smooth_step(0.52f, 0.85f, fractal_noise({x * 30, y * 2}, 30, 2, 4, 25));
        const float wander = fractal_noise({x * 7, y * 7}, 7, 7, 4, 26) - 0.5f;
        const float crack = bump(wander, 0.004f) * smooth_step(0.55f, 0.65f, cloud);
        Texel t;
        const float tone = 0.92f + 0.16f * (grain - 0.5f) + 0.16f * (cloud - 0.5f) - 0.13f * streak - 0.25f * crack;
        t.albedo = mix(Rgb(0.68f, 0.66f, 0.62f), Rgb(0.52f, 0.49f, 0.44f), 0.5f * streak) * tone;
        t.roughness = 0.9f;
        t.height = 0.0016f * grain + 0.0035f * trowel - 0.002f * crack;
        return t;
    });
}

SurfaceMaps granite() {
    return paint(768, 768, {1.2f, 1.2f}, [](float x, float y) {
        const CellNoise crystal = cell_noise({x * 150, y * 150}, 150, 150, 31);
        const float fine = noise({x * 384, y * 384}, 384, 384, 32);
        const float cloud = fractal_noise({x * 5, y * 5}, 5, 5, 5, 33);
        const float wear = fractal_noise({x * 14, y * 14}, 14, 14, 4, 34);
        const float pit = smooth_step(0.66f, 0.78f, fractal_noise({x * 60, y * 60}, 60, 60, 2, 35));
        const float dark = crystal.value < 0.18f ? 0.55f : crystal.value > 0.85f ? 1.25f : 1.0f;
        Texel t;
        const float tone = dark * (0.75f + 0.3f * fine) * (0.7f + 0.6f * cloud) * (1 - 0.35f * pit);
        t.albedo = mix(Rgb(0.29f, 0.285f, 0.28f), Rgb(0.30f, 0.275f, 0.24f), wear) * tone;
        t.roughness = 0.55f + 0.3f * wear;
        t.height = 0.0009f * fine + 0.006f * wear - 0.0025f * pit + 0.004f * cloud;
        return t;
    });
}

SurfaceMaps clay() {
    return paint(512, 512, {0.8f, 0.8f}, [](float x, float y) {
        const float cloud = fractal_noise({x * 4, y * 4}, 4, 4, 5, 41);
        const float speck = fractal_noise({x * 120, y * 120}, 120, 120, 2, 42);
        const float lichen = smooth_step(0.6f, 0.72f, fractal_noise({x * 18, y * 18}, 18, 18, 4, 43));
        Texel t;
        t.albedo = mix(Rgb(0.07f, 0.075f, 0.085f) * (0.55f + 0.9f * cloud) * (0.8f + 0.4f * speck),
                       Rgb(0.13f, 0.13f, 0.11f), 0.6f * lichen);
        t.roughness = 0.33f + 0.25f * cloud + 0.3f * lichen;
        t.height = 0.0006f * speck + 0.0006f * lichen;
        return t;
    });
}

SurfaceMaps sheet_metal() {
    return paint(512, 512, {1, 1}, [](float x, float y) {
        const float run = fractal_noise({x * 40, y * 3}, 40, 3, 4, 51);
        const float cloud = fractal_noise({x * 6, y * 6}, 6, 6, 5, 52);
        const float rust = smooth_step(0.62f, 0.75f, 0.6f * cloud + 0.4f * run);
        Texel t;
        t.albedo = mix(Rgb(0.55f) * (0.75f + 0.5f * run), Rgb(0.22f, 0.11f, 0.06f), rust);
        t.roughness = 0.38f + 0.2f * run + 0.35f * rust;
        t.height = 0.0012f * cloud + 0.0008f * rust * noise({x * 200, y * 200}, 200, 200, 53);
        return t;
    });
}

SurfaceMaps soil() {
    return paint(256, 256, {0.5f, 0.5f}, [](float x, float y) {
        const float grain = fractal_noise({x * 60, y * 60}, 60, 60, 3, 61);
        const float moss = smooth_step(0.45f, 0.6f, fractal_noise({x * 6, y * 6}, 6, 6, 4, 62));
        Texel t;
        t.albedo = mix(Rgb(0.085f, 0.07f, 0.055f), Rgb(0.05f, 0.075f, 0.025f), moss) * (0.5f + grain);
        t.roughness = 0.95f;
        t.height = 0.008f * grain + 0.004f * moss;
        return t;
    });
}

SurfaceMaps tiled_roof() {
    return paint(512, 512, {1.06f, 0.94f}, [](float x, float y) {
        const float u = x * 4 - std::floor(x * 4), v = y * 4 - std::floor(y * 4);
        const float tile = noise({std::floor(x * 4) + 0.5f, std::floor(y * 4) + 0.5f}, 4, 4, 71);
        const float cloud = fractal_noise({x * 8, y * 8}, 8, 8, 4, 72);
        const float edge = std::max(joint(y * 4, 0.05f), joint(x * 4, 0.04f));
        Texel t;
        t.albedo = Rgb(0.075f, 0.08f, 0.09f) * ((0.5f + 0.5f * tile + 0.5f * cloud) * (1 - 0.6f * edge));
        t.roughness = 0.4f + 0.2f * cloud;
        t.height = 0.02f * std::cos(2 * pi * (u - 0.15f)) + 0.012f * v;
        return t;
    });
}

}  // namespace pluvia
