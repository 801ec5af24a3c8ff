#include "shaders/column_table.h"

#include "renderer/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr int steps = 250;

double root(double x) {
    return std::sqrt(std::max(0.0, x));
}

/// r^2 - s^2 without cancellation.
double square_difference(double r, double s) {
    return (r - s) * (r + s);
}

Atmosphere::Amounts integrate(const Atmosphere& atmosphere, double r, double mu, double distance) {
    Atmosphere::Amounts sum;
    for (int i = 0; i < steps; ++i) {
        // Steps grow with the square: the densest air is near the start.
        const double a = distance * i * i / (double(steps) * steps);
        const double b = distance * (i + 1) * (i + 1) / (double(steps) * steps), t = 0.5 * (a + b);
        const double here = std::sqrt(r * r + t * t + 2 * r * mu * t);
        const Atmosphere::Amounts d = atmosphere.density(here - atmosphere.ground_radius);
        sum.air += d.air * (b - a), sum.aerosol += d.aerosol * (b - a), sum.ozone += d.ozone * (b - a);
    }
    return sum;
}

}  // namespace

bool hits_ground(const Atmosphere& atmosphere, double r, double mu) {
    return mu < 0 && r * r * mu * mu >= square_difference(r, atmosphere.ground_radius);
}

double distance_to_ground(const Atmosphere& atmosphere, double r, double mu) {
    return std::max(0.0, -r * mu - root(r * r * mu * mu - square_difference(r, atmosphere.ground_radius)));
}

double distance_to_top(const Atmosphere& atmosphere, double r, double mu) {
    return std::max(0.0, -r * mu + root(r * r * mu * mu + square_difference(atmosphere.top_radius, r)));
}

// Mapping of Bruneton and Neyret 2008: rows by the distance to the horizon,
// columns by the distance to the top between the shortest (straight up) and the
// longest (along the horizon). It is dense where columns change fast.

ColumnTable::ColumnTable(const Atmosphere& atmosphere, std::span<const float> values)
    : ground_(atmosphere.ground_radius),
      top_(atmosphere.top_radius),
      top_distance_(root(square_difference(top_, ground_))),
      values_(values.begin(), values.end()) {}

ColumnTable::ColumnTable(const Atmosphere& atmosphere) : ColumnTable(atmosphere, std::span<const float>()) {
    values_.resize(value_count);
    parallel_for(heights, [&](int y) {
        const double rho = top_distance_ * y / (heights - 1);
        const double r = std::min(top_, std::sqrt(rho * rho + ground_ * ground_));
        const double shortest = top_ - r, longest = rho + top_distance_;
        for (int x = 0; x < directions; ++x) {
            const double d = shortest + (longest - shortest) * x / (directions - 1);
            const double mu = d > 0 ? (square_difference(top_, r) - d * d) / (2 * r * d) : 1;
            const Atmosphere::Amounts a = integrate(atmosphere, r, std::clamp(mu, -1.0, 1.0), d);
            float* cell = &values_[(size_t(y) * directions + size_t(x)) * 3];
            cell[0] = float(a.air), cell[1] = float(a.aerosol), cell[2] = float(a.ozone);
        }
    });
}

Atmosphere::Amounts ColumnTable::to_space(double r, double mu) const {
    const double rho = root(square_difference(r, ground_));
    const double d = std::max(0.0, -r * mu + root(r * r * mu * mu + square_difference(top_, r)));
    const double shortest = top_ - r, longest = rho + top_distance_;
    const double x = std::clamp((d - shortest) / (longest - shortest), 0.0, 1.0) * (directions - 1);
    const double y = std::clamp(rho / top_distance_, 0.0, 1.0) * (heights - 1);
    const int i = std::min(int(x), directions - 2), j = std::min(int(y), heights - 2);
    const double tx = x - i, ty = y - j;
    const float* low = &values_[(size_t(j) * directions + size_t(i)) * 3];
    const float* high = low + directions * 3;
    const auto at = [&](int k) {
        return (low[k] * (1 - tx) + low[k + 3] * tx) * (1 - ty) + (high[k] * (1 - tx) + high[k + 3] * tx) * ty;
    };
    return {at(0), at(1), at(2)};
}

}  // namespace pluvia
