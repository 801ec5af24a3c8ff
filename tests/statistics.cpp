#include "tests/statistics.h"

#include "renderer/core/transform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

namespace pluvia {
namespace {

/// Places of a direction in a grid, both from 0 to 1, and back.
struct GridPoint {
    double ring, azimuth;
};

class GridFrame {
public:
    explicit GridFrame(const SphereGrid& grid)
        : basis_(grid.axis), k_(0.25 * grid.width * grid.width), range_(std::log1p(1 / k_)) {}

    GridPoint point(Vec3 direction) const {
        // From the chord, not the cosine: it resolves angles of single-precision directions down to 1e-7.
        const double s = std::min(1.0, 0.25 * length_squared(Vec3d(direction) - Vec3d(basis_.normal)));
        const Vec3 local = basis_.to_local(direction);
        const double turns = std::atan2(local.y, local.x) / (2 * std::numbers::pi);
        return {std::log1p(s / k_) / range_, turns < 0 ? turns + 1 : turns};
    }
    Vec3 direction(GridPoint at) const {
        const double s = half_chord_squared(at.ring), r = 2 * std::sqrt(std::max(0.0, s * (1 - s)));
        const double phi = 2 * std::numbers::pi * at.azimuth;
        return basis_.to_world({float(r * std::cos(phi)), float(r * std::sin(phi)), float(1 - 2 * s)});
    }
    /// Solid angle per unit square of grid coordinates.
    double area(double ring) const { return 4 * std::numbers::pi * range_ * (half_chord_squared(ring) + k_); }

private:
    double half_chord_squared(double ring) const { return k_ * std::expm1(ring * range_); }

    ShadingBasis basis_;
    double k_, range_;
};

struct Cell {
    double ring_min, ring_max, azimuth_min, azimuth_max;
};

class CellIntegrator {
public:
    CellIntegrator(const GridFrame& frame, const std::function<double(Vec3)>& pdf, double count)
        : frame_(frame), pdf_(pdf), count_(count) {}

    double integrate(const Cell& cell) const { return refine(cell, quadrature(cell), 0); }

private:
    /// Gauss and Legendre, three points each way.
    double quadrature(const Cell& c) const {
        static const std::array<double, 3> places = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)};
        static constexpr std::array<double, 3> weights = {5.0 / 18, 8.0 / 18, 5.0 / 18};
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
            const double ring = std::lerp(c.ring_min, c.ring_max, places[i]);
            double row = 0;
            for (int j = 0; j < 3; ++j)
                row += weights[j] * pdf_(frame_.direction({ring, std::lerp(c.azimuth_min, c.azimuth_max, places[j])}));
            sum += weights[i] * row * frame_.area(ring);
        }
        return sum * (c.ring_max - c.ring_min) * (c.azimuth_max - c.azimuth_min);
    }
    /// Halves until the change is a two-hundredth of the count's own deviation, which cannot be seen in the statistic,
    /// but at least three times, so as not to overlook a narrow feature. Ten times narrow an edge of the pdf, such as
    /// the horizon, to 1/1024 of a cell.
    double refine(const Cell& c, double coarse, int depth) const {
        const double ring = 0.5 * (c.ring_min + c.ring_max), azimuth = 0.5 * (c.azimuth_min + c.azimuth_max);
        const std::array<Cell, 4> parts = {{{c.ring_min, ring, c.azimuth_min, azimuth},
                                            {ring, c.ring_max, c.azimuth_min, azimuth},
                                            {c.ring_min, ring, azimuth, c.azimuth_max},
                                            {ring, c.ring_max, azimuth, c.azimuth_max}}};
        std::array<double, 4> fine;
        for (int i = 0; i < 4; ++i) fine[i] = quadrature(parts[i]);
        const double sum = fine[0] + fine[1] + fine[2] + fine[3];
        const double tolerance = 0.005 * std::sqrt(std::max(sum, 1 / count_) / count_);
        if (depth >= 2 && (depth == 9 || std::abs(sum - coarse) < tolerance)) return sum;
        double refined = 0;
        for (int i = 0; i < 4; ++i) refined += refine(parts[i], fine[i], depth + 1);
        return refined;
    }

    const GridFrame& frame_;
    const std::function<double(Vec3)>& pdf_;
    double count_;
};

}  // namespace

/// Power series below the mean, continued fraction (by Lentz's method) above: each converges fast on its side.
/// Source: Abramowitz and Stegun 1964, equations 6.5.29 and 6.5.31.
double regularized_gamma_q(double a, double x) {
    if (x <= 0) return 1;
    constexpr double epsilon = 1e-15;
    const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (double n = a + 1; term > epsilon * sum; ++n) sum += term *= x / n;
        return 1 - scale * sum;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;
    for (int n = 1; n < 100000; ++n) {
        const double numerator = n * (a - n);
        b += 2;
        d = 1 / (b + numerator * d);
        c = b + numerator / c;
        fraction *= c * d;
        if (std::abs(c * d - 1) < epsilon) break;
    }
    return scale * fraction;
}

double chi_square_p_value(double statistic, int degrees_of_freedom) {
    return regularized_gamma_q(0.5 * degrees_of_freedom, 0.5 * statistic);
}

ChiSquare chi_square_test(std::span<const double> observed, std::span<const double> expected) {
    std::vector<size_t> order(expected.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::ranges::stable_sort(order, {}, [&](size_t i) { return expected[i]; });

    ChiSquare result;
    double cell_observed = 0, cell_expected = 0;
    int cells = 0;
    for (const size_t i : order) {
        cell_observed += observed[i];
        cell_expected += expected[i];
        // The last cell has the largest expectation of all and takes whatever is left.
        if (cell_expected < 10 && i != order.back()) continue;
        const double difference = cell_observed - cell_expected;
        result.statistic += difference * difference / cell_expected;
        cell_observed = cell_expected = 0;
        ++cells;
    }
    result.degrees_of_freedom = std::max(1, cells - 1);
    result.p_value = chi_square_p_value(result.statistic, result.degrees_of_freedom);
    return result;
}

ChiSquare test_directions(const std::function<std::optional<Vec3>(uint64_t index)>& sample,
                          const std::function<double(Vec3)>& pdf, int count, const SphereGrid& grid) {
    const GridFrame frame(grid);
    const size_t cells = size_t(grid.rings) * size_t(grid.azimuths);
    std::vector<double> observed(cells + 1, 0.0), expected(cells + 1, 0.0);
    for (int i = 0; i < count; ++i) {
        size_t cell = cells;
        if (const std::optional<Vec3> direction = sample(uint64_t(i))) {
            const GridPoint at = frame.point(*direction);
            const int ring = std::clamp(int(at.ring * grid.rings), 0, grid.rings - 1);
            const int azimuth = std::clamp(int(at.azimuth * grid.azimuths), 0, grid.azimuths - 1);
            cell = size_t(ring * grid.azimuths + azimuth);
        }
        observed[cell] += 1;
    }

    const CellIntegrator integrator(frame, pdf, count);
    double total = 0;
    for (int ring = 0; ring < grid.rings; ++ring) {
        for (int azimuth = 0; azimuth < grid.azimuths; ++azimuth) {
            const Cell cell = {double(ring) / grid.rings, double(ring + 1) / grid.rings,
                               double(azimuth) / grid.azimuths, double(azimuth + 1) / grid.azimuths};
            const double probability = integrator.integrate(cell);
            expected[size_t(ring * grid.azimuths + azimuth)] = count * probability;
            total += probability;
        }
    }
    expected[cells] = std::max(0.0, count * (1 - total));
    return chi_square_test(observed, expected);
}

}  // namespace pluvia
