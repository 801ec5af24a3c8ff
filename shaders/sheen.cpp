#include "shaders/sheen.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pluvia {
namespace {

/// The fit of the masking term, section 3 and table 1.
float masking_exponent(float x, float alpha) {
    const float t = (1 - alpha) * (1 - alpha);
    const auto parameter = [&](float rough, float smooth) { return rough + t * (smooth - rough); };
    const float a = parameter(21.5473f, 25.3245f), b = parameter(3.82987f, 3.32435f);
    const float c = parameter(0.19823f, 0.16801f), d = parameter(-1.97760f, -1.27393f);
    const float e = parameter(-4.32054f, -4.85967f);
    return a / (1 + b * std::pow(x, c)) + d * x + e;
}
float masking(float mu, float alpha) {
    return mu < 0.5f ? std::exp(masking_exponent(mu, alpha))
                     : std::exp(2 * masking_exponent(0.5f, alpha) - masking_exponent(1 - std::min(mu, 1.0f), alpha));
}

constexpr int rows = 24, columns = 48;

/// Even in roughness and in the root of the cosine.
using Table = std::vector<float>;

float look_up(const Table& table, float mu, float roughness) {
    const float x = std::sqrt(mu) * (columns - 1);
    const float y = (roughness - min_sheen_roughness) / (1 - min_sheen_roughness) * (rows - 1);
    const int column = std::clamp(int(x), 0, columns - 2), row = std::clamp(int(y), 0, rows - 2);
    const float tx = x - float(column), ty = y - float(row);
    const float* a = &table[size_t(row * columns + column)];
    const float* b = a + columns;
    const float low = a[0] + tx * (a[1] - a[0]), high = b[0] + tx * (b[1] - b[0]);
    return low + ty * (high - low);
}

template <class Reflectance>
Table integrate_albedos(Reflectance reflectance) {
    constexpr int heights = 64, azimuths = 64;
    Table table;
    for (int row = 0; row < rows; ++row) {
        const float roughness = min_sheen_roughness + (1 - min_sheen_roughness) * float(row) / (rows - 1);
        for (int column = 0; column < columns; ++column) {
            const float x = std::max(float(column), 0.1f) / (columns - 1), mu = x * x;
            const Vec3 wo = {std::sqrt(std::max(0.0f, 1 - mu * mu)), 0, mu};
            double sum = 0;
            for (int i = 0; i < heights; ++i) {
                // Squared: the lobe lives near the horizon.
                const float s = (float(i) + 0.5f) / heights, nu = s * s, sine = std::sqrt(1 - nu * nu);
                for (int k = 0; k < azimuths; ++k) {
                    const float phi = pi * (float(k) + 0.5f) / azimuths;
                    sum +=
                        reflectance(roughness * roughness, wo, Vec3(sine * std::cos(phi), sine * std::sin(phi), nu)) *
                        nu * 2 * s;
                }
            }
            table.push_back(float(2 * pi * sum / (heights * azimuths)));
        }
    }
    return table;
}

/// As published. The albedo of smooth cloth near the horizon exceeds 1.
float published_reflectance(float alpha, Vec3 wo, Vec3 wi) {
    const Vec3 h = wo + wi;
    const float sine_squared = std::max(0.0f, (h.x * h.x + h.y * h.y) / length_squared(h));
    const float density = (2 + 1 / alpha) * std::pow(sine_squared, 0.5f / alpha) / (2 * pi);
    return density / ((1 + masking(wo.z, alpha) + masking(wi.z, alpha)) * 4 * wo.z * wi.z);
}

}  // namespace

float sheen_reflectance(float alpha, Vec3 wo, Vec3 wi) {
    static const Table published = integrate_albedos(published_reflectance);
    // Divided by the larger albedo of the two directions where that makes light, which leaves it reciprocal.
    const float roughness = std::sqrt(alpha);
    const float albedo = std::max(look_up(published, std::min(1.0f, wo.z), roughness),
                                  look_up(published, std::min(1.0f, wi.z), roughness));
    return published_reflectance(alpha, wo, wi) / std::max(1.0f, albedo);
}

float sheen_albedo(float mu, float roughness) {
    static const Table table = [] {
        Table t = integrate_albedos(sheen_reflectance);
        for (float& albedo : t) albedo = std::min(1.0f, albedo);
        return t;
    }();
    return look_up(table, mu, roughness);
}

}  // namespace pluvia
