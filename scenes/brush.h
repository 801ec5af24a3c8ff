// Writing with a brush: simple characters given by their strokes, painted into a picture of ink coverage.
#pragma once

#include "renderer/core/vec.h"
#include "renderer/image/image.h"

#include <string>
#include <vector>

namespace pluvia {

/// How much ink lies on a sheet, 0 to 1.
using Ink = Image<float>;

/// Paints one character into the box that starts at `corner` (upper left) with the given size, in pixels.
/// name: a character's reading, see characters.cpp (yama, kawa, tsuki, ...). weight: brush width as a share of the
/// size. Throws Error (input) for a name that is not known.
void write_glyph(Ink& ink, const std::string& name, Vec2 corner, float size, float weight = 0.1f);

/// Characters one below the other, centred around column x, from y = top to bottom, in pixels.
void write_column(Ink& ink, const std::vector<std::string>& names, float x, float top, float bottom,
                  float weight = 0.1f);

/// A line of Latin capitals with a pen of constant width, centred, in pixels.
void write_text(Ink& ink, const std::string& text, Vec2 centre, float height, float width);

/// Line of constant width between two points, in pixels, for frames and rules.
void draw_line(Ink& ink, Vec2 from, Vec2 to, float width);

/// Ring, in pixels; width 0 or less = filled disk.
void draw_ring(Ink& ink, Vec2 centre, float radius, float width);

}  // namespace pluvia
