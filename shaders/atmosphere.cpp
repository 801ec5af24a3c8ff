#include "shaders/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double pi_d = std::numbers::pi;
// Of a triangle, in km. Source: Bruneton and Neyret 2008.
constexpr double ozone_bottom = 10, ozone_peak = 25, ozone_top = 40;

/// Optical depth of all air above sea level. Source: Hansen and Travis 1974, eq. 2.30; wavelength in micrometres.
double rayleigh_depth(double wavelength) {
    const double l2 = 1 / (wavelength * wavelength);
    return 0.008569 * l2 * l2 * (1 + 0.0113 * l2 + 0.00013 * l2 * l2);
}

Bands weighted(const Atmosphere::Amounts& a, const Bands& air, const Bands& aerosol, const Bands& ozone) {
    const auto x = float(a.air), y = float(a.aerosol), z = float(a.ozone);
    Bands sum;
    for (size_t i = 0; i < band_count; ++i) sum.v[i] = air.v[i] * x + aerosol.v[i] * y + ozone.v[i] * z;
    return sum;
}

}  // namespace

std::vector<AirDensity> standard_air() {
    constexpr AirDensity kg_per_m3[] = {{0, 1.2250},     {5, 0.73643},    {10, 0.41351},   {15, 0.19476},
                                        {20, 0.08891},   {25, 0.040084},  {30, 0.018410},  {40, 0.0039957},
                                        {50, 0.0010269}, {60, 3.0968e-4}, {70, 8.2829e-5}, {80, 1.8458e-5},
                                        {90, 3.416e-6},  {100, 5.604e-7}};
    std::vector<AirDensity> profile;
    for (const AirDensity& point : kg_per_m3) profile.push_back({point.height, point.relative / kg_per_m3[0].relative});
    return profile;
}

Atmosphere::Atmosphere(const AtmosphereSettings& s)
    : settings(s), ground_radius(s.planet_radius), top_radius(s.planet_radius + s.top_height) {
    const double f = s.forward_fraction;
    scaled_asymmetry = float((s.asymmetry - f) / (1 - f));
    for (int i = 0; i < band_count; ++i) {
        const SpectralBand& band = bands[size_t(i)];
        air_scattering[i] = float(rayleigh_depth(band.wavelength) / s.rayleigh_height);
        const double extinction = s.beta * std::pow(band.wavelength, -s.angstrom_exponent) / s.aerosol_height;
        const double scattering = extinction * s.aerosol_albedo;
        aerosol_extinction[i] = float(extinction);
        aerosol_scattering[i] = float(scattering);
        scaled_aerosol_extinction[i] = float(extinction - f * scattering);
        scaled_aerosol_scattering[i] = float((1 - f) * scattering);
        ozone_extinction[i] = float(band.ozone * (s.ozone_dobson / 300) / (0.5 * (ozone_top - ozone_bottom)));
    }
    for (const AirDensity& point : s.air) log_air_.push_back(std::log(point.relative));
}

Atmosphere::Amounts Atmosphere::density(double height) const {
    const double h = std::clamp(height, 0.0, settings.top_height);
    const auto& air = settings.air;
    size_t k = 1;
    while (k + 1 < air.size() && air[k].height < h) ++k;
    const double t = (h - air[k - 1].height) / (air[k].height - air[k - 1].height);
    const double ozone =
        h < ozone_peak ? (h - ozone_bottom) / (ozone_peak - ozone_bottom) : (ozone_top - h) / (ozone_top - ozone_peak);
    return {std::exp(log_air_[k - 1] + t * (log_air_[k] - log_air_[k - 1])), std::exp(-h / settings.aerosol_height),
            std::max(0.0, ozone)};
}

Bands Atmosphere::depth(const Amounts& a) const {
    return weighted(a, air_scattering, aerosol_extinction, ozone_extinction);
}

Bands Atmosphere::scaled_depth(const Amounts& a) const {
    return weighted(a, air_scattering, scaled_aerosol_extinction, ozone_extinction);
}

Bands Atmosphere::scaled_scattering(const Amounts& d) const {
    return weighted(d, air_scattering, scaled_aerosol_scattering, Bands());
}

float rayleigh_phase(float nu) {
    return float(3 / (16 * pi_d)) * (1 + nu * nu);
}

float aerosol_phase(float nu, float g) {
    const float d = 1 + g * g - 2 * g * nu;
    return (1 - g * g) / (float(4 * pi_d) * d * std::sqrt(d));
}

double beta_from_turbidity(double turbidity) {
    return std::max(0.0, 0.04608 * turbidity - 0.04586);
}

}  // namespace pluvia
