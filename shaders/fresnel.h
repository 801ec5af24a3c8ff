// Reflection and refraction at a smooth interface. Used by pane.h, microfacet materials and raindrop.cpp.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/vec.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pluvia {

/// Reflectances of the two polarisations, 0 to 1: electric field perpendicular (s) and parallel (p) to the plane of
/// incidence. They stay apart where light meets several interfaces, because their powers do not average.
template <class T>
struct Reflectance {
    T s, p;

    constexpr T mean() const { return (s + p) / 2; }
};

/// Reflectance of a dielectric interface; 1 under total internal reflection.
/// cos_i: cosine of the angle of incidence, 0 to 1; eta: index of the far side over that of the near side, > 0.
/// Source: Born and Wolf 1999, section 1.5.2, equations 21a and 33 to 36.
template <class T>
Reflectance<T> fresnel_dielectric(T cos_i, T eta) {
    const T cos_t_squared = 1 - (1 - cos_i * cos_i) / (eta * eta);
    if (cos_t_squared <= 0) return {1, 1};
    const T cos_t = std::sqrt(cos_t_squared);
    const T s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    const T p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return {s * s, p * p};
}

/// Reflectance of a dielectric interface at normal incidence.
constexpr float normal_reflectance(float eta) {
    const float amplitude = (eta - 1) / (eta + 1);
    return amplitude * amplitude;
}

/// (1 - cos_i)^5: how far Schlick's reflectance has moved from its value at normal incidence (0) to grazing (1).
/// Source: Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", equation 15.
constexpr float schlick_weight(float cos_i) {
    const float m = 1 - cos_i, m2 = m * m;
    return m2 * m2 * m;
}
/// Schlick's reflectance with f0 at normal incidence and f90 at grazing.
constexpr Rgb fresnel_schlick(Rgb f0, float f90, float cos_i) {
    return mix(f0, Rgb(f90), schlick_weight(cos_i));
}

/// Direction in which light that arrives from wo goes on behind the interface; empty under total internal reflection.
/// n: unit normal with dot(n, wo) >= 0; eta: index of the far side over that of the near side.
inline std::optional<Vec3> refract(Vec3 wo, Vec3 n, float eta) {
    const float cos_i = dot(n, wo);
    const float cos_t_squared = 1 - std::max(0.0f, 1 - cos_i * cos_i) / (eta * eta);
    if (cos_t_squared <= 0) return std::nullopt;
    return n * (cos_i / eta - std::sqrt(cos_t_squared)) - wo / eta;
}

}  // namespace pluvia
