// The colour of heat: of a body at a temperature, and the temperature whose
// colour is nearest to a light's.
#pragma once

#include "shaders/bands.h"

#include <optional>

namespace pluvia {

/// Light of a black body with luminance 1, linear Rec.709. temperature: kelvin,
/// 1000 to 100000. Sources: Planck's law; CIE 1931 by the fit of Wyman, Sloan
/// and Shirley 2013.
Rgb blackbody_color(double temperature);

/// Correlated colour temperature in kelvin, 1000 to 100000; empty where the
/// light is black or bluer than any body. Nearest in CIE 1960 u, v, as CIE 15
/// defines it.
std::optional<double> color_temperature(Rgb light);

}  // namespace pluvia
