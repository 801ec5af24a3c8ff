// What the atmosphere is made of: air, ozone and aerosol by height and wavelength. Kilometres throughout, since in
// metres the planet's radius would use up the digits. Light is sent through it by column_table.h, scattering_table.h
// and sky_view.h.
#pragma once

#include "shaders/bands.h"

#include <vector>

namespace pluvia {

/// A point of the profile of air; between points the density is an exponential of the height.
struct AirDensity {
    double height;    // km, rising from 0
    double relative;  // to that at sea level, above 0
};
/// US Standard Atmosphere 1976. With the usual exponential of 8 km twilight comes out two to three times too bright.
std::vector<AirDensity> standard_air();

struct AtmosphereSettings {
    double planet_radius = 6371, top_height = 100;  // km
    std::vector<AirDensity> air = standard_air();
    double rayleigh_height = 8.434;  // km of air at sea level density that scatter
                                     // as the whole atmosphere does
    double ozone_dobson = 300;
    // Aerosol: optical depth beta * wavelength^-exponent (micrometres), Angstrom's law. beta and the albedo are chosen
    // to meet published illuminances; 0.05 is very clear, 0.2 hazy.
    double beta = 0.1, angstrom_exponent = 1.3;
    double aerosol_height = 1.2;                      // km, of an exponential
    double aerosol_albedo = 0.87;                     // of single scattering
    double asymmetry = 0.76;                          // mean cosine of Henyey and Greenstein's phase function
    double forward_fraction = asymmetry * asymmetry;  // of scattering that counts as not scattered (see below)
    double ground_albedo = 0.1;                       // of a town, wet
};

/// The coefficients of an atmosphere, per km and band at sea level, and its densities.
///
/// Aerosol scatters mostly forwards, too sharply for a table of mean radiances. As in the delta-M method (Wiscombe
/// 1977; Joseph, Wiscombe and Weinman 1976) a fraction f of its scattering is taken out as if it did not deflect, and
/// the rest scatters with the smaller asymmetry (g - f) / (1 - f). "Scaled" names that medium.
struct Atmosphere {
    explicit Atmosphere(const AtmosphereSettings& settings = {});

    AtmosphereSettings settings;
    double ground_radius, top_radius;  // km
    Bands air_scattering, aerosol_scattering, aerosol_extinction, ozone_extinction;
    Bands scaled_aerosol_scattering, scaled_aerosol_extinction;
    float scaled_asymmetry;

    /// Amounts at a height relative to where each is densest, or their integrals along a way, in km.
    struct Amounts {
        double air = 0, aerosol = 0, ozone = 0;
    };
    /// height: km, from 0 to top_height; outside as at the nearer end.
    Amounts density(double height) const;

    /// Optical depth of amounts along a way; that of the scaled medium.
    Bands depth(const Amounts& a) const;
    Bands scaled_depth(const Amounts& a) const;
    /// Scattering coefficient of the scaled medium, per km.
    Bands scaled_scattering(const Amounts& density) const;

private:
    std::vector<double> log_air_;  // of settings.air
};

/// Phase functions, per steradian; nu is the cosine of the angle of deflection.
float rayleigh_phase(float nu);
/// Henyey and Greenstein 1941.
float aerosol_phase(float nu, float asymmetry);

/// Beta of a turbidity, the haze's part in Linke's sense: 1 has none, 2 is very clear, 10 hazy. Source: Preetham,
/// Shirley and Smits 1999, appendix 1; 0 below 1.
double beta_from_turbidity(double turbidity);

}  // namespace pluvia
