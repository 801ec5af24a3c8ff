// Pictures of bricks, dressed stone and the ground of a city.
#include "scenes/noise.h"
#include "scenes/surfaces.h"

#include "renderer/core/random.h"
#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr int bricks_across = 8, courses = 24;  // in 1.8 m

/// One colour per brick between the two, some overburnt, mortar in the joints.
SurfaceMaps brickwork(Rgb light, Rgb dark, Rgb overburnt, Rgb mortar, uint64_t seed) {
    return paint(768, 768, {1.8f, 1.8f}, [=](float x, float y) {
        const float row = std::floor(y * courses);
        const float shifted = x * bricks_across + (int(row) % 2 == 0 ? 0.0f : 0.5f);
        const int column = int(std::floor(shifted)) % bricks_across;
        const uint64_t key = hash_key(seed, uint64_t(row), uint64_t(column));
        const float tone = unit_float(key), hue = unit_float(mix_bits(key)), lift = unit_float(mix_bits(key + 7));
        // Edges of hand-struck bricks wander; the joint is 10 mm of 225 and of 75.
        const float wander = fractal_noise({x * 90, y * 90}, 90, 90, 2, seed + 1) - 0.5f;
        const float across = shifted - std::floor(shifted), up = y * courses - row;
        const float edge_x = std::min(across, 1 - across) * 0.225f, edge_y = std::min(up, 1 - up) * 0.075f;
        const float inside = smooth_step(0.003f, 0.0085f, std::min(edge_x, edge_y) + 0.005f * wander);
        const float grain = fractal_noise({x * 300, y * 300}, 300, 300, 2, seed + 2);
        const float cloud = fractal_noise({x * 4, y * 4}, 4, 4, 5, seed + 3);
        const float chip = smooth_step(0.68f, 0.76f, fractal_noise({x * 42, y * 42}, 42, 42, 3, seed + 4));
        const float soot = smooth_step(0.5f, 0.85f, fractal_noise({x * 14, y * 3}, 14, 3, 4, seed + 5));
        const float salt = smooth_step(0.62f, 0.8f, fractal_noise({x * 7, y * 7}, 7, 7, 5, seed + 6));
        Rgb fired = mix(dark, light, tone);
        if (hue < 0.12f) fired = mix(fired, overburnt, 0.75f);
        fired = fired * (0.72f + 0.42f * grain) * (0.85f + 0.3f * cloud) * (1 - 0.3f * chip);
        fired = mix(fired, mortar * 1.1f, 0.28f * salt);
        Texel t;
        t.albedo = mix(mortar * (0.7f + 0.5f * grain), fired, inside) * (1 - 0.35f * soot);
        t.roughness = 0.78f + 0.15f * grain - 0.12f * inside * (1 - grain);
        t.height = inside * (0.007f + 0.003f * lift) + 0.0022f * grain - 0.004f * chip * inside +
                   inside * (lift - 0.5f) * 0.004f * (2 * across - 1);
        return t;
    });
}

}  // namespace

SurfaceMaps red_brick() {
    return brickwork({0.47f, 0.20f, 0.115f}, {0.29f, 0.105f, 0.065f}, {0.13f, 0.085f, 0.08f}, {0.33f, 0.30f, 0.26f},
                     401);
}

SurfaceMaps pale_brick() {
    return brickwork({0.60f, 0.50f, 0.37f}, {0.40f, 0.31f, 0.22f}, {0.25f, 0.2f, 0.17f}, {0.44f, 0.42f, 0.38f}, 431);
}

SurfaceMaps wall_tiles() {
    return paint(768, 768, {1.2f, 1.2f}, [](float x, float y) {
        constexpr int across = 12, rows = 24;  // tiles of 95 x 45 mm with joints of 5
        const float row = std::floor(y * rows), shifted = x * across + (int(row) % 2 == 0 ? 0.0f : 0.5f);
        const uint64_t key = hash_key(601, uint64_t(row), uint64_t(int(std::floor(shifted)) % across));
        const float tone = unit_float(key), tilt = unit_float(mix_bits(key)) - 0.5f;
        const float u = shifted - std::floor(shifted), v = y * rows - row;
        const float edge = std::min(std::min(u, 1 - u) * 0.1f, std::min(v, 1 - v) * 0.05f);
        const float inside = smooth_step(0.0022f, 0.005f, edge);
        const float speck = fractal_noise({x * 200, y * 200}, 200, 200, 2, 602);
        const float run = smooth_step(0.5f, 0.85f, fractal_noise({x * 20, y * 2}, 20, 2, 4, 603));
        const float cloud = fractal_noise({x * 4, y * 4}, 4, 4, 5, 604);
        Texel t;
        const Rgb glaze = Rgb(0.5f, 0.47f, 0.43f) * ((0.72f + 0.4f * tone) * (0.85f + 0.3f * speck));
        t.albedo = mix(Rgb(0.33f, 0.32f, 0.3f), glaze, inside) * ((1 - 0.4f * run) * (0.8f + 0.35f * cloud));
        t.roughness = mix(Rgb(0.9f), Rgb(0.36f + 0.2f * speck + 0.25f * run), inside).r;
        t.height = 0.0035f * inside + 0.0025f * inside * tilt * (u - 0.5f) + 0.0004f * speck;
        return t;
    });
}

SurfaceMaps sandstone() {
    return paint(768, 768, {2, 2}, [](float x, float y) {
        const float bend = noise({x * 3, y * 3}, 3, 3, 501);
        const float bed = fractal_noise({x * 3, y * 26 + 3 * bend}, 3, 26, 3, 502);
        const float grain = fractal_noise({x * 230, y * 230}, 230, 230, 2, 503);
        const float cloud = fractal_noise({x * 5, y * 5}, 5, 5, 5, 504);
        const float run = smooth_step(0.5f, 0.85f, fractal_noise({x * 26, y * 2}, 26, 2, 4, 505));
        const float pit = smooth_step(0.68f, 0.8f, fractal_noise({x * 70, y * 70}, 70, 70, 2, 506));
        Texel t;
        const float tone = (0.78f + 0.3f * grain) * (0.78f + 0.4f * cloud) * (0.9f + 0.2f * bed) * (1 - 0.28f * run);
        t.albedo = mix(Rgb(0.60f, 0.57f, 0.52f), Rgb(0.47f, 0.45f, 0.43f), 0.6f * run) * (tone * (1 - 0.35f * pit));
        t.roughness = 0.8f + 0.15f * grain;
        t.height = 0.0016f * grain + 0.002f * bed - 0.003f * pit + 0.003f * cloud;
        return t;
    });
}

SurfaceMaps paving_stone() {
    return paint(768, 768, {1.6f, 1.6f}, [](float x, float y) {
        const float sand = fractal_noise({x * 260, y * 260}, 260, 260, 2, 511);
        const float cloud = fractal_noise({x * 4, y * 4}, 4, 4, 6, 512);
        const CellNoise gum = cell_noise({x * 9, y * 9}, 9, 9, 513);
        const float spot = gum.value < 0.3f ? smooth_step(0.16f, 0.1f, gum.distance + 0.02f * sand) : 0.0f;
        const float stain = smooth_step(0.52f, 0.7f, fractal_noise({x * 7, y * 7}, 7, 7, 5, 514));
        const float scratch = smooth_step(0.7f, 0.76f, fractal_noise({x * 24, y * 60}, 24, 60, 2, 515));
        Texel t;
        const float tone = (0.72f + 0.45f * sand) * (0.72f + 0.5f * cloud) * (1 - 0.3f * stain) * (1 - 0.45f * spot);
        t.albedo = mix(Rgb(0.56f, 0.55f, 0.53f), Rgb(0.62f, 0.58f, 0.52f), cloud) * tone;
        t.roughness = 0.62f + 0.25f * sand + 0.1f * stain;
        t.height = 0.0011f * sand + 0.004f * cloud - 0.0008f * scratch + 0.0006f * spot;
        return t;
    });
}

SurfaceMaps asphalt() {
    return paint(768, 768, {2, 2}, [](float x, float y) {
        const CellNoise stone = cell_noise({x * 190, y * 190}, 190, 190, 521);
        const float bare = smooth_step(0.62f, 0.35f, stone.distance);
        const float tar = fractal_noise({x * 300, y * 300}, 300, 300, 2, 522);
        const float cloud = fractal_noise({x * 5, y * 5}, 5, 5, 6, 523);
        const float wander = fractal_noise({x * 4, y * 4}, 4, 4, 6, 524) - 0.5f;
        const float crack =
            bump(wander, 0.0035f) * smooth_step(0.5f, 0.6f, fractal_noise({x * 3, y * 3}, 3, 3, 2, 525));
        const Rgb chip = mix(Rgb(0.11f, 0.108f, 0.104f), Rgb(0.235f, 0.225f, 0.21f), stone.value);
        Texel t;
        t.albedo = mix(Rgb(0.055f, 0.054f, 0.053f) * (0.6f + 0.8f * tar), chip, 0.75f * bare) *
                   ((0.75f + 0.5f * cloud) * (1 - 0.75f * crack));
        t.roughness = 0.68f + 0.2f * tar - 0.12f * bare;
        t.height = 0.0022f * bare + 0.001f * tar - 0.004f * crack + 0.003f * cloud;
        return t;
    });
}

SurfaceMaps bark() {
    return paint(512, 512, {0.5f, 0.5f}, [](float x, float y) {
        const float bend = 1.4f * fractal_noise({x * 5, y * 4}, 5, 4, 3, 531);
        const CellNoise plate = cell_noise({x * 13 + bend, y * 4}, 13, 4, 532);
        const float ridge = smooth_step(0.62f, 0.2f, plate.distance);
        const float fibre = fractal_noise({x * 90, y * 14}, 90, 14, 3, 533);
        const float lichen = smooth_step(0.62f, 0.74f, fractal_noise({x * 9, y * 9}, 9, 9, 4, 534));
        Texel t;
        t.albedo = mix(mix(Rgb(0.05f, 0.042f, 0.036f), Rgb(0.20f, 0.175f, 0.15f), ridge * (0.5f + fibre)),
                       Rgb(0.25f, 0.27f, 0.2f), 0.4f * lichen);
        t.roughness = 0.9f;
        t.height = 0.011f * ridge + 0.004f * fibre;
        return t;
    });
}

SurfaceMaps galvanised() {
    return paint(512, 512, {0.8f, 0.8f}, [](float x, float y) {
        const float bend = 0.7f * noise({x * 20, y * 20}, 20, 20, 541);
        const CellNoise flower = cell_noise({x * 34 + bend, y * 34}, 34, 34, 542);
        const float cloud = fractal_noise({x * 5, y * 5}, 5, 5, 5, 543);
        const float run = smooth_step(0.55f, 0.85f, fractal_noise({x * 30, y * 2}, 30, 2, 4, 544));
        Texel t;
        t.albedo = Rgb(0.56f, 0.575f, 0.59f) * ((0.78f + 0.3f * flower.value) * (1 - 0.35f * run));
        t.metallic = 1 - 0.6f * run;
        t.roughness = 0.3f + 0.14f * flower.value + 0.18f * cloud + 0.25f * run;
        t.height = 0.0012f * cloud;
        return t;
    });
}

}  // namespace pluvia
