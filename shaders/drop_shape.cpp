#include "shaders/drop_shape.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double surface_tension = 0.0728;  // N/m, water at 20 C
constexpr double water_density = 998;       // kg/m3

/// |standard normal|, limited; u: uniform in [0, 1). Source: Box and Muller 1958.
double half_normal(uint64_t key, double deviation, double limit) {
    const double u = 1 - unit_double(hash_key(key, 1)), v = unit_double(hash_key(key, 2));
    return std::min(limit, deviation * std::abs(std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v)));
}

}  // namespace

double equilibrium_axis_ratio(double d) {
    return std::min(1.0, 1.0048 + d * (5.7e-4 + d * (-2.628e-2 + d * (3.682e-3 - d * 1.677e-4))));
}

double oscillation_frequency(int n, double radius) {
    return std::sqrt(n * (n - 1) * (n + 2) * surface_tension / (water_density * radius * radius * radius));
}

DropShape DropOscillation::at(double time) const {
    DropShape shape = rest;
    shape.a2 = float(amplitude2 * std::sin(omega2 * time + phase2));
    shape.a3 = float(amplitude3 * std::sin(omega3 * time + phase3));
    return shape;
}

DropOscillation drop_oscillation(double radius, uint64_t key) {
    const auto turn = [&](uint64_t i) { return 2 * std::numbers::pi * unit_double(hash_key(key, i)); };
    const double axis_ratio = equilibrium_axis_ratio(2000 * radius), phi = turn(3);
    DropOscillation drop;
    drop.rest.half_width = float(std::pow(axis_ratio, -1.0 / 3));
    drop.rest.half_height = float(std::pow(axis_ratio, 2.0 / 3));
    drop.rest.cos_phi = float(std::cos(phi));
    drop.rest.sin_phi = float(std::sin(phi));
    drop.amplitude2 = half_normal(hash_key(key, 4), 0.05, 0.15);
    drop.amplitude3 = half_normal(hash_key(key, 5), 0.03, 0.06);
    drop.omega2 = oscillation_frequency(2, radius);
    drop.omega3 = oscillation_frequency(3, radius);
    drop.phase2 = turn(1);
    drop.phase3 = turn(2);
    return drop;
}

}  // namespace pluvia
