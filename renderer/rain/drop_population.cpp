#include "renderer/rain/drop_population.h"

#include "renderer/core/random.h"
#include "renderer/rain/poisson.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pluvia {
namespace {

constexpr uint64_t rain_domain = 0x7261696e;  // "rain": no other part of the program hashes with it
constexpr std::array<double, 12> band_edges = {0, 1, 2, 4, 8, 16, 32, 64, 128, 256, 512, highest_intensity_mm_per_h};
constexpr int band_count = int(band_edges.size()) - 1;

// The drops of one size class that exist at band_edges[band + 1] but not at band_edges[band]: density
// N0 (exp(-a D) - exp(-b D)) for d1 <= D <= d2.
struct Band {
    double a, b;            // slopes at the upper and the lower edge, 1/m; b is infinite for the first band
    double mean;            // drops in a cell
    double expm1_interval;  // expm1(-a (d2 - d1))
    double expm1_largest;   // expm1(-(b - a) d2)
    double always_kept;     // share of the proposals for the smallest diameter that are kept
};

using BandTable = std::array<std::array<Band, band_count>, size_classes.size()>;

const BandTable& bands() {
    static const BandTable table = [] {
        BandTable result;
        for (size_t c = 0; c < size_classes.size(); ++c) {
            const auto [d1, d2, edge] = size_classes[c];
            for (int k = 0; k < band_count; ++k) {
                const double a = size_slope(band_edges[k + 1]), b = size_slope(band_edges[k]);
                const double density =
                    number_density(band_edges[k + 1], d1, d2) - number_density(band_edges[k], d1, d2);
                const double smallest = std::expm1(-(b - a) * d1), largest = std::expm1(-(b - a) * d2);
                result[c][k] = {
                    a, b, density * edge * edge * edge, std::expm1(-a * (d2 - d1)), largest, smallest / largest};
            }
        }
        return result;
    }();
    return table;
}

// Independent numbers of one drop. Adding multiples of an odd constant before mixing is the generator SplitMix64
// (Steele, Lea and Flood 2014), here started from the drop's key.
double draw(uint64_t drop_key, uint64_t number) {
    return unit_double(mix_bits(drop_key + (number + 1) * 0x9e3779b97f4a7c15ull));
}
enum Number : uint64_t { draw_x, draw_y, draw_z, draw_threshold, draw_diameter };  // the last uses all that follow

// The density is a truncated exponential of slope a times 1 - exp(-(b - a) D). The latter grows less than linearly, so
// that over an octave at least half of the proposals are kept: exact, without a root to find.
double sample_diameter(const SizeClass& size, const Band& band, uint64_t key) {
    for (uint64_t number = draw_diameter;; number += 2) {
        // log(1 + x) is good enough: its error is 1e-16 / a, next to d1.
        const double d = size.d1 - std::log(1 + draw(key, number) * band.expm1_interval) / band.a;
        const double u = draw(key, number + 1);
        if (u < band.always_kept || u * band.expm1_largest >= std::expm1(-(band.b - band.a) * d))
            return std::min(d, size.d2);
    }
}

// Given the diameter, exp(-beta(I) D) is uniform between its values at the edges of the band.
float sample_threshold(int k, const Band& band, double diameter, double u) {
    const double lower = std::exp(-band.b * diameter), upper = std::exp(-band.a * diameter);
    const double beta = -std::log(lower + u * (upper - lower)) / diameter;
    // Rounded inwards: an intensity on the edge must not depend on whether the band above is visited.
    const float above_lower = std::nextafter(float(band_edges[k]), std::numeric_limits<float>::infinity());
    return std::clamp(float(std::pow(beta / 4100, -1 / 0.21)), above_lower, float(band_edges[k + 1]));
}

double middle_speed(const SizeClass& size) {
    return (fall_speed(size.d1) + fall_speed(size.d2)) / 2;
}

}  // namespace

Lattice lattice_at(const DropPopulation& population, int size_class, double time) {
    const SizeClass& size = size_classes[size_class];
    const Vec3d shift = (population.wind - Vec3d(0, middle_speed(size), 0)) * time + population.blown;
    Lattice lattice{size.cell_edge, {}, {}};
    const auto split = [&](double distance, int64_t& whole, double& remainder) {
        const double cells = std::floor(distance / size.cell_edge);
        whole = int64_t(cells);
        remainder = std::fma(-cells, size.cell_edge, distance);  // one rounding only, although the product is large
    };
    split(shift.x, lattice.whole.x, lattice.remainder.x);
    split(shift.y, lattice.whole.y, lattice.remainder.y);
    split(shift.z, lattice.whole.z, lattice.remainder.z);
    return lattice;
}

void visit_drops(const DropPopulation& population, int size_class, CellIndex cell, double time,
                 double max_intensity_mm_per_h, const std::function<double(Vec3d)>& least_diameter,
                 const std::function<void(const Drop&)>& visit) {
    const SizeClass& size = size_classes[size_class];
    const Vec3d corner = lattice_at(population, size_class, time).corner(cell);
    for (int k = 0; k < band_count && band_edges[k] < max_intensity_mm_per_h; ++k) {
        const Band& band = bands()[size_class][k];
        const uint64_t cell_key =
            hash_key(population.seed, rain_domain, size_class, k, uint64_t(cell.x), uint64_t(cell.y), uint64_t(cell.z));
        const int64_t count = sample_poisson(band.mean, cell_key);
        for (int64_t i = 0; i < count; ++i) {
            Drop drop;
            drop.key = hash_key(cell_key, rain_domain, uint64_t(i));
            drop.position = corner + Vec3d(draw(drop.key, draw_x), 0, draw(drop.key, draw_z)) * size.cell_edge;
            const double least = least_diameter(drop.position);
            if (least > size.d2) continue;
            drop.diameter = sample_diameter(size, band, drop.key);
            if (drop.diameter < least) continue;
            const double drift = (fall_speed(drop.diameter) - middle_speed(size)) * time;
            const double height = draw(drop.key, draw_y) * size.cell_edge - drift;
            drop.position.y += height - std::floor(height / size.cell_edge) * size.cell_edge;
            if (drop.position.y < population.lowest_ground || drop.position.y >= population.lowest_ground + rain_height)
                continue;
            drop.threshold_mm_per_h = sample_threshold(k, band, drop.diameter, draw(drop.key, draw_threshold));
            if (drop.threshold_mm_per_h <= max_intensity_mm_per_h) visit(drop);
        }
    }
}

}  // namespace pluvia
