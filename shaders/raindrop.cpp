#include "shaders/raindrop.h"

#include "renderer/core/sampling.h"
#include "renderer/core/transform.h"
#include "shaders/fresnel.h"

#include <numbers>
#include <vector>

namespace pluvia {
namespace {

constexpr int bins = 720;  // a quarter of a degree each

/// Bin of a turn angle. Source of the arc cosine: Abramowitz and Stegun 1964, equation 4.4.45, error below 7e-5 rad, a
/// sixtieth of a bin. What matters is that it is monotone: the edges of the bins are where this function steps.
int bin_from_cosine(float cos_theta) {
    const float x = std::abs(cos_theta);
    const float polynomial = 1.5707288f + x * (-0.2121144f + x * (0.0742610f + x * -0.0187293f));
    const float angle = std::sqrt(std::max(0.0f, 1 - x)) * polynomial;
    const float theta = cos_theta < 0 ? pi - angle : angle;
    return std::clamp(int(theta * (bins / pi)), 0, bins - 1);
}

struct PhaseTable {
    std::vector<float> edges;    // cosines, from 1 down to -1
    std::vector<float> density;  // 1/sr
    Distribution1D distribution;
    double asymmetry = 0;
};

/// Cosines between which the bins lie, found by halving until two neighbouring floats differ in their bin.
std::vector<float> find_edges() {
    std::vector<float> edges(bins + 1);
    edges[0] = 1;
    for (int bin = 1; bin < bins; ++bin) {
        float inside = -1, before = edges[bin - 1];
        for (float middle; (middle = 0.5f * (inside + before)) != inside && middle != before;)
            (bin_from_cosine(middle) >= bin ? inside : before) = middle;
        edges[bin] = inside;
    }
    edges[bins] = -1;
    return edges;
}

/// Folds an accumulated turn into 0 to pi.
double fold_turn(double turn) {
    return std::abs(std::remainder(turn, 2 * std::numbers::pi));
}

/// Light per bin. The drop's disk is cut into rings even in the angle of incidence, which resolves both the centre,
/// where turns are small, and the rim, where reflectances change fast. Each ring's light is spread evenly over the
/// range of turns between its borders.
std::vector<float> integrate_light() {
    constexpr int rings = 16384;
    constexpr double bins_per_radian = bins / std::numbers::pi, step = std::numbers::pi / 2 / rings;
    std::vector<double> light(bins, 0.0);
    DropPaths inner = drop_paths(0);
    for (int ring = 0; ring < rings; ++ring) {
        const DropPaths middle = drop_paths((ring + 0.5) * step), outer = drop_paths((ring + 1) * step);
        const double area = std::pow(std::sin((ring + 1) * step), 2) - std::pow(std::sin(ring * step), 2);
        for (int order = 0; order < drop_orders; ++order) {
            const double a = fold_turn(inner.turn[order]) * bins_per_radian;
            const double b = fold_turn(outer.turn[order]) * bins_per_radian;
            const double low = std::min(a, b), high = std::max(a, b);
            const double per_bin = area * middle.weight[order] / std::max(high - low, 1e-12);
            for (int bin = std::min(int(low), bins - 1); bin < bins && bin < high; ++bin)
                light[bin] += per_bin * std::max(0.0, std::min(high, bin + 1.0) - std::max(low, double(bin)));
        }
        inner = outer;
    }
    return {light.begin(), light.end()};
}

PhaseTable build_table() {
    PhaseTable table;
    table.edges = find_edges();
    table.distribution = Distribution1D(integrate_light());
    for (int bin = 0; bin < bins; ++bin) {
        const double near = table.edges[bin], far = table.edges[bin + 1], share = table.distribution.probability(bin);
        table.density.push_back(float(share / (2 * std::numbers::pi * (near - far))));
        table.asymmetry += share * 0.5 * (near + far);
    }
    return table;
}

const PhaseTable& phase_table() {
    static const PhaseTable table = build_table();
    return table;
}

}  // namespace

DropPaths drop_paths(double incidence) {
    constexpr double eta = water_ior;
    const double refraction = std::asin(std::sin(incidence) / eta);
    const Reflectance<double> r = fresnel_dielectric(std::cos(incidence), eta);
    DropPaths paths;
    paths.weight[0] = r.mean();
    paths.turn[0] = std::numbers::pi - 2 * incidence;
    double s = (1 - r.s) * (1 - r.s), p = (1 - r.p) * (1 - r.p);
    for (int order = 1; order < drop_orders; ++order) {
        if (order == drop_orders - 1) {  // the geometric series of what is left
            s /= 1 - r.s;
            p /= 1 - r.p;
        }
        paths.weight[order] = (s + p) / 2;
        paths.turn[order] = 2 * (incidence - refraction) + (order - 1) * (std::numbers::pi - 2 * refraction);
        s *= r.s;
        p *= r.p;
    }
    return paths;
}

float drop_phase(float cos_theta) {
    return phase_table().density[bin_from_cosine(cos_theta)];
}

Vec3 sample_drop_phase(Vec3 direction, Vec2 u) {
    const PhaseTable& table = phase_table();
    const Distribution1D::Sample bin = table.distribution.sample(u.x);
    const float near = table.edges[bin.cell], far = table.edges[bin.cell + 1];
    const float cos_theta = near + bin.offset * (far - near);
    const float sin_theta = std::sqrt(std::max(0.0f, (1 - cos_theta) * (1 + cos_theta)));
    const float phi = 2 * pi * u.y;
    return ShadingBasis(direction).to_world({sin_theta * std::cos(phi), sin_theta * std::sin(phi), cos_theta});
}

double drop_asymmetry() {
    return phase_table().asymmetry;
}

}  // namespace pluvia
