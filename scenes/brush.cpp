#include "scenes/brush.h"

#include "scenes/characters.h"
#include "scenes/noise.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

void stamp(Ink& ink, Vec2 centre, float radius) {
    const int x0 = std::max(0, int(centre.x - radius - 1)), x1 = std::min(ink.width - 1, int(centre.x + radius + 1));
    const int y0 = std::max(0, int(centre.y - radius - 1)), y1 = std::min(ink.height - 1, int(centre.y + radius + 1));
    for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) {
            const float d = std::hypot(float(x) + 0.5f - centre.x, float(y) + 0.5f - centre.y);
            float& value = ink.at(x, y);
            value = std::max(value, std::clamp(radius - d + 0.5f, 0.0f, 1.0f));
        }
}

float distance(Vec2 a, Vec2 b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

/// A brush presses where it sets down, thins out on its way and leaves in a point or a stop.
void brush_stroke(Ink& ink, const std::vector<Vec2>& points, float width) {
    float total = 0, walked = 0;
    for (size_t i = 1; i < points.size(); ++i) total += distance(points[i - 1], points[i]);
    for (size_t i = 1; i < points.size(); ++i) {
        const Vec2 b = points[i - 1], c = points[i];
        const Vec2 a = i > 1 ? points[i - 2] : b, d = i + 1 < points.size() ? points[i + 1] : c;
        // Right angles stay corners: the brush stops and turns there.
        const Vec2 in = b - a, out = c - b, next = d - c;
        const bool curved = in.x * out.x + in.y * out.y > 0.35f * distance(a, b) * distance(b, c) ||
                            out.x * next.x + out.y * next.y > 0.35f * distance(b, c) * distance(c, d);
        const int steps = std::max(2, int(distance(b, c) / std::max(0.5f, 0.1f * width)));
        for (int k = 0; k <= steps; ++k) {
            const float t = float(k) / float(steps);
            const Vec2 p = curved ? spline(a, b, c, d, t) : b + (c - b) * t;
            const float s = (walked + t * distance(b, c)) / total;
            const float pressure =
                0.72f + 0.28f * bump(s, 0.25f) + 0.2f * bump(s - 0.93f, 0.12f) - 0.35f * smooth_step(0.96f, 1, s);
            stamp(ink, p, 0.5f * width * pressure);
        }
        walked += distance(b, c);
    }
}

}  // namespace

void write_glyph(Ink& ink, const std::string& name, Vec2 corner, float size, float weight) {
    for (std::vector<Vec2> stroke : strokes_of(name)) {
        for (Vec2& p : stroke) p = corner + p * (0.01f * size);
        brush_stroke(ink, stroke, weight * size);
    }
}

void write_column(Ink& ink, const std::vector<std::string>& names, float x, float top, float bottom, float weight) {
    const float pitch = (bottom - top) / float(names.size()), size = 0.88f * pitch;
    for (size_t i = 0; i < names.size(); ++i)
        write_glyph(ink, names[i], {x - 0.5f * size, top + (float(i) + 0.06f) * pitch}, size, weight);
}

void draw_line(Ink& ink, Vec2 from, Vec2 to, float width) {
    const int steps = std::max(1, int(2 * distance(from, to) / std::max(width, 1.0f)) * 2);
    for (int k = 0; k <= steps; ++k) stamp(ink, from + (to - from) * (float(k) / float(steps)), 0.5f * width);
}

void write_text(Ink& ink, const std::string& text, Vec2 centre, float height, float width) {
    const float left = centre.x - 0.5f * text_width(text, height), bottom = centre.y + 0.5f * height;
    for (const Stroke& path : text_paths(text, height))
        for (size_t i = 1; i < path.size(); ++i)
            draw_line(ink, {left + path[i - 1].x, bottom - path[i - 1].y}, {left + path[i].x, bottom - path[i].y},
                      width);
}

void draw_ring(Ink& ink, Vec2 centre, float radius, float width) {
    if (width <= 0) return stamp(ink, centre, radius);
    const int steps = int(8 * radius / width) + 16;
    for (int k = 0; k < steps; ++k) {
        const float phi = 2 * pi * float(k) / float(steps);
        stamp(ink, centre + Vec2{std::cos(phi), std::sin(phi)} * radius, 0.5f * width);
    }
}

}  // namespace pluvia
