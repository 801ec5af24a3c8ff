// Rgb: scene-linear radiance or reflectance with Rec.709 primaries and white point D65.
#pragma once

#include <algorithm>
#include <cmath>

namespace pluvia {

struct Rgb {
    float r = 0, g = 0, b = 0;

    constexpr Rgb() = default;
    constexpr explicit Rgb(float grey) : r(grey), g(grey), b(grey) {}
    constexpr Rgb(float r_, float g_, float b_) : r(r_), g(g_), b(b_) {}

    friend constexpr Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
    friend constexpr Rgb operator-(Rgb a, Rgb b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
    friend constexpr Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
    friend constexpr Rgb operator*(Rgb a, float s) { return {a.r * s, a.g * s, a.b * s}; }
    friend constexpr Rgb operator*(float s, Rgb a) { return a * s; }
    friend constexpr Rgb operator/(Rgb a, float s) { return a * (1 / s); }
    constexpr Rgb& operator+=(Rgb b) { return *this = *this + b; }
    constexpr Rgb& operator*=(Rgb b) { return *this = *this * b; }
    constexpr Rgb& operator*=(float s) { return *this = *this * s; }
    friend constexpr bool operator==(Rgb, Rgb) = default;
};

/// Luminance Y of linear Rec.709 (ITU-R BT.709-6, table 3); in cd/m2 for radiance in the units of this project.
constexpr float luminance(Rgb c) {
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

constexpr float max_component(Rgb c) {
    return std::max(c.r, std::max(c.g, c.b));
}
constexpr bool is_black(Rgb c) {
    return c.r == 0 && c.g == 0 && c.b == 0;
}
inline bool is_finite(Rgb c) {
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

/// a where t = 0, b where t = 1.
constexpr Rgb mix(Rgb a, Rgb b, float t) {
    return a * (1 - t) + b * t;
}

}  // namespace pluvia
