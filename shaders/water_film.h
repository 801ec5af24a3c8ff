// Water on a surface: how its Bsdf changes under a film. Where the film comes from is renderer/transport/wet_ground.h.
//
// A smooth film over a rough diffuse base is a dielectric coat of water over a base that has become darker, since the
// film sends part of what the base scatters back to it: the metallic-roughness model (metallic_roughness.h) with the
// index of water and the colour of wet_albedo(). So nothing new has to be evaluated or sampled, and reciprocity and the
// furnace are the model's own.
#pragma once

#include "shaders/bsdf.h"

namespace pluvia {

/// Reflectance that makes a diffuse surface of reflectance `dry` what it is below water, as the base colour under a
/// coat of water: a (1 - p) / (1 - p a), where p = 0.475 is the share of diffuse light that the film's upper side
/// reflects back down. 0.1 becomes 0.055, 0.5 0.344, 1 stays 1.
/// Source: Angstrom 1925; Lekner and Dorf 1988, "Why some things are darker when wet", with an absorbing base.
Rgb wet_albedo(Rgb dry);

/// How much water there is: from none (0) to a film that follows the surface (film = 1), and from there to one deep
/// enough to be flat (pool = 1). Between them the parameters of the models are mixed.
struct WaterCover {
    float film = 0, pool = 0;
    float uneven = 0;  // -1 to 1: a rougher or smoother film than the mean one

    float any() const { return std::max(film, pool); }
};

/// The Bsdf under water. Metal and varnish get the film as a coat and keep their colour, as does what is polished:
/// there is nothing for water to soak. Panes and glass stay as they are.
Bsdf under_water(const Bsdf& dry, const WaterCover& water);

}  // namespace pluvia
