// Tiles, noise and blending of the learning module: what needs no network.
#include "renderer/core/error.h"
#include "tools/learning/blend.h"
#include "tools/learning/noise_field.h"
#include "tools/learning/tiles.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

using namespace pluvia;

TEST_CASE("tiles cover every pixel of a frame beyond their margin, whatever its length") {
    for (const int length : {1, 63, 64, 100, 512, 513, 1024, 2048, 3001})
        for (const int shift : {0, 40}) {
            TileSettings s;
            s.size = 128;
            s.overlap = 48;
            s.shift = shift;
            const TileAxis axis = tile_axis(length, 4, 32, s);
            CAPTURE(length);
            CHECK(axis.size % 32 == 0);
            CHECK(axis.size <= 128);
            CHECK(axis.padded == axis.positions.back() + axis.size);
            std::vector<int> seen(size_t(axis.padded), 0);
            for (size_t i = 0; i < axis.positions.size(); ++i) {
                CHECK(axis.positions[i] % 4 == 0);
                if (i > 0) CHECK(axis.positions[i] - axis.positions[i - 1] <= 128 - 48);
                const auto w = axis.weights(1);
                for (int k = 0; k < axis.size; ++k) seen[size_t(axis.positions[i] + k)] |= w[size_t(k)] > 1e-3f;
            }
            // The outermost pixels have small weights but no competitor.
            for (int x = 2; x + 2 < length; ++x) REQUIRE(seen[size_t(axis.before + x)]);
        }
}

TEST_CASE("weights of a plain grid are one, and it has the published number of tiles") {
    TileSettings s;
    s.plain = true;
    const TilePlan plan = plan_tiles(2048, 1024, 4, 32, s);
    CHECK(plan.count() == 8);
    for (const float w : plan.x.weights(4)) CHECK(w == 1);
    CHECK(plan_tiles(2048, 1024, 4, 32, {}).count() == 15);
}

TEST_CASE("tiles that cannot be are refused") {
    TileSettings s;
    s.size = 500;
    CHECK_THROWS_AS(tile_axis(1000, 4, 32, s), Error);
    s.size = 512;
    s.overlap = 300;
    CHECK_THROWS_AS(tile_axis(1000, 4, 32, s), Error);
}

TEST_CASE("reflection repeats neither end and works any number of times") {
    const int expected[] = {1, 2, 1, 0, 1, 2, 1, 0, 1};
    for (int i = 0; i < 9; ++i) CHECK(reflected(i - 3, 3) == expected[i]);
    CHECK(reflected(-5, 1) == 0);
}

TEST_CASE("noise is normal, and a cell's value does not depend on what is asked beside it") {
    constexpr int n = 512;
    const auto values = noise_field(7, 0, 1, 0, 0, n, n);
    double sum = 0, squares = 0, along = 0;
    for (int i = 0; i < n * n; ++i) {
        sum += values[size_t(i)];
        squares += double(values[size_t(i)]) * values[size_t(i)];
        if (i > 0) along += double(values[size_t(i)]) * values[size_t(i) - 1];
    }
    // Standard errors over 2^18 values: 1/512 of the mean and of neighbours' product, sqrt(2)/512 of the variance.
    CHECK(std::abs(sum / (n * n)) < 5.0 / 512);
    CHECK(std::abs(squares / (n * n) - 1) < 5 * std::sqrt(2.0) / 512);
    CHECK(std::abs(along / (n * n)) < 5.0 / 512);
    const auto part = noise_field(7, 0, 1, 100, 50, 3, 2);
    CHECK(part[4] == values[51 * n + 101]);
    CHECK(noise_field(7, 1, 1, 100, 50, 3, 2) != part);
    CHECK(noise_field(8, 0, 1, 100, 50, 3, 2) != part);
    CHECK(noise_field(7, 0, 1, -3, -2, 1, 1) != noise_field(7, 0, 1, 3, 2, 1, 1));
}

TEST_CASE("coverage is the alpha of a layer, and the red of a mask without") {
    Image<Rgba8> layer(2, 1);
    layer.pixels = {{200, 1, 2, 30}, {0, 0, 0, 0}};
    CHECK(rain_coverage(layer).pixels == std::vector<uint8_t>{30, 0});
    layer.pixels = {{200, 1, 2, 255}, {2, 0, 0, 255}};
    CHECK(rain_coverage(layer).pixels == std::vector<uint8_t>{200, 2});
}

TEST_CASE("a tint of the whole prediction is taken away by the pixels that are known") {
    Image<Rgba8> background(96, 64, Rgba8{100, 120, 140, 255});
    Image<uint8_t> coverage(96, 64);
    Image<Rgb> prediction(96, 64);
    for (size_t i = 0; i < coverage.pixels.size(); ++i) {
        const bool rain = i % 7 < 3;
        coverage.pixels[i] = rain ? 255 : 0;
        prediction.pixels[i] = Rgb(100, 120, 140) * (1 / 255.0f) + Rgb(0.1f, -0.05f, 0) + Rgb(rain ? 0.2f : 0);
    }
    const auto result = blend(prediction, background, coverage, {});
    for (size_t i = 0; i < result.pixels.size(); ++i) {
        const Rgba8 p = result.pixels[i];
        if (coverage.pixels[i] == 0)
            REQUIRE(p == background.pixels[i]);
        else
            REQUIRE(std::max({std::abs(p.r - 151), std::abs(p.g - 171), std::abs(p.b - 191)}) <= 1);  // + 0.2 * 255
    }
    BlendSettings untouched;
    untouched.anchor_colors = false;
    CHECK(blend(prediction, background, coverage, untouched).pixels[0].r > 170);
}

TEST_CASE("rain fades in at the rims, and lighten never darkens") {
    Image<Rgba8> background(4, 1, Rgba8{100, 100, 100, 255});
    Image<uint8_t> coverage(4, 1);
    coverage.pixels = {2, 3, 4, 255};
    const Image<Rgb> bright(4, 1, Rgb(200 / 255.0f)), dark(4, 1, Rgb(0));
    BlendSettings s;
    s.anchor_colors = false;
    const auto soft = blend(bright, background, coverage, s).pixels;
    CHECK(soft[0].r == 100);
    CHECK(soft[1].r == 125);  // 1 of 4 steps
    CHECK(soft[2].r == 150);
    CHECK(soft[3].r == 200);
    s.soft = false;
    CHECK(blend(bright, background, coverage, s).pixels[1].r == 200);
    CHECK(blend(dark, background, coverage, s).pixels[3].r == 0);
    s.lighten = true;
    CHECK(blend(dark, background, coverage, s).pixels[3].r == 100);
}
