#include "renderer/rain/drop_population.h"

#include "renderer/core/random.h"
#include "renderer/core/units.h"
#include "renderer/rain/poisson.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

using namespace pluvia;

namespace {

std::vector<Drop> drops_in(const DropPopulation& population, int size_class, CellIndex cell, double time,
                           double intensity) {
    std::vector<Drop> drops;
    visit_drops(
        population, size_class, cell, time, intensity, [](Vec3d) { return 0.0; },
        [&](const Drop& drop) { drops.push_back(drop); });
    return drops;
}

// All drops of one size class in a box of the world.
std::vector<Drop> drops_in_box(const DropPopulation& population, int size_class, Vec3d lower, Vec3d upper, double time,
                               double intensity) {
    std::vector<Drop> inside;
    const Lattice lattice = lattice_at(population, size_class, time);
    const CellIndex first = lattice.cell_at(lower), last = lattice.cell_at(upper);
    for (int64_t z = first.z; z <= last.z; ++z)
        for (int64_t y = first.y; y <= last.y; ++y)
            for (int64_t x = first.x; x <= last.x; ++x)
                for (const Drop& drop : drops_in(population, size_class, {x, y, z}, time, intensity)) {
                    const Vec3d p = drop.position;
                    if (p.x >= lower.x && p.y >= lower.y && p.z >= lower.z && p.x < upper.x && p.y < upper.y &&
                        p.z < upper.z)
                        inside.push_back(drop);
                }
    return inside;
}

double volume(int size_class) {
    return std::pow(size_classes[size_class].cell_edge, 3);
}

// Counts of Poisson variables of one mean: their sum and their squared deviations are as they should be.
struct PoissonCheck {
    double expected = 0, variance_of_squares = 0, sum = 0, squares = 0;

    void add(double count, double mean) {
        expected += mean;
        variance_of_squares += mean + 2 * mean * mean;  // of (count - mean)^2, from the fourth central moment
        sum += count;
        squares += (count - mean) * (count - mean);
    }
    double mean_sigmas() const { return (sum - expected) / std::sqrt(expected); }
    double variance_sigmas() const { return (squares - expected) / std::sqrt(variance_of_squares); }
};

// The cell that is at this time 500 m high above the world's origin: well within the rain.
CellIndex cell_in_rain(const DropPopulation& population, int size_class, double time, Vec3d aside = {}) {
    return lattice_at(population, size_class, time).cell_at(Vec3d(0, 500, 0) + aside);
}

// A cube of cells of a size class around there, enough of them for some 1e4 to 1e5 drops.
template <class Visit>
void for_each_test_cell(const DropPopulation& population, int size_class, double time, Visit&& visit) {
    const int sides[] = {12, 10, 8, 6, 5, 5};
    const CellIndex at = cell_in_rain(population, size_class, time);
    for (int64_t i = 0; i < sides[size_class]; ++i)
        for (int64_t j = 0; j < sides[size_class]; ++j)
            for (int64_t k = 0; k < sides[size_class]; ++k) visit(CellIndex{at.x + i - 3, at.y + j, at.z + k - 5});
}

}  // namespace

TEST_CASE("Poisson counts have the mean, variance and probabilities of the distribution") {
    for (double mean : {0.01, 0.3, 3.0, 9.9, 10.1, 30.0, 1000.0, 1e5}) {
        CAPTURE(mean);
        PoissonCheck check;
        std::map<int64_t, int> histogram;
        const int samples = 100000;
        for (int i = 0; i < samples; ++i) {
            const int64_t count = sample_poisson(mean, hash_key(11, i));
            check.add(double(count), mean);
            ++histogram[count];
        }
        CHECK(std::abs(check.mean_sigmas()) < 5);
        CHECK(std::abs(check.variance_sigmas()) < 5);
        double statistic = 0;
        int bins = 0;
        for (const auto& [count, number] : histogram) {
            const double log_probability = double(count) * std::log(mean) - mean - std::lgamma(double(count) + 1);
            const double expected = samples * std::exp(log_probability);
            if (expected < 20) continue;
            statistic += (number - expected) * (number - expected) / expected;
            ++bins;
        }
        if (bins > 1) CHECK(chi_square_p_value(statistic, bins) > five_sigma_p_value);
    }
}

TEST_CASE("an event expected once in a thousand million never happens in a thousand tries") {
    int64_t sum = 0;
    for (int i = 0; i < 1000; ++i) sum += sample_poisson(1e-9, hash_key(12, i));
    CHECK(sum == 0);
}

TEST_CASE("counts for one mean and many keys are those for each key alone") {
    for (double mean : {0.01, 3.0, 9.99, 10.0, 30.0}) {
        const PoissonCounts counts(mean);
        for (uint64_t key = 0; key < 20000; ++key) REQUIRE(counts.sample(key) == sample_poisson(mean, key));
    }
}

TEST_CASE("each intensity alone has Poisson counts, Marshall-Palmer diameters and its flux of water") {
    const DropPopulation population{21, {2, 0, -1}, 0};
    for (double time : {0.0, 86400.5}) {
        std::array<std::vector<std::vector<Drop>>, size_classes.size()> cells;
        for (int c = 0; c < int(size_classes.size()); ++c)
            for_each_test_cell(population, c, time,
                               [&](CellIndex cell) { cells[c].push_back(drops_in(population, c, cell, time, 500)); });
        for (double intensity : {0.1, 10.0, 100.0, 500.0}) {
            CAPTURE(time);
            CAPTURE(intensity);
            double flux_deviation = 0, flux_variance = 0;
            for (int c = 0; c < int(size_classes.size()); ++c) {
                CAPTURE(c);
                const auto [d1, d2, edge] = size_classes[c];
                constexpr int bins = 8;
                double counts[bins] = {}, total_volume = 0, flux = 0;
                PoissonCheck check;
                for (const std::vector<Drop>& drops : cells[c]) {
                    int count = 0;
                    for (const Drop& drop : drops) {
                        if (drop.threshold_mm_per_h > intensity) continue;
                        ++count;
                        ++counts[std::min(bins - 1, int((drop.diameter - d1) / (d2 - d1) * bins))];
                        flux += std::numbers::pi / 6 * std::pow(drop.diameter, 3) * fall_speed(drop.diameter);
                    }
                    check.add(count, number_density(intensity, d1, d2) * volume(c));
                    total_volume += volume(c);
                }
                if (check.expected > 20) {
                    CHECK(std::abs(check.mean_sigmas()) < 5);
                    CHECK(std::abs(check.variance_sigmas()) < 5);
                }
                double statistic = 0;
                int used = 0;
                for (int i = 0; i < bins; ++i) {
                    const double lower = d1 + (d2 - d1) * i / bins, upper = d1 + (d2 - d1) * (i + 1) / bins;
                    const double expected = number_density(intensity, lower, upper) * total_volume;
                    if (expected < 20) continue;  // too few for the normal approximation
                    statistic += (counts[i] - expected) * (counts[i] - expected) / expected;
                    ++used;
                }
                if (used > 0) CHECK(chi_square_p_value(statistic, used) > five_sigma_p_value);
                flux_deviation += flux / total_volume - rain_rate(intensity, d1, d2);
                const double weight = std::numbers::pi / 6 * 130;  // of a drop: weight D^3.5
                flux_variance += weight * weight * size_moment(intensity, 7, d1, d2) / total_volume;
            }
            CAPTURE(rain_rate(intensity) / metres_per_second_from_mm_per_h(1));
            CHECK(std::abs(flux_deviation) < 5 * std::sqrt(flux_variance));
        }
    }
}

TEST_CASE("the drops of 10 mm/h are the same whatever else it rains") {
    const DropPopulation population{5, {1, 0, 0}, 0};
    for (double intensity : {0.5, 1.0, 10.0})
        for (double other : {1.0, 8.0, 16.0, 100.0, 1000.0}) {
            if (other < intensity) continue;
            for (int c = 0; c < int(size_classes.size()); ++c) {
                const CellIndex cell = cell_in_rain(population, c, 77.25);
                std::vector<Drop> alone = drops_in(population, c, cell, 77.25, intensity), among;
                for (const Drop& drop : drops_in(population, c, cell, 77.25, other))
                    if (drop.threshold_mm_per_h <= intensity) among.push_back(drop);
                REQUIRE(alone.size() == among.size());
                if (intensity == 10) REQUIRE(!alone.empty());
                for (size_t i = 0; i < alone.size(); ++i) {
                    CHECK(alone[i].key == among[i].key);
                    CHECK(alone[i].position == among[i].position);
                    CHECK(alone[i].diameter == among[i].diameter);
                    CHECK(alone[i].threshold_mm_per_h == among[i].threshold_mm_per_h);
                }
            }
        }
}

TEST_CASE("asking for large drops only gives those and no others") {
    const DropPopulation population{6, {}, 0};
    const CellIndex cell{0, 300, 0};
    std::vector<uint64_t> large, asked;
    for (const Drop& drop : drops_in(population, 3, cell, 0, 100))
        if (drop.diameter >= 1.1e-3) large.push_back(drop.key);
    visit_drops(
        population, 3, cell, 0, 100, [](Vec3d) { return 1.1e-3; },
        [&](const Drop& drop) { asked.push_back(drop.key); });
    CHECK(large.size() > 100);
    CHECK(large == asked);
}

TEST_CASE("a drop is where its fall puts it in the next frame, but for a jump of one cell of under one in a hundred") {
    const double dt = 1.0 / 60;
    for (double time : {0.0, 1000.7, 1e6})
        for (double far : {0.0, 1e6}) {
            const DropPopulation population{31, {3, 0, -2}, 0};
            for (int c = 0; c < int(size_classes.size()); ++c) {
                CAPTURE(time);
                CAPTURE(c);
                const double edge = size_classes[c].cell_edge;
                const CellIndex at = cell_in_rain(population, c, time, {far, 0, -far});
                int drops = 0, jumps = 0;
                double worst = 0;
                for (int64_t i = 0; i < 12; ++i) {
                    const CellIndex cell{at.x + i, at.y, at.z};
                    const auto before = drops_in(population, c, cell, time, 500);
                    const auto after = drops_in(population, c, cell, time + dt, 500);
                    REQUIRE(before.size() == after.size());
                    for (size_t k = 0; k < before.size(); ++k) {
                        if (before[k].key != after[k].key) FAIL("another drop");
                        const double step = (time + dt) - time;  // dt as far as double resolves it
                        Vec3d off = after[k].position - before[k].position -
                                    drop_velocity(population, before[k].diameter) * step;
                        if (std::abs(off.y) > edge / 2) {
                            off.y -= std::copysign(edge, off.y);
                            ++jumps;
                        }
                        worst = std::max(worst, length(off));
                        ++drops;
                    }
                }
                CAPTURE(drops);
                CAPTURE(jumps);
                // The lattice has moved up to 1e7 m, where double resolves 2e-9; the least drop's radius is 5e-5.
                CHECK(worst < 2e-8);
                // Expected at most 0.6 %: the mean of |v - middle| dt / edge.
                CHECK(jumps < 0.008 * drops + 5 * std::sqrt(0.008 * drops));
            }
        }
}

TEST_CASE("drops are uniform in space, without seams between cells, after any time") {
    const DropPopulation population{41, {1.3, 0, 0.4}, 0};
    for (double time : {0.0, 12345.678}) {
        for (int c : {2, 3, 4}) {
            CAPTURE(time);
            CAPTURE(c);
            constexpr int n = 16;
            const double side = 8.0 / n * (c == 2 ? 0.5 : 1);  // bins do not line up with cells
            const Vec3d lower(0.137, 500.41, -3.3);
            std::vector<int> counts(n * n * n);
            const double box = side * n;
            for (const Drop& drop : drops_in_box(population, c, lower, lower + Vec3d(box, box, box), time, 100)) {
                const Vec3d p = (drop.position - lower) / side;
                ++counts[(std::min(int(p.z), n - 1) * n + std::min(int(p.y), n - 1)) * n + std::min(int(p.x), n - 1)];
            }
            const double mean = number_density(100, size_classes[c].d1, size_classes[c].d2) * side * side * side;
            REQUIRE(mean > 10);
            double statistic = 0;
            for (int count : counts) statistic += (count - mean) * (count - mean) / mean;
            const double p_value = chi_square_p_value(statistic, n * n * n);
            CHECK(p_value > five_sigma_p_value);
            CHECK(p_value < 1 - five_sigma_p_value);  // nor more even than chance
        }
    }
}

TEST_CASE("position within the cell stays uniform, so that counts remain Poisson at all times") {
    const DropPopulation population{43, {}, 0};
    PoissonCheck check;
    const Vec3d lower(10.2, 300.3, 4.4), upper(11.0, 301.1, 5.2);
    const double mean = number_density(100, 0.8e-3, 1.6e-3) * 0.8 * 0.8 * 0.8;
    for (int i = 0; i < 200; ++i)  // far apart in time: another part of the lattice each
        check.add(double(drops_in_box(population, 3, lower, upper, 1000.0 * i, 100).size()), mean);
    CHECK(std::abs(check.mean_sigmas()) < 5);
    CHECK(std::abs(check.variance_sigmas()) < 5);
}

TEST_CASE("there are no drops under the lowest ground nor above the rain") {
    const DropPopulation population{51, {}, 123.4};
    const auto near_ground = drops_in_box(population, 3, {0, 110, 0}, {4, 140, 4}, 9.9, 100);
    const auto near_top = drops_in_box(population, 3, {0, 1110, 0}, {4, 1140, 4}, 9.9, 100);
    REQUIRE(near_ground.size() > 1000);
    REQUIRE(near_top.size() > 1000);
    for (const Drop& drop : near_ground) CHECK(drop.position.y >= 123.4);
    for (const Drop& drop : near_top) CHECK(drop.position.y < 1123.4);
}

TEST_CASE("seeds, cells and size classes share no drops") {
    std::map<uint64_t, int> seen;
    size_t drops = 0;
    for (uint64_t seed : {0, 1})
        for (int c : {3, 4})
            for (int64_t i = -3; i < 3; ++i)
                for (const Drop& drop : drops_in({seed, {}, 0}, c, {i, 200, i + 1}, 0, 100)) {
                    ++seen[drop.key];
                    ++drops;
                }
    CHECK(drops > 10000);
    CHECK(seen.size() == drops);
}
