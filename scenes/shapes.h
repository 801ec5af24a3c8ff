// Shapes: triangles of one finish being collected, and the primitives that streets are made of.
// Texture coordinates are in metres and grow to the right and downwards; assembly.h divides them by a picture's size.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/core/transform.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace pluvia {

/// All attributes have one value per vertex; normals are of unit length.
struct Shape {
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;
    std::vector<Rgb> colors;
    std::vector<std::array<uint32_t, 3>> triangles;
};

/// How one primitive differs from its neighbours of the same finish.
struct Tint {
    Rgb color = Rgb(1);  // multiplies the base colour
    Vec2 uv_offset;      // metres
};

/// Adds a copy of `part`; the transform may rotate, move, scale and mirror.
void append(Shape& shape, const Shape& part, const Transform& shape_from_part);

/// Flat quadrilateral. corners: lower left, lower right, upper right, upper left as seen from the front.
/// uv_lower_left and uv_upper_right: metres, or 0..1 for a finish whose picture has the size 1.
void add_quad(Shape& shape, const std::array<Vec3, 4>& corners, Vec2 uv_lower_left, Vec2 uv_upper_right,
              const Tint& tint = {});

/// Flat quadrilateral whose texture lies as the world does: u along the horizontal and v down, or as seen from above.
/// corners: counter-clockwise as seen from the front, the first two or last two may be one.
void add_facet(Shape& shape, const std::array<Vec3, 4>& corners, const Tint& tint = {});

/// Box of facets: bricks and stones run on from one to the next. lower and upper: opposite corners.
void add_block(Shape& shape, Vec3 lower, Vec3 upper, const Tint& tint = {});

/// Box between two corners; the grain (v of the texture) runs along its longest edge.
/// bevel: width and depth of the chamfer around the +z face, 0 = none; less than half of every edge.
void add_box(Shape& shape, Vec3 lower, Vec3 upper, const Tint& tint = {}, float bevel = 0);

/// Upright board that is seen from +z alone: its front and the rounded-off edges to its left and right, two thirds
/// fewer triangles than a box. edge: width of these.
void add_plank(Shape& shape, Vec3 lower, Vec3 upper, float edge, const Tint& tint = {});

/// Box from `start` to `end` (centres of its end faces), width across and height along `up`, which need not be
/// perpendicular to it. The grain runs along it.
void add_beam(Shape& shape, Vec3 start, Vec3 end, Vec3 up, float width, float height, const Tint& tint = {});

/// A point of a curved sheet with its texture coordinates in metres.
struct SheetPoint {
    Vec3 position;
    Vec2 uv;
};
/// Grid of columns x rows quadrilaterals over s, t in [0, 1] with smooth normals; the front is where s to the right and
/// t upwards are seen so.
void add_sheet(Shape& shape, int columns, int rows, const std::function<SheetPoint(float s, float t)>& surface,
               const Tint& tint = {});

/// Round tube along a path of at least two different points, closed by flat ends.
void add_tube(Shape& shape, const std::vector<Vec3>& path, float radius, int sides, const Tint& tint = {});

/// The same with a radius at each point.
void add_tube(Shape& shape, const std::vector<Vec3>& path, const std::vector<float>& radii, int sides,
              const Tint& tint = {});

/// Gives triangles that face away from their smooth normals, at creases too sharp for these, corners of their own.
void flatten_creases(Shape& shape);

/// The path with every inner corner replaced by an arc-like curve that starts and ends `radius` from the corner
/// (at most half way to the next).
std::vector<Vec3> rounded(const std::vector<Vec3>& path, float radius, int steps = 4);

/// Surface of revolution around the y axis. profile: (radius, height) from bottom to top, outside to the right of the
/// way; edges sharper than 40 degrees stay sharp. uv_size: texture coordinates of one turn and of the whole profile.
void add_lathe(Shape& shape, const std::vector<Vec2>& profile, int sides, Vec2 uv_size, const Tint& tint = {});

}  // namespace pluvia
