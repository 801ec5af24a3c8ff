// Characters as strokes, for the brush, for painted and for neon signs: Latin capitals, and Japanese by their reading.
#pragma once

#include "renderer/core/vec.h"

#include <string>
#include <vector>

namespace pluvia {

using Stroke = std::vector<Vec2>;

/// Strokes of a character in a box of 100 x 100, x to the right and y downwards, as corner points.
/// Throws Error (input) for a name that characters.cpp does not have.
std::vector<Stroke> strokes_of(const std::string& name);

/// The curve that a pen draws through the points: smooth where they turn gently, a corner where they turn sharply.
/// step: length of its straight pieces where it is curved.
Stroke smoothed(const Stroke& points, float step);

/// Curve through four points, between b and c, t from 0 to 1. Source: Catmull and Rom 1974, uniform, tension 1/2.
Vec2 spline(Vec2 a, Vec2 b, Vec2 c, Vec2 d, float t);

/// Curves of a line of Latin capitals from (0, 0), y upwards, `height` high.
std::vector<Stroke> text_paths(const std::string& text, float height);
float text_width(const std::string& text, float height);

}  // namespace pluvia
