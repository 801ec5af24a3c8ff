// What shines in the lane: globes, an iron lantern, paper lanterns and lit signs. Luminances are in lane_finishes.cpp.
#include "scenes/lane.h"

#include "renderer/core/units.h"

#include <cmath>

namespace pluvia::lane {
namespace {

/// Points of a circle arc in a profile's (radius, height), angles from the horizontal in degrees.
std::vector<Vec2> arc(Vec2 centre, float radius, float from, float to, int steps) {
    std::vector<Vec2> points;
    for (int i = 0; i <= steps; ++i) {
        const float phi = (from + (to - from) * float(i) / float(steps)) * pi / 180;
        points.push_back(centre + Vec2{std::max(0.0f, std::cos(phi)), std::sin(phi)} * radius);
    }
    return points;
}

/// Rectangular frame of bars around a panel in the xy plane.
void add_frame(Shape& shape, Vec3 lower, Vec3 upper, float bar) {
    add_box(shape, lower, {lower.x + bar, upper.y, upper.z}, {}, 0.004f);
    add_box(shape, {upper.x - bar, lower.y, lower.z}, upper, {}, 0.004f);
    add_box(shape, lower, {upper.x, lower.y + bar, upper.z}, {}, 0.004f);
    add_box(shape, {lower.x, upper.y - bar, lower.z}, upper, {}, 0.004f);
}

/// Panel with a picture on its front (z = front) and on its back.
void add_two_sided(Shape& shape, float half_width, float bottom, float top, float front) {
    for (const float side : {1.0f, -1.0f}) {
        const float x = side * half_width, z = side * front;
        add_quad(shape, {Vec3{-x, bottom, z}, {x, bottom, z}, {x, top, z}, {-x, top, z}}, {0, 1}, {1, 0});
    }
}

}  // namespace

Assembly globe_lamp(const Finishes& f) {
    Assembly a;
    constexpr float reach = 0.32f, radius = 0.105f;
    add_tube(a[f.iron], rounded({{0, 0, 0}, {0, 0.06f, 0.12f}, {0, 0.06f, reach}, {0, -0.04f, reach}}, 0.08f, 5),
             0.011f, 8);
    add_tube(a[f.iron], {{0, 0, 0}, {0, 0, 0.015f}}, 0.045f, 14);
    Shape fitting, globe;
    add_lathe(fitting, {{0.05f, -0.075f}, {0.045f, -0.05f}, {0.02f, -0.03f}, {0.0f, -0.025f}}, 12, {0.3f, 0.1f});
    append(a[f.iron], fitting, translate({0, 0, reach}));
    add_lathe(globe, arc({0, 0}, radius, -90, 62, 8), 16, {1, 1});
    append(a[f.lamp_glass], globe, translate({0, -0.16, reach}));
    return a;
}

Assembly wall_lantern(const Finishes& f) {
    Assembly a;
    constexpr float reach = 1.0f;  // past the signboard that hangs at the same place
    add_tube(a[f.iron], rounded({{0, -0.34f, 0}, {0, -0.4f, 0.2f}, {0, -0.4f, reach}, {0, -0.22f, reach}}, 0.14f, 6),
             0.014f, 8);
    add_tube(a[f.iron], rounded({{0, -0.7f, 0}, {0, -0.68f, 0.3f}, {0, -0.42f, 0.55f}}, 0.2f, 5), 0.01f, 8);
    add_box(a[f.iron], {-0.05f, -0.75f, 0}, {0.05f, -0.28f, 0.012f}, {}, 0.004f);
    // Six panes between bars, a pointed hat above.
    constexpr int sides = 6;
    constexpr float bottom = -0.2f, top = 0.14f, low_radius = 0.085f, high_radius = 0.115f;
    const auto corner = [&](int i, float radius, float y) {
        const float phi = 2 * pi * float(i) / sides;
        return Vec3{radius * std::sin(phi), y, reach + radius * std::cos(phi)};
    };
    for (int i = 0; i < sides; ++i) {
        add_quad(a[f.lamp_glass],
                 {corner(i, low_radius * 0.9f, bottom + 0.03f), corner(i + 1, low_radius * 0.9f, bottom + 0.03f),
                  corner(i + 1, high_radius * 0.9f, top - 0.03f), corner(i, high_radius * 0.9f, top - 0.03f)},
                 {0, 1}, {1, 0});
        add_tube(a[f.iron], {corner(i, low_radius, bottom), corner(i, high_radius, top)}, 0.007f, 6);
        for (const auto& [radius, y] : {std::pair{low_radius, bottom + 0.02f}, std::pair{high_radius, top - 0.02f}})
            add_beam(a[f.iron], corner(i, radius, y), corner(i + 1, radius, y), {0, 1, 0}, 0.012f, 0.035f);
    }
    Shape hat;
    add_lathe(hat,
              {{0.14f, top - 0.02f},
               {0.15f, top},
               {0.1f, top + 0.06f},
               {0.05f, top + 0.11f},
               {0.045f, top + 0.15f},
               {0.06f, top + 0.16f},
               {0.02f, top + 0.2f},
               {0.012f, top + 0.26f},
               {0, top + 0.27f}},
              12, {0.5f, 0.4f});
    add_lathe(hat, {{0, bottom - 0.05f}, {0.05f, bottom - 0.03f}, {0.09f, bottom}, {0.09f, bottom + 0.012f}}, 12,
              {0.5f, 0.1f});
    append(a[f.iron], hat, translate({0, 0, reach}));
    return a;
}

Assembly paper_lantern(const Finishes& f, bool red) {
    Assembly a;
    constexpr float half = 0.21f, radius = 0.145f, drop = 0.34f;
    // Ribs bulge: each is a small step of the profile, which the low sun and wet paper show.
    std::vector<Vec2> barrel;
    constexpr int steps = 12;
    for (int i = 0; i <= steps; ++i) {
        const float t = -1 + 2 * float(i) / steps;
        barrel.push_back({0.075f + (radius - 0.075f) * std::pow(1 - std::pow(std::abs(t), 2.6f), 0.5f), t * half});
    }
    Shape paper, rings;
    add_lathe(paper, barrel, 18, {1, 1});
    // A column of writing lies a quarter turn from the start of the picture: it faces the front.
    append(a[red ? f.red_lantern : f.white_lantern], paper, translate({0, -drop, 0}) * rotate_y(-std::numbers::pi / 2));
    for (const float side : {-1.0f, 1.0f})
        add_lathe(rings,
                  {{0.06f, side * half - 0.02f},
                   {0.088f, side * half - 0.02f},
                   {0.088f, side * half + 0.02f},
                   {0.06f, side * half + 0.02f}},
                  16, {0.5f, 0.1f});
    append(a[f.rubber], rings, translate({0, -drop, 0}));
    add_tube(a[f.rubber], {{0, 0, 0}, {0, -drop + half + 0.1f, 0}}, 0.004f, 5);
    add_tube(a[f.rubber],
             rounded({{-0.07f, -drop + half, 0},
                      {-0.03f, -drop + half + 0.1f, 0},
                      {0.03f, -drop + half + 0.1f, 0},
                      {0.07f, -drop + half, 0}},
                     0.03f),
             0.003f, 5);
    return a;
}

Assembly floor_lantern(const Finishes& f) {
    Assembly a;
    constexpr float half = 0.13f, bottom = 0.1f, top = 0.58f;
    for (const float x : {-half, half})
        for (const float z : {-half, half})
            add_box(a[f.dark_wood], {x - 0.013f, 0, z - 0.013f}, {x + 0.013f, top + 0.03f, z + 0.013f}, {}, 0.003f);
    for (const float y : {bottom, 0.5f * (bottom + top), top})
        for (const float side : {-half, half}) {
            add_box(a[f.dark_wood], {-half, y - 0.009f, side - 0.009f}, {half, y + 0.009f, side + 0.009f});
            add_box(a[f.dark_wood], {side - 0.009f, y - 0.009f, -half}, {side + 0.009f, y + 0.009f, half});
        }
    add_box(a[f.dark_wood], {-half - 0.03f, top + 0.03f, -half - 0.03f}, {half + 0.03f, top + 0.05f, half + 0.03f}, {},
            0.006f);
    for (int i = 0; i < 4; ++i) {
        Shape sheet;
        add_quad(sheet,
                 {Vec3{-half, bottom, half - 0.004f},
                  {half, bottom, half - 0.004f},
                  {half, top, half - 0.004f},
                  {-half, top, half - 0.004f}},
                 {0.1f, 1}, {0.4f, 0});  // one of the lantern's columns of writing
        append(a[f.white_lantern], sheet, rotate_y(i * std::numbers::pi / 2));
    }
    return a;
}

Assembly standing_sign(const Finishes& f, bool tall) {
    Assembly a;
    const float half = tall ? 0.19f : 0.29f, bottom = tall ? 0.22f : 0.42f, top = tall ? 1.36f : 1.29f;
    add_two_sided(a[tall ? f.lit_sign_tall : f.lit_sign], half - 0.02f, bottom + 0.02f, top - 0.02f, 0.055f);
    add_frame(a[f.iron], {-half, bottom, -0.065f}, {half, top, 0.065f}, 0.026f);
    for (const float x : {-half + 0.05f, half - 0.05f}) {
        add_tube(a[f.iron], {{x, bottom, 0}, {x, 0.06f, 0}}, 0.012f, 8);
        add_tube(a[f.iron],
                 rounded({{x, 0.02f, -0.2f}, {x, 0.07f, -0.17f}, {x, 0.07f, 0.17f}, {x, 0.02f, 0.2f}}, 0.04f), 0.012f,
                 8);
        for (const float z : {-0.2f, 0.2f})
            add_tube(a[f.rubber], {{x - 0.012f, 0.028f, z}, {x + 0.012f, 0.028f, z}}, 0.028f, 12);
    }
    add_tube(a[f.iron], {{-half + 0.05f, 0.2f, 0}, {half - 0.05f, 0.2f, 0}}, 0.01f, 8);
    return a;
}

Assembly box_sign(const Finishes& f) {
    Assembly a;
    constexpr float reach = 0.42f, width = 0.36f, bottom = -0.72f;
    Shape panel, frame;
    add_two_sided(panel, 0.5f * width - 0.015f, bottom + 0.015f, -0.015f, 0.065f);
    add_frame(frame, {-0.5f * width, bottom, -0.075f}, {0.5f * width, 0, 0.075f}, 0.022f);
    const Transform projecting = translate({0, 0, reach}) * rotate_y(std::numbers::pi / 2);
    append(a[f.lit_sign_box], panel, projecting);
    append(a[f.iron], frame, projecting);
    for (const float y : {-0.1f, bottom + 0.1f})
        add_tube(a[f.iron], {{0, y, 0}, {0, y, reach - 0.5f * width}}, 0.012f, 8);
    return a;
}

}  // namespace pluvia::lane
