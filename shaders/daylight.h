// How much light sun and clear sky give, and the colour of the sun, as functions of the sun's elevation.
// Where in the sky it comes from is in sky.h.
#pragma once

#include "renderer/core/rgb.h"

namespace pluvia {

/// Starlight and airglow on a horizontal surface, in lux. Source: Janiczek and DeYoung 1987.
constexpr double night_sky_illuminance = 0.0005;

/// Illuminance on a horizontal surface under sun and clear sky without moon, in lux.
/// sun_elevation: radians, -pi/2 to pi/2; from 124 klx with the sun in the zenith over 757 lx with the sun on the
/// horizon down to the 0.5 mlx of starlight and airglow.
/// Source: Janiczek and DeYoung 1987, US Naval Observatory Circular 171; within some 10 % by day and 20 % in twilight
/// of Seidelmann 1992, Explanatory Supplement to the Astronomical Almanac.
double clear_sky_illuminance(double sun_elevation);

/// Illuminance by the sun alone on a surface that faces it: a colour whose luminance() is in lux.
/// Beer's law in 12 bands over the spectrum of ASTM G173, through air, ozone (300 DU) and haze.
/// sun_elevation: radians; below 0 as at 0. turbidity: 2 to 10.
/// Sources: air mass Kasten and Young 1989; Rayleigh scattering Hansen and Travis 1974, eq. 2.30; haze by Angstrom's
/// law with exponent 1.3 and the coefficient of Preetham, Shirley and Smits 1999, appendix 1.
Rgb sunlight(double sun_elevation, double turbidity);

/// Linear Rec.709 with the luminance of CIE 1931 XYZ (matrix of IEC 61966-2-1). Colours that lie outside the gamut are
/// moved towards grey at constant luminance until no component is negative. y must not be negative.
Rgb rec709_from_xyz(double x, double y, double z);

}  // namespace pluvia
