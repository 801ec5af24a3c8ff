// Procedural pictures of materials: base colour, roughness and metalness, and a normal map from a height field.
// They tile unless said otherwise; noise.h has the noise, brush.h the writing on signs.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/vec.h"
#include "renderer/image/image.h"

#include <functional>

namespace pluvia {

/// Pictures of one material, as the slots of Material expect them.
struct SurfaceMaps {
    Image<Rgba8> base_color;          // sRGB
    Image<Rgba8> metallic_roughness;  // roughness in g, metallic in b
    Image<Rgba8> normal;              // tangent space, green up
};

/// One texel of a material before it is coded.
struct Texel {
    Rgb albedo = Rgb(0.5f);
    float roughness = 0.8f, metallic = 0;
    float height = 0;  // metres above the mean surface
    float alpha = 1;
};

/// Evaluates texel(x, y) with x to the right and y downwards in [0, 1); size: metres that the picture covers, for the
/// slopes of the normal map, which wraps around.
SurfaceMaps paint(int width, int height, Vec2 size, const std::function<Texel(float x, float y)>& texel);

/// The same for a picture whose albedo alone matters.
Image<Rgba8> paint_color(int width, int height, const std::function<Rgb(float x, float y)>& color);

// Materials. Each says how many metres the picture covers; albedos are means.

/// Boards of stained cedar, grain along v, 0.6 m x 2.4 m; albedo 0.22 before tinting.
SurfaceMaps wood();
/// Lime or clay plaster with trowel marks and hairline cracks, 2 m x 2 m; albedo 0.6.
SurfaceMaps plaster();
/// Worn granite, 1.2 m x 1.2 m; albedo 0.27.
SurfaceMaps granite();
/// Smoked clay of roof tiles, 0.8 m x 0.8 m; albedo 0.08, somewhat glossy.
SurfaceMaps clay();
/// Painted or galvanised sheet metal with stains that run downwards, 1 m x 1 m; albedo 0.5 before tinting.
SurfaceMaps sheet_metal();
/// Bricks in running bond, 215 x 65 mm with joints of 10, 1.8 m x 1.8 m; albedo 0.25, red.
SurfaceMaps red_brick();
/// The same of pale buff bricks; albedo 0.42.
SurfaceMaps pale_brick();
/// Glazed facade tiles in running bond, 95 x 45 mm, 1.2 m x 1.2 m; albedo 0.4, to be tinted.
SurfaceMaps wall_tiles();
/// Dressed sandstone with its bedding and rain stains, 2 m x 2 m; albedo 0.5, to be tinted.
SurfaceMaps sandstone();
/// Cast paving, stained and worn, 1.6 m x 1.6 m; albedo 0.5.
SurfaceMaps paving_stone();
/// Asphalt with its stones worn bare, 2 m x 2 m; albedo 0.11.
SurfaceMaps asphalt();
/// Furrowed bark, furrows along v, 0.5 m x 0.5 m; albedo 0.13.
SurfaceMaps bark();
/// Zinc flowers of hot-dip galvanised steel, metallic, 0.8 m x 0.8 m.
SurfaceMaps galvanised();
/// Soil and moss between paving stones, 0.5 m x 0.5 m; albedo 0.07.
SurfaceMaps soil();
/// Woven cotton, 0.25 m x 0.25 m; albedo 0.7 before tinting.
SurfaceMaps cloth();
/// Roof seen from afar: courses of pan tiles, 1.06 m x 0.94 m (4 x 4 tiles); albedo 0.08.
SurfaceMaps tiled_roof();
/// One leaf with its midrib up the picture, alpha 0 around it; does not tile; albedo 0.1.
SurfaceMaps leaf();
/// A fallen leaf, alpha 0 around it; does not tile; albedo 0.2.
SurfaceMaps dry_leaf();
/// Feathered palm frond, alpha 0 between the leaflets; does not tile; albedo 0.1.
SurfaceMaps frond();

}  // namespace pluvia
