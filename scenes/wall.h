// Walls with holes, the ground of every facade: the face around its openings, their reveals, and the stones around
// them. Facade frame: x to the right along the wall, y up from the ground, z out of the wall, metres.
#pragma once

#include "scenes/shapes.h"

#include <numbers>
#include <vector>

namespace pluvia {

/// A hole in a wall. rise: height of an elliptic arch below `top`; 0 = flat.
struct Opening {
    float left = 0, right = 1, bottom = 0, top = 1, rise = 0;

    float width() const { return right - left; }
    float height() const { return top - bottom; }
    float middle() const { return 0.5f * (left + right); }
    /// Height of its upper edge at x, left <= x <= right.
    float head(float x) const;
    /// The same, smaller by `margin` at its sides and top.
    Opening inset(float margin) const;
};

/// Number of straight pieces of an arch.
constexpr int arch_pieces = 12;

/// Face of a wall at z between two corners, without the openings, which must not overlap.
void add_wall(Shape& shape, Vec2 lower, Vec2 upper, float z, const std::vector<Opening>& openings,
              const Tint& tint = {});

/// The four sides of an opening from the face at z = front back to z = back < front.
void add_reveal(Shape& shape, const Opening& opening, float front, float back, const Tint& tint = {});

/// Wedge-shaped stones over a flat or arched head, `depth` high and proud of the face at z by `out`.
void add_head_stones(Shape& shape, const Opening& opening, float depth, float z, float out, int count, float grey);

/// Frame of constant width around an opening, outside of it, from z = back to z = front; without a lower side.
void add_architrave(Shape& shape, const Opening& opening, float width, float back, float front, const Tint& tint = {});

/// Facade frames of the four directions; start: the end of the wall at the left of someone who faces it.
inline Transform left_wall(double x, double z_start) {
    return {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {x, 0, z_start}};
}
inline Transform right_wall(double x, double z_start) {
    return {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, {x, 0, z_start}};
}
inline Transform end_wall(double x_start, double z) {
    return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {x_start, 0, z}};
}
inline Transform facing_away(double x_start, double z) {
    return {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {x_start, 0, z}};
}

}  // namespace pluvia
