// Size distribution and fall speed of raindrops as functions of rain intensity, and what follows in closed form:
// number, extinction and water flux between two diameters. Drops are placed in space by drop_population.h.
#pragma once

namespace pluvia {

constexpr double smallest_drop = 0.1e-3;  // diameter in metres; smaller ones are cloud, not rain
constexpr double largest_drop = 6e-3;     // diameter in metres; larger drops break up
constexpr double highest_intensity_mm_per_h = 1000;

/// N0 of Marshall and Palmer in m^-4: number of drops per volume and diameter interval at D -> 0.
constexpr double marshall_palmer_n0 = 8e6;

/// Throws a usage error unless the intensity is a number of at most highest_intensity_mm_per_h. Zero and negative mean
/// no rain and are valid.
void check_intensity(double intensity_mm_per_h);

/// beta of the size distribution N(D) = N0 exp(-beta D), in 1/m. Infinite where there is no rain (intensity <= 0).
/// The distribution is a fit to intensities up to about 500 mm/h.
/// Source: Marshall and Palmer 1948, eq. 1 and 3 (4.1 I^-0.21 per mm).
double size_slope(double intensity_mm_per_h);

/// Speed in m/s at which a drop of this diameter (metres) falls through still air. Source: Kessler 1969, 130 sqrt(D).
double fall_speed(double diameter);

/// Integral of D^order N(D) over the diameters d1 to d2 (metres), in m^(order - 3). 0 where there is no rain or
/// d2 <= d1. order >= 0, d1 >= 0. Relative error below 1e-12 where the interval is not narrower than 1e-3 of d1.
double size_moment(double intensity_mm_per_h, double order, double d1 = smallest_drop, double d2 = largest_drop);

/// Drops per cubic metre with diameters from d1 to d2 (metres), without loss of digits for narrow intervals.
double number_density(double intensity_mm_per_h, double d1 = smallest_drop, double d2 = largest_drop);

/// Extinction coefficient in 1/m of the drops from d1 to d2: their cross-section per volume. The efficiency is 1 and
/// not 2, since light diffracted by a drop stays within about a pixel.
double extinction(double intensity_mm_per_h, double d1 = smallest_drop, double d2 = largest_drop);

/// Volume of water in drops from d1 to d2 that reaches level ground per area and time in still air, in m/s.
/// It differs from the nominal intensity, since the two fits were made apart: by +43 % at 0.1 mm/h, -2 % at 100 (before
/// truncation).
double rain_rate(double intensity_mm_per_h, double d1 = smallest_drop, double d2 = largest_drop);

}  // namespace pluvia
