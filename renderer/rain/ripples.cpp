#include "renderer/rain/ripples.h"

#include "renderer/core/random.h"
#include "renderer/core/units.h"
#include "renderer/rain/drop_size.h"

#include <algorithm>

namespace pluvia {
namespace {

constexpr double surface_tension = 0.0728, water_density = 998.2, viscosity = 1.0e-6;  // N/m, kg/m3, m2/s at 20 C

}  // namespace

// A drop leaves a packet of waves about four times as long as it is wide. They run with the group speed of
// capillary-gravity waves, omega^2 = g k + (sigma / rho) k^3, and are damped as exp(-2 nu k^2 t) by viscosity.
// Source: Lamb 1932, "Hydrodynamics", sections 267 and 348.
Ripples::Kind Ripples::make_kind(double intensity, double d1, double d2, double life) {
    Kind kind;
    const double number = size_moment(intensity, 0.5, d1, d2);
    if (!(number > 0)) return kind;
    const double fall = fall_speed(1);  // of Kessler's law, m/s for a drop of 1 m: speed = fall sqrt(D)
    kind.rate = fall * number;
    kind.life = life;
    const double drop = size_moment(intensity, 1.5, d1, d2) / number, k = 2 * pi / (4 * drop);
    const double tension = surface_tension / water_density,
                 omega = std::sqrt(standard_gravity * k + tension * k * k * k);
    kind.drop = float(drop), kind.wave_number = float(k);
    kind.speed = float((standard_gravity + 3 * tension * k * k) / (2 * omega));
    kind.damping = float(2 * viscosity * k * k);
    kind.reach = kind.speed * float(life) + 8 * kind.drop;
    kind.counts = PoissonCounts(kind.rate * kind.reach * kind.reach * life);
    return kind;
}

Ripples::Ripples(double intensity, uint64_t seed)
    : kinds_{make_kind(intensity, 0.5e-3, 1e-3, 0.12), make_kind(intensity, 1e-3, 2e-3, 0.2),
             make_kind(intensity, 2e-3, largest_drop, 0.4)},
      seed_(seed) {}

double Ripples::rate() const {
    double sum = 0;
    for (const Kind& kind : kinds_) sum += kind.rate;
    return sum;
}

Vec2 Ripples::slope(const Kind& kind, uint64_t key, Vec3d world, double time) const {
    // Rings start in cells of place and time that are as large as they reach and last.
    const double edge = kind.reach;
    const double u = world.x / edge, v = world.z / edge, w = time / kind.life;
    const double column = std::floor(u), row = std::floor(v), slab = std::floor(w);
    const float length_of_packet = 4 * kind.drop;
    Vec2 sum;
    for (int k = -1; k <= 0; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const uint64_t cell = hash_key(key, int64_t(column) + i, int64_t(row) + j, int64_t(slab) + k);
                const int64_t count = kind.counts.sample(cell);
                for (int64_t n = 0; n < count; ++n) {
                    const uint64_t a = mix_bits(cell + uint64_t(n) * 0x9e3779b97f4a7c15ull + 1), b = mix_bits(a);
                    const float age = float((w - slab - k - unit_double(b)) * kind.life);
                    if (age <= 0 || age >= float(kind.life)) continue;
                    const float x = float((u - column - i - double(uint32_t(a)) * 0x1p-32) * edge);
                    const float z = float((v - row - j - double(a >> 32) * 0x1p-32) * edge);
                    const float r = std::sqrt(x * x + z * z), from_crest = r - kind.speed * age;
                    const float e = from_crest / length_of_packet;
                    if (e * e > 4 || r < 1e-4f) continue;
                    // The hollow that the drop leaves is about as deep as a third of it; a ring shares its energy out
                    // along its growing rim. Rings end softly.
                    const float left = 1 - age / float(kind.life), start = 2 * kind.drop;
                    const float height = 0.3f * kind.drop * std::sqrt(start / (start + kind.speed * age)) *
                                         std::exp(-kind.damping * age - e * e) * std::min(1.0f, 3 * left);
                    const float phase = kind.wave_number * from_crest;
                    const float steepness =
                        -height * (kind.wave_number * std::sin(phase) + 2 * e / length_of_packet * std::cos(phase));
                    sum = sum + Vec2{x, z} * (steepness / r);
                }
            }
    return sum;
}

Vec2 Ripples::slope(Vec3d world, double time) const {
    Vec2 sum;
    for (size_t i = 0; i < kinds_.size(); ++i)
        if (kinds_[i].rate > 0) sum = sum + slope(kinds_[i], hash_key(seed_, i), world, time);
    return sum;
}

}  // namespace pluvia
