#include "shaders/scattering_table.h"

#include "renderer/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi;
constexpr double above_ground = 1e-3;  // km; a point on the ground would lie below it by rounding
constexpr double last_order = 1e-3;    // part of the sum that an order must add
// The sun's axis is dense at the terminator, where light changes fastest. It ends at -30 degrees: lower suns light
// nothing that can be told from starlight.
constexpr double lowest_mu = -0.5;

double axis_from_mu(double mu_s) {
    return mu_s >= 0 ? std::sqrt(mu_s) : -std::sqrt(std::min(1.0, mu_s / lowest_mu));
}
double mu_from_axis(double x) {
    return x >= 0 ? x * x : lowest_mu * x * x;
}

struct Place {
    int cell;
    float t;
};
/// x from -1 to 1.
Place place_on_axis(double x, int suns) {
    const double position = (x + 1) * 0.5 * (suns - 1);
    const int cell = std::clamp(int(position), 0, suns - 2);
    return {cell, float(position - cell)};
}
double axis_at(int sun, int suns) {
    return 2.0 * sun / (suns - 1) - 1;
}

/// Heights are dense near the ground.
double height_at(int row, int rows, double top) {
    return top * (double(row) / (rows - 1)) * (double(row) / (rows - 1));
}
Place place_of_height(double height, int rows, double top) {
    const double position = std::sqrt(std::clamp(height / top, 0.0, 1.0)) * (rows - 1);
    const int cell = std::clamp(int(position), 0, rows - 2);
    return {cell, float(position - cell)};
}

void lerp(const Bands& a, const Bands& b, float t, Bands& out) {
    for (size_t i = 0; i < band_count; ++i) out.v[i] = a.v[i] + (b.v[i] - a.v[i]) * t;
}
void add_lerp(Bands& sum, const Bands& a, const Bands& b, float t, float weight) {
    for (size_t i = 0; i < band_count; ++i) sum.v[i] += (a.v[i] + (b.v[i] - a.v[i]) * t) * weight;
}
void add_product(Bands& sum, const Bands& a, const Bands& b, float weight) {
    for (size_t i = 0; i < band_count; ++i) sum.v[i] += a.v[i] * b.v[i] * weight;
}

/// Nodes and weights on [-1, 1].
struct GaussRule {
    std::vector<double> x, w;
};
GaussRule gauss_legendre(int n) {
    GaussRule rule;
    for (int i = 0; i < n; ++i) {
        double x = std::cos(pi_d * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int iteration = 0; iteration < 50; ++iteration) {  // Newton on the Legendre polynomial
            double p = 1, before = 0;
            for (int k = 1; k <= n; ++k) {
                const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before = p, p = next;
            }
            slope = n * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        rule.x.push_back(x), rule.w.push_back(2 / ((1 - x * x) * slope * slope));
    }
    return rule;
}

/// A place on a ray: where it is, and what one unit of source there gives at the ray's start. The sun's cosine there is
/// across * sin(sun) * cos(azimuth) + up * cos(sun), with the sun's angle and azimuth at the start.
struct RayPoint {
    double r, across, up;
    Bands weight;        // the ground's: albedo / pi behind the air; a step's: mean
                         // transmittance times length
    Bands air, aerosol;  // a step's scattering coefficients in the scaled medium,
                         // times weight
    Place height;
};
struct Ray {
    double mu;
    double solid_angle;  // of its ring of the sphere
    std::vector<RayPoint> points;
    bool to_ground;  // then the last point is the ground
};

RayPoint point_on_ray(double r, double mu, double t) {
    RayPoint p;
    p.r = std::sqrt(r * r + t * t + 2 * r * mu * t);
    p.across = t * std::sqrt(std::max(0.0, 1 - mu * mu)) / p.r;
    p.up = (r + t * mu) / p.r;
    return p;
}

Ray make_ray(const Atmosphere& atmosphere, double r, double mu, double solid_angle, const ScatteringSize& size) {
    Ray ray{mu, solid_angle, {}, hits_ground(atmosphere, r, mu)};
    const double length = ray.to_ground ? distance_to_ground(atmosphere, r, mu) : distance_to_top(atmosphere, r, mu);
    Bands transmittance(1);
    for (int i = 0; i < size.steps; ++i) {
        const double n2 = double(size.steps) * size.steps;
        const double a = length * i * i / n2, b = length * (i + 1) * (i + 1) / n2;
        RayPoint p = point_on_ray(r, mu, 0.5 * (a + b));
        const double height = p.r - atmosphere.ground_radius;
        const Atmosphere::Amounts d = atmosphere.density(height);
        const Bands depth = atmosphere.scaled_depth(d) * float(b - a), passed = exp_minus(depth);
        p.weight = transmittance * mean_transmittance(depth, passed) * float(b - a);
        p.air = p.weight * atmosphere.air_scattering * float(d.air);
        p.aerosol = p.weight * atmosphere.scaled_aerosol_scattering * float(d.aerosol);
        p.height = place_of_height(height, size.heights, atmosphere.settings.top_height);
        transmittance *= passed;
        ray.points.push_back(p);
    }
    if (ray.to_ground) {
        RayPoint p = point_on_ray(r, mu, length);
        p.r = atmosphere.ground_radius + above_ground;
        p.weight = transmittance * float(atmosphere.settings.ground_albedo / pi_d);
        ray.points.push_back(p);
    }
    return ray;
}

/// Rays in all directions from a height, for a sphere split at the horizon, where radiance jumps.
std::vector<Ray> rays_from(const Atmosphere& atmosphere, double height, const ScatteringSize& size) {
    const double r = atmosphere.ground_radius + std::max(height, above_ground);
    const double ratio = atmosphere.ground_radius / r, horizon = -std::sqrt(std::max(0.0, 1 - ratio * ratio));
    const GaussRule rule = gauss_legendre(size.directions);
    std::vector<Ray> rays;
    for (const auto& [from, to] : {std::pair{horizon, 1.0}, std::pair{-1.0, horizon}})
        for (int i = 0; i < size.directions; ++i) {
            const double half = 0.5 * (to - from), mu = from + half * (1 + rule.x[size_t(i)]);
            rays.push_back(make_ray(atmosphere, r, mu, 2 * pi_d * half * rule.w[size_t(i)], size));
        }
    return rays;
}

struct Sun {
    double cosine, sine;
};

/// What arrives at a height from all directions: J, its mean, and E, from above on the horizontal, per sun.
struct Arrival {
    std::vector<Bands> mean, irradiance;
};

/// Cosines of azimuths on half a circle, away from the sun's.
std::vector<double> azimuth_cosines(int count) {
    std::vector<double> cosines;
    for (int a = 0; a < count; ++a) cosines.push_back(std::cos(pi_d * (a + 0.5) / count));
    return cosines;
}

/// radiance: the sum over azimuths.
void add(Arrival& to, int sun, const Ray& ray, const Bands& radiance, size_t azimuths) {
    const double share = ray.solid_angle / double(azimuths);
    for (size_t i = 0; i < band_count; ++i) {
        to.mean[size_t(sun)].v[i] += radiance.v[i] * float(share / (4 * pi_d));
        to.irradiance[size_t(sun)].v[i] += radiance.v[i] * float(share * std::max(0.0, ray.mu));
    }
}

/// Sunlight that was scattered once.
void first_order(const Atmosphere& atmosphere, const ColumnTable& columns, const std::vector<Ray>& rays,
                 const std::vector<Sun>& suns, const std::vector<double>& azimuths, Arrival& arrival) {
    for (const Ray& ray : rays)
        for (int m = 0; m < int(suns.size()); ++m) {
            const double sine = std::sqrt(std::max(0.0, 1 - ray.mu * ray.mu)) * suns[size_t(m)].sine;
            Bands radiance;
            for (const double azimuth : azimuths) {
                const auto nu = float(ray.mu * suns[size_t(m)].cosine + sine * azimuth);
                const float air = rayleigh_phase(nu), aerosol = aerosol_phase(nu, atmosphere.scaled_asymmetry);
                for (size_t k = 0; k < ray.points.size(); ++k) {
                    const RayPoint& p = ray.points[k];
                    const double mu_s = p.across * suns[size_t(m)].sine * azimuth + p.up * suns[size_t(m)].cosine;
                    if (hits_ground(atmosphere, p.r, mu_s)) continue;
                    const Bands light = scaled_sunlight(atmosphere, columns, p.r, mu_s);
                    if (ray.to_ground && k + 1 == ray.points.size()) {
                        add_product(radiance, p.weight, light, float(std::max(0.0, mu_s)));
                    } else {
                        add_product(radiance, p.air, light, air);
                        add_product(radiance, p.aerosol, light, aerosol);
                    }
                }
            }
            add(arrival, m, ray, radiance, azimuths.size());
        }
}

/// Light of one order more than `before`, which holds rows of suns per height and then the ground's irradiance.
void next_order(const std::vector<Ray>& rays, const std::vector<Sun>& suns, const std::vector<Bands>& before,
                int heights, const std::vector<double>& azimuths, Arrival& arrival) {
    const int count = int(suns.size());
    std::vector<Bands> source(suns.size());
    std::vector<Bands> radiance(suns.size());
    for (const Ray& ray : rays) {
        std::fill(radiance.begin(), radiance.end(), Bands());
        for (size_t k = 0; k < ray.points.size(); ++k) {
            const RayPoint& p = ray.points[k];
            const bool ground = ray.to_ground && k + 1 == ray.points.size();
            const Bands weight = ground ? p.weight : p.air + p.aerosol;
            const Bands* low = &before[size_t((ground ? heights : p.height.cell) * count)];
            const Bands* high = ground ? low : low + count;
            for (int m = 0; m < count; ++m) {
                lerp(low[m], high[m], ground ? 0 : p.height.t, source[size_t(m)]);
                source[size_t(m)] *= weight;
            }
            for (int m = 0; m < count; ++m)
                for (const double azimuth : azimuths) {
                    const double mu_s = p.across * suns[size_t(m)].sine * azimuth + p.up * suns[size_t(m)].cosine;
                    const Place at = place_on_axis(axis_from_mu(mu_s), count);
                    add_lerp(radiance[size_t(m)], source[size_t(at.cell)], source[size_t(at.cell) + 1], at.t, 1);
                }
        }
        for (int m = 0; m < count; ++m) add(arrival, m, ray, radiance[size_t(m)], azimuths.size());
    }
}

double largest_ratio(const std::vector<Bands>& part, const std::vector<Bands>& whole, size_t begin, size_t end) {
    double ratio = 0;
    for (size_t i = begin; i < end; ++i)
        ratio = std::max(ratio, luminance_from_bands(part[i]) / std::max(1e-30, luminance_from_bands(whole[i])));
    return ratio;
}

}  // namespace

Bands scaled_sunlight(const Atmosphere& atmosphere, const ColumnTable& columns, double r, double mu_s) {
    if (hits_ground(atmosphere, r, mu_s)) return Bands();
    return exp_minus(atmosphere.scaled_depth(columns.to_space(r, mu_s)));
}

ScatteringTable::ScatteringTable(const Atmosphere& atmosphere, const ScatteringSize& size,
                                 std::span<const float> values)
    : top_height_(atmosphere.settings.top_height),
      heights_(size.heights),
      suns_(size.suns),
      values_(size_t(size.heights + 1) * size_t(size.suns)) {
    for (size_t i = 0; i < values.size(); ++i) values_[i / band_count].v[i % band_count] = values[i];
}

ScatteringTable::ScatteringTable(const Atmosphere& atmosphere, const ColumnTable& columns, const ScatteringSize& size)
    : ScatteringTable(atmosphere, size, {}) {
    std::vector<Sun> suns;
    for (int m = 0; m < suns_; ++m) {
        const double mu = mu_from_axis(axis_at(m, suns_));
        suns.push_back({mu, std::sqrt(std::max(0.0, 1 - mu * mu))});
    }
    std::vector<std::vector<Ray>> rays(static_cast<size_t>(heights_));
    parallel_for(heights_, [&](int row) {
        rays[size_t(row)] = rays_from(atmosphere, height_at(row, heights_, top_height_), size);
    });
    const std::vector<double> azimuths = azimuth_cosines(size.azimuths);
    std::vector<Bands> order, next(values_.size());
    for (int n = 1; n <= size.max_orders; ++n) {
        parallel_for(heights_, [&](int row) {
            Arrival arrival{std::vector<Bands>(suns.size()), std::vector<Bands>(suns.size())};
            if (n == 1)
                first_order(atmosphere, columns, rays[size_t(row)], suns, azimuths, arrival);
            else
                next_order(rays[size_t(row)], suns, order, heights_, azimuths, arrival);
            std::copy(arrival.mean.begin(), arrival.mean.end(), next.begin() + row * suns_);
            if (row == 0) std::copy(arrival.irradiance.begin(), arrival.irradiance.end(), next.end() - suns_);
        });
        order = next;
        for (size_t i = 0; i < values_.size(); ++i) values_[i] += order[i];
        // Judged by the lowest height, for suns above -12 degrees: below, only ratios of nothing are left.
        const size_t first = size_t(place_on_axis(axis_from_mu(-0.2), suns_).cell);
        if (largest_ratio(order, values_, first, size_t(suns_)) < last_order) break;
    }
}

Bands ScatteringTable::row(const std::vector<Bands>& rows, int first, double mu_s) const {
    const Place at = place_on_axis(axis_from_mu(mu_s), suns_);
    Bands result;
    lerp(rows[size_t(first + at.cell)], rows[size_t(first + at.cell) + 1], at.t, result);
    return result;
}

Bands ScatteringTable::mean_radiance(double height, double mu_s) const {
    const Place at = place_of_height(height, heights_, top_height_);
    Bands result;
    lerp(row(values_, at.cell * suns_, mu_s), row(values_, (at.cell + 1) * suns_, mu_s), at.t, result);
    return result;
}

Bands ScatteringTable::ground_irradiance(double mu_s) const {
    return row(values_, heights_ * suns_, mu_s);
}

std::span<const float> ScatteringTable::values() const {
    return {values_.front().v.data(), values_.size() * band_count};
}

}  // namespace pluvia
