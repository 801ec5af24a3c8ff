// Random numbers: what a camera sample gets is stratified over its pixel's samples and independent of everything else.
#include "renderer/core/random.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace pluvia;

namespace {

constexpr Draw all_draws[] = {Draw::lobe,      Draw::bsdf,      Draw::light_choice, Draw::light_point, Draw::light_pick,
                              Draw::sun_point, Draw::sky_point, Draw::roulette,     Draw::pixel,       Draw::lens};

/// Sum of products of centred numbers in units of its standard deviation, for numbers that are independent.
double correlation_in_sigma(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - 0.5) * (b[i] - 0.5) * 12;
    return sum / std::sqrt(double(a.size()));
}

}  // namespace

TEST_CASE("the numbers of a vertex are the same asked together or one by one") {
    for (uint32_t sample : {0u, 1u, 77u, 65535u, 4000000000u})
        for (uint32_t bounce : {0u, 1u, 250u}) {
            const Sampler sampler(9, 1023, 511, sample);
            const VertexNumbers together = sampler.vertex(bounce);
            for (uint32_t draw = 0; draw < first_draws; ++draw) {
                CHECK(together.get_2d(Draw(draw)).x == sampler.get_2d(Draw(draw), bounce).x);
                CHECK(together.get_2d(Draw(draw)).y == sampler.get_2d(Draw(draw), bounce).y);
            }
        }
}

TEST_CASE("the numbers of a pixel's samples are the same asked together or one by one") {
    for (const Draw draw : {Draw::pixel, Draw::lens})
        for (const uint32_t first : {0u, 5u, 64u, 4294967290u}) {
            std::array<Vec2, 37> together;
            Sampler(9, 1023, 511, first).get_2d(draw, together);
            for (uint32_t i = 0; i < together.size(); ++i) {
                const Vec2 alone = Sampler(9, 1023, 511, first + i).get_2d(draw);
                CHECK(together[i].x == alone.x);
                CHECK(together[i].y == alone.y);
            }
        }
}

TEST_CASE("every 256 samples in a row fill each cell of every grid of 256 once, in every draw") {
    for (const Draw draw : all_draws)
        for (uint32_t block = 0; block < 3; ++block)
            for (int columns_log2 = 0; columns_log2 <= 8; ++columns_log2) {
                const int columns = 1 << columns_log2, rows = 256 / columns;
                std::set<int> cells;
                for (uint32_t s = 0; s < 256; ++s) {
                    const Vec2 u = Sampler(1, 3, 4, block * 256 + s).get_2d(draw, 2);
                    cells.insert(int(u.y * float(rows)) * columns + int(u.x * float(columns)));
                }
                CHECK(cells.size() == 256);
            }
}

TEST_CASE("first samples of many pixels are uniform") {
    constexpr int pixels = 1 << 17, cells = 256;
    for (const Draw draw : all_draws) {
        std::vector<double> observed(cells, 0), expected(cells, double(pixels) / cells);
        for (uint32_t p = 0; p < pixels; ++p) {
            const Vec2 u = Sampler(5, p % 512, p / 512, 0).get_2d(draw);
            observed[int(u.x * 16) * 16 + int(u.y * 16)] += 1;
        }
        CAPTURE(uint32_t(draw));
        CHECK(chi_square_test(observed, expected).p_value > five_sigma_p_value);
    }
}

TEST_CASE("draws, bounces, samples, pixels and seeds do not know of each other") {
    constexpr int pixels = 1 << 17;
    const auto column = [&](uint64_t seed, uint32_t dx, uint32_t sample, Draw draw, uint32_t bounce, bool second) {
        std::vector<double> values;
        for (uint32_t p = 0; p < pixels; ++p) {
            const Vec2 u = Sampler(seed, p % 512 + dx, p / 512, sample).get_2d(draw, bounce);
            values.push_back(second ? u.y : u.x);
        }
        return values;
    };
    const std::vector<double> reference = column(6, 0, 8, Draw::bsdf, 1, false);
    CHECK(std::abs(correlation_in_sigma(reference, column(6, 0, 8, Draw::bsdf, 1, true))) < 5);
    CHECK(std::abs(correlation_in_sigma(reference, column(6, 0, 8, Draw::bsdf, 2, false))) < 5);
    CHECK(std::abs(correlation_in_sigma(reference, column(6, 1, 8, Draw::bsdf, 1, false))) < 5);
    CHECK(std::abs(correlation_in_sigma(reference, column(7, 0, 8, Draw::bsdf, 1, false))) < 5);
    for (const Draw draw : all_draws) {
        if (draw == Draw::bsdf) continue;
        CAPTURE(uint32_t(draw));
        CHECK(std::abs(correlation_in_sigma(reference, column(6, 0, 8, draw, 1, false))) < 5);
        CHECK(std::abs(correlation_in_sigma(reference, column(6, 0, 8, draw, 1, true))) < 5);
    }
    // Samples of one pixel repel each other within a block, so only blocks are compared.
    CHECK(std::abs(correlation_in_sigma(reference, column(6, 0, 8 + 4096, Draw::bsdf, 1, false))) < 5);
    CHECK(correlation_in_sigma(reference, reference) > 100);
}

TEST_CASE("a mean over the samples of a pixel converges faster than independent samples would") {
    // The integral of a smooth function over a pair; random samples would have a standard error of .28 / 32.
    RunningMean squared_error;
    for (uint32_t pixel = 0; pixel < 200; ++pixel) {
        double sum = 0;
        for (uint32_t s = 0; s < 1024; ++s) {
            const Vec2 u = Sampler(11, pixel, 0, s).get_2d(Draw::sky_point);
            sum += u.x * u.y * 4 - 1;
        }
        squared_error.add(sum / 1024 * (sum / 1024));
    }
    CHECK(std::sqrt(squared_error.mean()) < 0.1 * (std::sqrt(7.0) / 3) / 32);
}

TEST_CASE("keys of different samples, draws and bounces differ") {
    std::set<uint64_t> keys;
    for (uint32_t sample = 0; sample < 64; ++sample)
        for (uint32_t bounce = 0; bounce < 32; ++bounce)
            for (const Draw draw : all_draws) keys.insert(Sampler(3, 5, 6, sample).key(draw, bounce));
    CHECK(keys.size() == 64 * 32 * std::size(all_draws));
}
