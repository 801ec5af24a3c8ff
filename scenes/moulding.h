// Mouldings: profiles drawn along a wall (sills, string courses, cornices, kerbs) and what repeats below them.
// Facade frame as in wall.h.
#pragma once

#include "scenes/shapes.h"

#include <vector>

namespace pluvia {

/// Draws a profile along x from x0 to x1. profile: points (z, y) from bottom to top; its ends are closed back to z =
/// back.
void add_moulding(Shape& shape, const std::vector<Vec2>& profile, float x0, float x1, float back,
                  const Tint& tint = {});

/// Window sill with a drip edge, its top at y, from x0 to x1, standing out by `out` from the wall at z = 0.
void add_sill(Shape& shape, float x0, float x1, float y, float out, float height = 0.11f, const Tint& tint = {});

/// Flat band with a chamfered top and bottom, from y0 to y1.
void add_band(Shape& shape, float x0, float x1, float y0, float y1, float out, const Tint& tint = {});

/// Crowning cornice that starts at y and stands out by `out`, with brackets every `pitch` metres and a row of dentils
/// below; returns the height of its top.
float add_cornice(Shape& shape, float x0, float x1, float y, float out, float pitch, const Tint& tint = {});

/// Blocks of two lengths in turn up a corner at x; sign: +1 = they reach to the right of x, -1 = to the left.
void add_quoins(Shape& shape, float x, float sign, float y0, float y1, float out);

}  // namespace pluvia
