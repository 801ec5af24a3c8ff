// Maps from the unit square, each against its own pdf, and tabulated distributions against their weights.
#include "renderer/core/sampling.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace pluvia;

TEST_CASE("points on the disk are uniform in area") {
    constexpr int count = 400'000, rings = 8, sectors = 16;
    std::vector<double> observed(rings * sectors, 0), expected(rings * sectors, double(count) / (rings * sectors));
    for (int i = 0; i < count; ++i) {
        const Vec2 p = sample_disk(uniform_2d(21, i, 0));
        const double area = double(p.x) * p.x + double(p.y) * p.y;  // share of the disk within
        REQUIRE(area <= 1 + 1e-6);
        const double turn = std::atan2(p.y, p.x) / (2 * pi) + 0.5;
        observed[std::min(int(area * rings), rings - 1) * sectors + std::min(int(turn * sectors), sectors - 1)] += 1;
    }
    CHECK(chi_square_test(observed, expected).p_value > five_sigma_p_value);
}

TEST_CASE("points on a triangle are uniform in area") {
    // Cut into 64 triangles of equal area by lines parallel to its sides.
    constexpr int count = 400'000, n = 8;
    std::vector<double> observed(2 * n * n, 0), expected(2 * n * n, 0);
    for (int i = 0; i < count; ++i) {
        const Vec2 b = sample_triangle(uniform_2d(22, i, 0));
        REQUIRE(b.x >= 0);
        REQUIRE(b.y >= 0);
        REQUIRE(b.x + b.y <= 1 + 1e-6f);
        const int column = std::min(int(b.x * n), n - 1), row = std::min(int(b.y * n), n - 1);
        const bool upper = b.x * n - float(column) + b.y * n - float(row) > 1;
        observed[2 * (row * n + column) + upper] += 1;
    }
    for (int row = 0; row < n; ++row)
        for (int column = 0; column + row < n; ++column) {
            expected[2 * (row * n + column)] = double(count) / (n * n);
            if (column + row < n - 1) expected[2 * (row * n + column) + 1] = double(count) / (n * n);
        }
    CHECK(chi_square_test(observed, expected).p_value > five_sigma_p_value);
}

TEST_CASE("a tabulated distribution returns each cell in proportion to its weight and never one without") {
    // Weights over nine orders of magnitude, with gaps: 24 bits of u cannot reach all of them, chi-square merges those.
    constexpr int count = 1'000'000, cells = 300;
    std::vector<float> weights(cells);
    for (int i = 0; i < cells; ++i) weights[i] = i % 7 == 3 ? 0.0f : std::pow(10.0f, -9 * uniform(23, i, 0));
    const Distribution1D distribution(weights);
    std::vector<double> observed(cells, 0), expected(cells);
    for (int i = 0; i < count; ++i) {
        const auto sample = distribution.sample(uniform(24, i, 0));
        REQUIRE(weights[sample.cell] > 0);
        REQUIRE(sample.offset >= 0);
        REQUIRE(sample.offset < 1);
        observed[sample.cell] += 1;
    }
    double total = 0, probability = 0;
    for (const float w : weights) total += w;
    CHECK(distribution.total() == doctest::Approx(total));
    for (int i = 0; i < cells; ++i) {
        expected[i] = count * (weights[i] / total);
        CHECK(distribution.probability(i) == doctest::Approx(weights[i] / total).epsilon(1e-6).scale(1e-20));
        probability += distribution.probability(i);
    }
    CHECK(probability == doctest::Approx(1));
    CHECK(chi_square_test(observed, expected).p_value > five_sigma_p_value);
}

TEST_CASE("a tabulated distribution is the inverse of its cumulative sum") {
    for (const std::vector<float>& weights :
         {std::vector<float>{1}, {0, 0, 5}, {5, 0, 0}, {0, 1, 0, 0, 3, 0}, {0, 0, 0}, {1e-30f, 1e30f, 1e-30f}}) {
        const Distribution1D distribution(weights);
        double total = 0;
        for (const float w : weights) total += w;
        for (float u : {0.0f, 0x1p-24f, 0.1f, 0.25f, 0.3333333f, 0.5f, 0.75f, 0.9f, 0x1.fffffep-1f}) {
            const auto sample = distribution.sample(u);
            double before = 0;
            for (int i = 0; i < sample.cell; ++i)
                before += total > 0 ? weights[i] / total : 1.0 / double(weights.size());
            const double width = total > 0 ? weights[sample.cell] / total : 1.0 / double(weights.size());
            CAPTURE(u);
            CHECK(before + width * sample.offset == doctest::Approx(u).epsilon(1e-6).scale(1e-20));
        }
    }
}
