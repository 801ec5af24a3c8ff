#include "shaders/sky_view.h"

#include "renderer/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi;
constexpr double above_ground = 1e-3;  // km

double radius_at(const SkyTables& tables, double altitude) {
    return tables.atmosphere.ground_radius + std::clamp(altitude, above_ground, tables.atmosphere.settings.top_height);
}

/// What the phase function of aerosol has beyond that of the scaled medium,
/// integrated to the forward fraction.
float peak(const Atmosphere& atmosphere, float nu) {
    const auto f = float(atmosphere.settings.forward_fraction);
    return aerosol_phase(nu, float(atmosphere.settings.asymmetry)) -
           (1 - f) * aerosol_phase(nu, atmosphere.scaled_asymmetry);
}

}  // namespace

Bands scattered_radiance(const SkyTables& tables, double r, double mu, double mu_s, double nu, int steps) {
    const Atmosphere& atmosphere = tables.atmosphere;
    const bool to_ground = hits_ground(atmosphere, r, mu);
    const double length = to_ground ? distance_to_ground(atmosphere, r, mu) : distance_to_top(atmosphere, r, mu);
    const float air_phase = rayleigh_phase(float(nu)), smooth = aerosol_phase(float(nu), atmosphere.scaled_asymmetry);
    const float peak_phase = peak(atmosphere, float(nu));
    const Bands peak_depth = atmosphere.aerosol_scattering * float(atmosphere.settings.forward_fraction);
    Bands sum, transmittance(1);
    double aerosol_column = 0;  // from the eye
    for (int i = 0; i < steps; ++i) {
        const double n2 = double(steps) * steps, a = length * i * i / n2, b = length * (i + 1) * (i + 1) / n2;
        const double t = 0.5 * (a + b), here = std::sqrt(r * r + t * t + 2 * r * mu * t);
        const double sun = (r * mu_s + t * nu) / here;  // cosine of the sun's angle to the zenith there
        const double height = here - atmosphere.ground_radius;
        const Atmosphere::Amounts d = atmosphere.density(height);
        Bands source = tables.scattering.mean_radiance(height, sun) * atmosphere.scaled_scattering(d);
        if (!hits_ground(atmosphere, here, sun)) {
            const Atmosphere::Amounts column = tables.columns.to_space(here, sun);
            const Bands light = exp_minus(atmosphere.scaled_depth(column));
            // Light that met the peak n times, n from 1, on its way through x:
            // exp(-x) (exp(x) - 1) of what the scaled medium lets through; per unit
            // of x it is (1 - exp(-x)) / x.
            const Bands x = peak_depth * float(aerosol_column + 0.5 * d.aerosol * (b - a) + column.aerosol);
            const Bands in_peak = mean_transmittance(x, exp_minus(x));
            for (size_t k = 0; k < band_count; ++k)
                source.v[k] +=
                    light.v[k] * (atmosphere.air_scattering.v[k] * float(d.air) * air_phase +
                                  float(d.aerosol) * (atmosphere.scaled_aerosol_scattering.v[k] * smooth +
                                                      atmosphere.aerosol_scattering.v[k] * peak_phase * in_peak.v[k]));
        }
        const Bands depth = atmosphere.scaled_depth(d) * float(b - a), passed = exp_minus(depth);
        sum += transmittance * source * mean_transmittance(depth, passed) * float(b - a);
        transmittance *= passed;
        aerosol_column += d.aerosol * (b - a);
    }
    if (to_ground) {
        const double ground = atmosphere.ground_radius + above_ground;
        const double sun = std::clamp((r * mu_s + length * nu) / atmosphere.ground_radius, -1.0, 1.0);
        const Bands arriving = scaled_sunlight(atmosphere, tables.columns, ground, sun) * float(std::max(0.0, sun)) +
                               tables.scattering.ground_irradiance(sun);
        sum += transmittance * arriving * float(atmosphere.settings.ground_albedo / pi_d);
    }
    return sum;
}

Bands direct_transmittance(const SkyTables& tables, double sun_elevation, double altitude) {
    const double r = radius_at(tables, altitude), mu = std::sin(sun_elevation);
    if (hits_ground(tables.atmosphere, r, mu)) return Bands();
    return exp_minus(tables.atmosphere.depth(tables.columns.to_space(r, mu)));
}

SkyView::SkyView(const SkyTables& tables, double sun_elevation, double altitude)
    : values_(size_t(azimuths) * elevations) {
    const double r = radius_at(tables, altitude), sun = std::sin(sun_elevation), sun_across = std::cos(sun_elevation);
    parallel_for(elevations, [&](int y) {
        const double v = double(y) / (elevations - 1), elevation = 0.5 * pi_d * v * v;
        const double mu = std::sin(elevation), across = std::cos(elevation);
        for (int x = 0; x < azimuths; ++x) {
            const double nu = mu * sun + across * sun_across * std::cos(pi_d * x / (azimuths - 1));
            const Bands light = scattered_radiance(tables, r, mu, sun, std::clamp(nu, -1.0, 1.0));
            values_[size_t(y) * azimuths + size_t(x)] = rec709_from_xyz(xyz_from_bands(light));
        }
    });
}

Rgb SkyView::radiance(double elevation, double azimuth) const {
    const double v = std::sqrt(std::clamp(elevation / (0.5 * pi_d), 0.0, 1.0)) * (elevations - 1);
    const double u = std::abs(std::remainder(azimuth, 2 * pi_d)) / pi_d * (azimuths - 1);
    const int y = std::min(int(v), elevations - 2), x = std::min(int(u), azimuths - 2);
    const auto ty = float(v - y), tx = float(u - x);
    const Rgb* low = &values_[size_t(y) * azimuths + size_t(x)];
    return mix(mix(low[0], low[1], tx), mix(low[azimuths], low[azimuths + 1], tx), ty);
}

}  // namespace pluvia
