#include "shaders/anisotropy.h"

#include <array>
#include <vector>

namespace pluvia {
namespace {

// The table has four dimensions. Widths: `rows` of the one across the direction and `stretches` from there to 1, both
// in even steps of the root. Directions: with A = alpha_along x / z and B = alpha_across y / z, on which masking
// depends, `columns` even in 1 / (1 + sqrt(R)), R = |(A, B)|, from the horizon (0) to the normal (1), and `turns` even
// in the root of the angle of (A, B): nearly all directions of a strongly stretched surface have a small one.
constexpr int rows = 16, stretches = 16, columns = 24, turns = 12;
constexpr int averages = 31;  // likewise, of widths alone
constexpr float min_alpha = min_roughness * min_roughness;

/// What is tabulated: the loss, and the cosine at which Schlick's term equals its mean, divided by the masking root,
/// which varies slowly.
struct Texel {
    float lost, cosine;
};

/// As integrate_texel() of microfacet.cpp, over the whole circle of azimuths: (x, y, z) lies in no plane of symmetry.
Texel integrate_texel(float along, float across, float x, float y, float z) {
    constexpr int azimuths = 32, heights = 48;
    static const auto circle = [] {
        std::array<std::array<float, azimuths>, 2> c;
        for (int i = 0; i < azimuths; ++i) {
            const float phi = 2 * pi * (float(i) + 0.5f) / azimuths;
            c[0][i] = std::cos(phi), c[1][i] = std::sin(phi);
        }
        return c;
    }();
    const float root = std::sqrt(along * along * x * x + across * across * y * y + z * z);
    const float wx = along * x / root, wy = across * y / root, wz = z / root;

    std::array<float, azimuths> lost = {}, grazing = {};  // a sum per azimuth, so that the loop becomes vectors
    float total = 0;
    for (int j = 0; j < heights; ++j) {
        const float t = (float(j) + 0.5f) / heights, weight = t * t * (1 - t) * (1 - t);
        const float rise = t * t * t * (10 - 15 * t + 6 * t * t) * (1 + wz), height = rise - wz;
        const float r = std::sqrt(std::max(0.0f, 1 - height * height));
        total += weight;
        for (int i = 0; i < azimuths; ++i) {
            const float hx = along * (r * circle[0][i] + wx), hy = across * (r * circle[1][i] + wy);
            const float inverse = 1 / (hx * hx + hy * hy + rise * rise);
            const float cosine = x * hx + y * hy + z * rise, twice = 2 * cosine * inverse;
            const float ix = along * (twice * hx - x), iy = across * (twice * hy - y);
            const float iz = std::max(0.0f, twice * rise - z);
            const float masked = z * std::sqrt(ix * ix + iy * iy + iz * iz) + iz * root;
            const float returned = iz * (root + z) / std::max(masked, 1e-30f);  // G2 / G1
            const float m = 1 - cosine * std::sqrt(inverse), m2 = m * m;
            lost[i] += weight * (1 - returned);
            grazing[i] += weight * returned * (m2 * m2 * m);
        }
    }
    float sum_lost = 0, sum_grazing = 0;
    for (int i = 0; i < azimuths; ++i) sum_lost += lost[i], sum_grazing += grazing[i];
    const float all = total * azimuths, returned = std::max(all - sum_lost, 1e-6f * all);
    const float mean_cosine = 1 - std::pow(std::max(0.0f, sum_grazing / returned), 0.2f);
    return {sum_lost / all, mean_cosine / root};
}

/// Widths at a place of the table, both counted from 0 to 1.
struct Widths {
    float along, across;
};
Widths widths_at(float row, float stretch) {
    const float across = min_alpha + (1 - min_alpha) * row * row;
    return {across + (1 - across) * stretch * stretch, across};
}

const std::vector<Texel>& texels() {
    static const auto table = [] {
        std::vector<Texel> t;
        t.reserve(size_t(rows) * stretches * columns * turns);
        for (int row = 0; row < rows; ++row)
            for (int stretch = 0; stretch < stretches; ++stretch) {
                const Widths w = widths_at(float(row) / (rows - 1), float(stretch) / (stretches - 1));
                for (int column = 0; column < columns; ++column)
                    for (int turn = 0; turn < turns; ++turn) {
                        const float c = std::max(float(column) / (columns - 1), 3e-3f);  // at the horizon R is infinite
                        const float radius = (1 / c - 1) * (1 / c - 1), k = float(turn) / (turns - 1);
                        const float x = radius * std::cos(pi / 2 * k * k) / w.along;
                        const float y = radius * std::sin(pi / 2 * k * k) / w.across;
                        const float z = 1 / std::sqrt(1 + x * x + y * y);
                        t.push_back(integrate_texel(w.along, w.across, x * z, y * z, z));
                    }
            }
        return t;
    }();
    return table;
}

/// Index and offset of a place counted from 0 to 1 among `count` entries.
struct Place {
    int index;
    float offset;

    Place(float x, int count) {
        x *= float(count - 1);
        index = std::clamp(int(x), 0, count - 2);  // a NaN stays a value, not an address
        offset = x - float(index);
    }
    float weight(int step) const { return step ? offset : 1 - offset; }
};

/// Loss divided by alpha_along^2, from the interpolated table as in microfacet.cpp.
std::vector<GgxAlbedo> integrate_averages() {
    constexpr int steps = 32, azimuths = 12;
    std::vector<GgxAlbedo> result;
    for (int row = 0; row < averages; ++row)
        for (int stretch = 0; stretch < averages; ++stretch) {
            const Widths w = widths_at(float(row) / (averages - 1), float(stretch) / (averages - 1));
            const float strength = float(stretch) / (averages - 1), range = std::log1p(1 / w.along);
            const AnisotropicGgx ggx(std::sqrt(w.across), {strength, {1, 0}});
            double lost = 0, grazing = 0;
            for (int step = 0; step < steps; ++step) {
                // Even in log(mu + alpha), for the loss lives where mu is about alpha.
                const float mu = w.along * std::expm1(range * (float(step) + 0.5f) / steps);
                const float weight = 2 * mu * (mu + w.along) * range / (steps * azimuths);
                const float sine = std::sqrt((1 - mu) * (1 + mu));
                for (int i = 0; i < azimuths; ++i) {
                    const float phi = pi / 2 * (float(i) + 0.5f) / azimuths;
                    const GgxAlbedo albedo = ggx.albedo({sine * std::cos(phi), sine * std::sin(phi), mu});
                    lost += weight * albedo.lost;
                    grazing += weight * albedo.grazing;
                }
            }
            result.push_back({float(lost / (w.along * w.along)), float(grazing)});
        }
    return result;
}

}  // namespace

AnisotropicGgx::AnisotropicGgx(float roughness, const Anisotropy& anisotropy)
    : alpha_across_(roughness * roughness), direction_(anisotropy.direction), stretch_(anisotropy.strength) {
    alpha_along_ = alpha_across_ + (1 - alpha_across_) * stretch_ * stretch_;
    row_ = std::sqrt(std::max(0.0f, alpha_across_ - min_alpha) / (1 - min_alpha));
}

Vec3 AnisotropicGgx::sample_visible_normal(Vec3 wo, Vec2 u) const {
    // As for the isotropic surface, whose two widths differ here.
    const Vec2 flat = local(wo);
    const Vec3 w = normalize(Vec3(alpha_along_ * flat.x, alpha_across_ * flat.y, wo.z));
    const float phi = 2 * pi * u.x, rise = (1 - u.y) * (1 + w.z), z = rise - w.z;
    const float r = std::sqrt(std::max(0.0f, (1 - z) * (1 + z)));
    const float x = alpha_along_ * (r * std::cos(phi) + w.x), y = alpha_across_ * (r * std::sin(phi) + w.y);
    return normalize(Vec3(direction_.x * x - direction_.y * y, direction_.y * x + direction_.x * y, rise));
}

GgxAlbedo AnisotropicGgx::albedo(Vec3 w) const {
    const Vec2 flat = local(w);
    const float x = std::abs(flat.x), y = std::abs(flat.y), z = std::max(w.z, 1e-7f);
    const float a = alpha_along_ * x, b = alpha_across_ * y, radius = std::sqrt(a * a + b * b) / z;
    const Place row(row_, rows), stretch(stretch_, stretches), column(1 / (1 + std::sqrt(radius)), columns),
        turn(std::sqrt(std::atan2(b, a) * (2 / pi)), turns);
    const Texel* table = texels().data();
    float lost = 0, cosine = 0;
    for (const int i : {0, 1})
        for (const int k : {0, 1}) {
            const Texel* plane =
                table + ((row.index + i) * stretches + stretch.index + k) * (columns * turns) + column.index * turns;
            for (const int m : {0, 1}) {
                const Texel* t = plane + m * turns + turn.index;
                const float weight = row.weight(i) * stretch.weight(k) * column.weight(m);
                lost += weight * (t[0].lost + turn.offset * (t[1].lost - t[0].lost));
                cosine += weight * (t[0].cosine + turn.offset * (t[1].cosine - t[0].cosine));
            }
        }
    cosine = std::min(1.0f, cosine * std::sqrt(a * a + b * b + z * z));
    return {lost, (1 - lost) * schlick_weight(cosine)};
}

GgxAlbedo AnisotropicGgx::average_albedo() const {
    static const std::vector<GgxAlbedo> table = integrate_averages();
    const Place row(row_, averages), stretch(stretch_, averages);
    GgxAlbedo mean{0, 0};
    for (const int i : {0, 1})
        for (const int k : {0, 1}) {
            const GgxAlbedo& entry = table[size_t(row.index + i) * averages + stretch.index + k];
            mean.lost += row.weight(i) * stretch.weight(k) * entry.lost;
            mean.grazing += row.weight(i) * stretch.weight(k) * entry.grazing;
        }
    mean.lost *= alpha_along_ * alpha_along_;
    return mean;
}

}  // namespace pluvia
