// Which channels of an EXR file make a layer, in the ways that Pluvia, Blender's Cycles, Mitsuba and pbrt name them.
#pragma once

#include "renderer/image/exr.h"

#include <span>
#include <string>
#include <vector>

namespace pluvia {

/// Three channels of a colour or a vector, or a single one.
struct ExrLayer {
    std::string name;                   // what the channels have in common: "background", "ViewLayer.Combined"
    std::vector<std::string> channels;  // red, green and blue; X, Y and Z; or one
    bool is_depth = false;              // metres: Z, a depth or a distance
};

/// layer, empty: the picture itself, which is the first of: `background`; R, G and B without a name (Mitsuba, pbrt,
/// plain files); `<root>` (Mitsuba); `Combined` of a view layer (Cycles); the only colour or the only channel of the
/// file. depth: Z, or Z of a view layer's Depth. distance: `distance.Y`, or the T of a Mitsuba AOV. Any other: a
/// channel of that name, or the channels that begin with it and a point, also behind the name of a view layer: "Albedo"
/// finds Albedo.R, Albedo.G, Albedo.B, and "Combined" ViewLayer.Combined.R, ... where: the file, for messages. Throws
/// Error (input) with the layers there are when none or several fit.
ExrLayer find_layer(std::span<const ExrChannel> channels, const std::string& layer, const std::string& where);

}  // namespace pluvia
