#include "tests/statistics.h"

#include "renderer/core/sampling.h"
#include "renderer/core/transform.h"

#include <doctest/doctest.h>

#include <vector>

using namespace pluvia;

TEST_CASE("p-values of the chi-square distribution equal the printed tables") {
    // Abramowitz and Stegun 1964, table 26.8: critical values at 5 % and 0.1 %, given to six digits, which leaves
    // 1.3e-5 of the second.
    CHECK(chi_square_p_value(3.84146, 1) == doctest::Approx(0.05).epsilon(1e-5).scale(0));
    CHECK(chi_square_p_value(18.3070, 10) == doctest::Approx(0.05).epsilon(2e-5).scale(0));
    CHECK(chi_square_p_value(124.342, 100) == doctest::Approx(0.05).epsilon(1e-4).scale(0));
    CHECK(chi_square_p_value(29.588, 10) == doctest::Approx(0.001).epsilon(1e-3).scale(0));
    CHECK(chi_square_p_value(149.449, 100) == doctest::Approx(0.001).epsilon(1e-3).scale(0));
    // Below the mean the power series is used.
    CHECK(chi_square_p_value(3.94030, 10) == doctest::Approx(0.95).epsilon(1e-5));
}

TEST_CASE("p-values are exact where the distribution has a closed form") {
    for (const double x : {0.1, 1.0, 5.0, 30.0, 100.0}) {
        CAPTURE(x);
        CHECK(chi_square_p_value(x, 2) == doctest::Approx(std::exp(-x / 2)).epsilon(1e-12).scale(0));
        CHECK(chi_square_p_value(x, 1) == doctest::Approx(std::erfc(std::sqrt(x / 2))).epsilon(1e-12).scale(0));
        CHECK(chi_square_p_value(x, 4) == doctest::Approx(std::exp(-x / 2) * (1 + x / 2)).epsilon(1e-12).scale(0));
    }
    CHECK(chi_square_p_value(25, 1) / 2 == doctest::Approx(five_sigma_p_value).epsilon(1e-4).scale(0));
    CHECK(chi_square_p_value(0, 7) == 1.0);
}

TEST_CASE("a running mean keeps small variations on a large offset") {
    RunningMean mean;
    for (int i = 0; i < 1000; ++i) mean.add(1e9 + (i % 2 ? 1 : -1));
    CHECK(mean.count() == 1000);
    CHECK(mean.mean() == doctest::Approx(1e9).epsilon(1e-15));
    CHECK(mean.variance() == doctest::Approx(1000.0 / 999).epsilon(1e-9).scale(0));
    CHECK(mean.standard_error() == doctest::Approx(std::sqrt(1.0 / 999)).epsilon(1e-9).scale(0));
    CHECK(mean.agrees_with(1e9 + 4.9 * mean.standard_error()));
    CHECK_FALSE(mean.agrees_with(1e9 + 5.1 * mean.standard_error()));
    CHECK(mean.at_most(1e9 - 4.9 * mean.standard_error()));
    CHECK_FALSE(mean.at_most(1e9 - 5.1 * mean.standard_error()));
}

TEST_CASE("p-values of right expectations are uniform") {
    // 400 throws of 3000 dice; the p-values themselves are then tested in ten cells.
    std::vector<double> cells(10, 0.0), expected(10, 40.0);
    for (uint64_t trial = 0; trial < 400; ++trial) {
        std::vector<double> faces(6, 0.0);
        for (uint64_t i = 0; i < 3000; ++i) faces[size_t(6 * uniform(1, trial, i))] += 1;
        const ChiSquare result = chi_square_test(faces, std::vector<double>(6, 500.0));
        REQUIRE(result.degrees_of_freedom == 5);
        cells[std::min<size_t>(9, size_t(10 * result.p_value))] += 1;
    }
    CHECK(chi_square_test(cells, expected).p_value > five_sigma_p_value);
}

TEST_CASE("cells that expect less than ten counts are merged") {
    const std::vector<double> observed = {1, 2, 3, 4, 90}, expected = {2, 2, 3, 3, 90};
    const ChiSquare result = chi_square_test(observed, expected);
    CHECK(result.degrees_of_freedom == 1);
    CHECK(result.statistic == doctest::Approx(0));
}

TEST_CASE("directions pass the test against their own pdf and fail it against another") {
    constexpr int count = 1'000'000;
    const auto even = [](Vec3) { return pdf_sphere; };
    // Three percent more light on one side than around.
    const auto lopsided = [](Vec3 w) { return pdf_sphere * (1 + 0.03 * w.y); };
    const auto sphere = [](uint64_t i) { return std::optional(sample_sphere(uniform_2d(2, i, 0))); };
    CHECK(test_directions(sphere, even, count).p_value > five_sigma_p_value);
    CHECK(test_directions(sphere, lopsided, count).p_value < five_sigma_p_value);

    const auto cosine = [](uint64_t i) { return std::optional(sample_cosine_hemisphere(uniform_2d(3, i, 0))); };
    const auto cosine_pdf = [](Vec3 w) { return double(pdf_cosine_hemisphere(w.z)); };
    const auto hemisphere_pdf = [](Vec3 w) { return w.z > 0 ? 1 / (2 * pi) : 0; };
    // An axis that is not the sampler's: cells are cut by the horizon.
    const SphereGrid tilted = {.axis = normalize(Vec3(1, 2, 2))};
    CHECK(test_directions(cosine, cosine_pdf, count, tilted).p_value > five_sigma_p_value);
    CHECK(test_directions(cosine, hemisphere_pdf, count).p_value < five_sigma_p_value);
}

TEST_CASE("a pdf that does not integrate to one fails unless the rest is rejected") {
    constexpr int count = 200'000;
    const auto whole = [](Vec3) { return pdf_sphere; };
    const auto pdf = [](Vec3) { return 0.98 * pdf_sphere; };
    const auto all = [](uint64_t i) { return std::optional(sample_sphere(uniform_2d(4, i, 0))); };
    const auto some = [&](uint64_t i) { return uniform(4, i, 2) < 0.98f ? all(i) : std::nullopt; };
    CHECK(test_directions(all, pdf, count).p_value < five_sigma_p_value);
    CHECK(test_directions(some, pdf, count).p_value > five_sigma_p_value);
    CHECK(test_directions(some, whole, count).p_value < five_sigma_p_value);
}

TEST_CASE("a cone a thousandth of a radian wide is resolved by a grid of a third of its width") {
    constexpr int count = 200'000;
    constexpr float one_minus_cos = 0.5e-6f;
    const Vec3 axis = normalize(Vec3(-3, 1, 0.2f));
    const ShadingBasis basis(axis);
    const auto cone = [&](uint64_t i) {
        return std::optional(basis.to_world(sample_cone(uniform_2d(5, i, 0), one_minus_cos)));
    };
    // Inside is decided by the chord: the cosine of so small an angle has lost half its digits.
    const auto pdf = [&](double limit) {
        return [=](Vec3 w) {
            return length_squared(Vec3d(w) - Vec3d(axis)) < 2 * limit ? double(pdf_cone(float(limit))) : 0.0;
        };
    };
    const SphereGrid grid = {.axis = axis, .width = 3e-4, .rings = 60};
    CHECK(test_directions(cone, pdf(one_minus_cos), count, grid).p_value > five_sigma_p_value);
    CHECK(test_directions(cone, pdf(1.05 * one_minus_cos), count, grid).p_value < five_sigma_p_value);
}
