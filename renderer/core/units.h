// Conversions where a value enters from outside, and physical constants with their source. Inside all is SI.
#pragma once

#include <numbers>

namespace pluvia {

constexpr float pi = std::numbers::pi_v<float>;

constexpr double metres_from_mm(double mm) {
    return mm * 1e-3;
}
constexpr double radians_from_degrees(double degrees) {
    return degrees * (std::numbers::pi / 180);
}
constexpr double metres_per_second_from_mm_per_h(double mm_per_h) {
    return mm_per_h * (1e-3 / 3600);
}

constexpr double standard_gravity = 9.80665;  // m/s2, CGPM 1901
constexpr float water_ior = 1.333f;           // at 20 C and 589 nm, Hale and Querry 1973

}  // namespace pluvia
