// Rays through drops of any shape, against the closed forms of a sphere and what holds for every shape.
#include "renderer/core/sampling.h"
#include "shaders/drop_trace.h"
#include "shaders/raindrop.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <cmath>

namespace pluvia {
namespace {

constexpr double tau = 2 * 3.14159265358979323846;

DropShape spheroid(double axis_ratio) {
    DropShape shape;
    shape.half_width = float(std::pow(axis_ratio, -1.0 / 3));
    shape.half_height = float(std::pow(axis_ratio, 2.0 / 3));
    return shape;
}

/// A point of the drop's silhouette for a level ray along -z.
Vec3 on_disk(uint64_t i, const DropShape& shape) {
    const float r = std::sqrt(uniform(5, i, 0)), phi = float(tau) * uniform(5, i, 1);
    return {r * std::cos(phi) * shape.half_width, r * std::sin(phi) * shape.half_height, 0};
}

}  // namespace

TEST_CASE("a round drop sends light where the closed form of a sphere does, on every path") {
    for (const float b : {0.0f, 0.2f, 0.5f, 0.8f, 0.95f}) {
        CAPTURE(b);
        const DropPaths expected = drop_paths(std::asin(double(b)));
        const DropExits exits = trace_drop(DropShape(), {b, 0, 7}, {0, 0, -1}, 1e-4f);
        for (size_t p = 0; p < 3; ++p) {
            CAPTURE(p);
            REQUIRE(exits.all().size() > p);
            const Vec3 d = exits.all()[p].direction;
            // Turned in the plane of the ray and the centre, towards the axis when refracted, away when reflected.
            const double turn = (p == 0 ? 1 : -1) * expected.turn[p];
            CHECK(d.x == doctest::Approx(std::sin(turn)).epsilon(1e-3).scale(1));
            CHECK(d.z == doctest::Approx(-std::cos(turn)).epsilon(1e-3).scale(1));
            CHECK(exits.all()[p].weight == doctest::Approx(expected.weight[p]).epsilon(2e-3).scale(0));
        }
    }
}

TEST_CASE("a drop of any shape loses no light") {
    int met = 0;
    for (uint64_t i = 0; i < 20000; ++i) {
        const DropShape shape = drop_oscillation(3e-3 * double(uniform(1, i, 0)) + 1e-4, i).at(uniform(1, i, 1));
        const Vec3 direction = sample_sphere(uniform_2d(1, i, 2));
        const Vec3 origin = sample_sphere(uniform_2d(1, i, 4)) * 1.05f;
        double sum = 0;
        const DropExits exits = trace_drop(shape, origin, direction);
        for (const DropExit& exit : exits.all()) {
            CHECK(exit.weight >= 0);
            CHECK(std::abs(length(exit.direction) - 1) < 1e-4f);
            sum += exit.weight;
        }
        if (exits.empty()) continue;
        ++met;
        CAPTURE(i);
        CHECK(std::abs(sum - 1) < 1e-5);
    }
    CHECK(met > 10000);
}

TEST_CASE("oblate drops share light between their paths as an independent ray tracing of spheroids found") {
    struct Row {
        double axis_ratio, reflected, straight, once, asymmetry;
    };
    // Level rays through spheroids, traced with all polarisations in one (14 orders); tolerance: their last digit, and
    // 5 sigma of 40000 rays.
    for (const Row& row : {Row{1.0, .066, .882, .044, .765}, Row{.9, .070, .893, .033, .791},
                           Row{.8, .076, .894, .027, .812}, Row{.7, .084, .889, .026, .830}}) {
        CAPTURE(row.axis_ratio);
        const DropShape shape = spheroid(row.axis_ratio);
        std::array<RunningMean, 3> orders;
        RunningMean asymmetry;
        for (uint64_t i = 0; i < 40000; ++i) {
            const DropExits exits = trace_drop(shape, on_disk(i, shape), {0, 0, -1}, 1e-3f);
            double cosine = 0;
            for (size_t p = 0; p < exits.all().size(); ++p) {
                if (p < 3) orders[p].add(exits.all()[p].weight);
                cosine -= exits.all()[p].weight * exits.all()[p].direction.z;
            }
            asymmetry.add(cosine);
        }
        CHECK(std::abs(orders[0].mean() - row.reflected) < 1e-3 + 5 * orders[0].standard_error());
        CHECK(std::abs(orders[1].mean() - row.straight) < 3e-3 + 5 * orders[1].standard_error());
        CHECK(std::abs(orders[2].mean() - row.once) < 4e-3 + 5 * orders[2].standard_error());
        CHECK(std::abs(asymmetry.mean() - row.asymmetry) < 4e-3 + 5 * asymmetry.standard_error());
    }
}

TEST_CASE("drops are round below half a millimetre, flat above, and oscillate at Rayleigh's frequencies") {
    CHECK(equilibrium_axis_ratio(0.3) == 1);
    CHECK(equilibrium_axis_ratio(2) == doctest::Approx(0.928).epsilon(0.004));
    CHECK(equilibrium_axis_ratio(5) == doctest::Approx(0.706).epsilon(0.004));
    CHECK(oscillation_frequency(2, 1e-3) / tau == doctest::Approx(122).epsilon(0.01));
    CHECK(oscillation_frequency(3, 1e-3) / tau == doctest::Approx(235).epsilon(0.01));
    // A period later the shape is the same.
    const DropOscillation drop = drop_oscillation(1e-3, 9);
    CHECK(drop.at(0.1).a2 == doctest::Approx(drop.at(0.1 + tau / drop.omega2).a2));
    CHECK(drop.at(0.1).a3 == doctest::Approx(drop.at(0.1 + tau / drop.omega3).a3));
}

}  // namespace pluvia
