#include "shaders/microfacet.h"

#include <array>
#include <numbers>
#include <utility>
#include <vector>

namespace pluvia {
namespace {

constexpr int rows = 32;            // even in perceptual roughness, from the smallest width to alpha = 1
constexpr int average_count = 256;  // likewise

double roughness_of(int index, int count) {
    return min_roughness + (1.0 - min_roughness) * index / (count - 1);
}

/// Integrates over the visible normals of Dupuy and Benyoub 2023, in double because smooth surfaces lose little.
/// Even steps x give the heights x^3 (10 - 15 x + 6 x^2): normals near the cap's rim, few but far from the mean, would
/// be missed by even heights, and a sum of even steps is most exact where the weight fades out at both ends.
GgxAlbedoRow::Texel integrate_texel(double mu, double roughness) {
    constexpr int azimuths = 32, heights = 96;
    static const auto cosines = [] {
        std::array<double, azimuths> c;
        for (int i = 0; i < azimuths; ++i) c[i] = std::cos(std::numbers::pi * (i + 0.5) / azimuths);
        return c;
    }();

    const double alpha = roughness * roughness, alpha_squared = alpha * alpha;
    const auto masking_root = [&](double m) { return std::sqrt(alpha_squared + (1 - alpha_squared) * m * m); };
    const double sine = std::sqrt(std::max(0.0, 1 - mu * mu)), root = masking_root(mu);
    const double length = std::sqrt(alpha_squared * sine * sine + mu * mu);
    const double wx = alpha * sine / length, wz = mu / length;

    double lost = 0, grazing = 0, total = 0;
    for (int j = 0; j < heights; ++j) {
        const double x = (j + 0.5) / heights, weight = x * x * (1 - x) * (1 - x);
        const double rise = x * x * x * (10 - 15 * x + 6 * x * x) * (1 + wz), z = rise - wz;
        const double r2 = std::max(0.0, 1 - z * z), r = std::sqrt(r2);
        for (const double c : cosines) {
            const double hx = alpha * (r * c + wx);
            const double h2 = hx * hx + alpha_squared * r2 * (1 - c * c) + rise * rise, inverse = 1 / std::sqrt(h2);
            const double cos_h = (sine * hx + mu * rise) * inverse;
            const double mu_i = std::max(0.0, 2 * cos_h * rise * inverse - mu);
            const double returned = mu_i * (root + mu) / (mu * masking_root(mu_i) + mu_i * root);  // G2 / G1
            const double m = 1 - cos_h, m2 = m * m;
            lost += weight * (1 - returned);
            grazing += weight * returned * m2 * m2 * m;
            total += weight;
        }
    }
    lost /= total;
    grazing /= total;
    const double sum = (mu + alpha) / alpha, mean_cosine = 1 - std::pow(grazing / (1 - lost), 0.2);
    return {float(lost * sum * sum), float((mean_cosine - mu) / roughness)};
}

const std::vector<GgxAlbedoRow::Texel>& texels() {
    static const auto table = [] {
        std::vector<GgxAlbedoRow::Texel> t;
        for (int row = 0; row < rows; ++row) {
            const double roughness = roughness_of(row, rows), alpha = roughness * roughness;
            for (int column = 0; column < GgxAlbedoRow::columns; ++column) {
                const double x = double(column) / (GgxAlbedoRow::columns - 1), ratio = x * x / (1 + alpha);
                t.push_back(integrate_texel(std::min(1.0, alpha * ratio / (1 - ratio)), roughness));
            }
            // At mu = 1 Schlick's term is nothing, but its fifth root is not: it would bend the last interval.
            t.back().shift = 2 * t[t.size() - 2].shift - t[t.size() - 3].shift;
        }
        return t;
    }();
    return table;
}

/// Loss divided by alpha^2, for even steps of perceptual roughness. Taken from the interpolated table, not from the
/// distribution: only so does a lobe that is divided by its average integrate to what the table says.
std::vector<GgxAlbedo> integrate_averages() {
    constexpr int steps = 256;
    std::vector<GgxAlbedo> averages;
    for (int i = 0; i < average_count; ++i) {
        const double roughness = roughness_of(i, average_count), alpha = roughness * roughness;
        const double range = std::log1p(1 / alpha);
        const GgxAlbedoRow row{float(roughness)};
        double lost = 0, grazing = 0;
        for (int step = 0; step < steps; ++step) {
            // Even in log(mu + alpha), for the loss lives where mu is about alpha.
            const double mu = alpha * std::expm1(range * (step + 0.5) / steps);
            const double weight = 2 * mu * (mu + alpha) * range / steps;
            const GgxAlbedo albedo = row.at(float(mu));
            lost += weight * albedo.lost;
            grazing += weight * albedo.grazing;
        }
        averages.push_back({float(lost / (alpha * alpha)), float(grazing)});
    }
    return averages;
}

/// A place between two of `count` entries: index and offset.
std::pair<int, float> find_entry(float roughness, int count) {
    const float x = (roughness - min_roughness) * (float(count - 1) / (1 - min_roughness));
    const int index = std::clamp(int(x), 0, count - 2);
    return {index, x - float(index)};
}

}  // namespace

GgxAlbedoRow::GgxAlbedoRow(float roughness)
    : roughness_(roughness),
      alpha_(roughness * roughness),
      column_scale_(std::sqrt(1 + alpha_) * float(columns - 1)),
      log_range_(std::log(1 + 1 / alpha_)) {
    const auto [row, offset] = find_entry(roughness, rows);
    lower_ = &texels()[size_t(row) * columns];
    row_offset_ = offset;
}

GgxAlbedo average_ggx_albedo(float roughness) {
    static const std::vector<GgxAlbedo> averages = integrate_averages();
    const auto [index, t] = find_entry(roughness, average_count);
    const GgxAlbedo &a = averages[index], &b = averages[index + 1];
    const float alpha = roughness * roughness;
    return {alpha * alpha * (a.lost + t * (b.lost - a.lost)), a.grazing + t * (b.grazing - a.grazing)};
}

}  // namespace pluvia
