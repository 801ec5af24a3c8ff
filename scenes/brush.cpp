#include "scenes/brush.h"

#include "scenes/noise.h"

#include "renderer/core/error.h"
#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace pluvia {
namespace {

/// Strokes of a character in a box of 100 x 100, y downwards: points "x,y", strokes apart by "|".
const std::map<std::string, const char*>& characters() {
    static const std::map<std::string, const char*> table = {
        {"yama", "50,10 50,84 | 16,42 16,85 84,85 | 84,40 84,90"},
        {"kawa", "20,14 20,58 10,90 | 50,16 50,82 | 82,10 82,94"},
        {"ki", "10,36 90,36 | 50,8 50,94 | 48,38 32,62 10,80 | 52,38 68,62 92,80"},
        {"hon", "10,36 90,36 | 50,8 50,94 | 48,38 32,62 10,80 | 52,38 68,62 92,80 | 34,76 66,76"},
        {"ta", "18,18 18,88 | 18,18 82,18 82,88 | 50,18 50,86 | 18,52 82,52 | 18,86 82,86"},
        {"dai", "10,36 90,36 | 50,8 48,40 36,68 10,92 | 50,40 66,70 92,90"},
        {"i", "14,32 86,32 | 8,64 92,64 | 34,12 34,64 20,92 | 66,10 66,92"},
        {"san", "20,20 80,20 | 26,50 74,50 | 10,84 90,84"},
        {"ko", "50,8 50,86 38,78 | 28,36 12,68 | 70,34 90,64"},
        {"tsuki", "28,12 28,60 14,92 | 28,12 78,12 78,90 66,84 | 28,38 76,38 | 28,62 76,62"},
        {"hana",
         "10,22 90,22 | 34,8 34,34 | 66,8 66,34 | 36,38 12,68 | 26,56 26,94 | 84,44 56,62 | "
         "56,38 56,84 66,90 90,88 90,74"},
        {"cha",
         "8,20 92,20 | 34,8 34,32 | 66,8 66,32 | 50,30 32,46 8,58 | 50,30 68,46 92,58 | 24,64 76,64 | "
         "50,50 50,94 40,88 | 38,72 22,88 | 62,72 78,88"},
        {"sake",
         "12,14 22,24 | 8,38 18,48 | 22,62 8,90 | 32,16 94,16 | 38,34 38,92 | 38,34 90,34 90,92 | "
         "56,16 56,48 46,58 | 72,16 72,52 86,52 | 38,70 90,70 | 38,90 90,90"},
        {"ishi", "12,18 88,18 | 46,18 32,50 10,74 | 34,50 34,90 | 34,50 82,50 82,90 | 34,88 82,88"},
        {"no", "54,20 46,56 30,78 16,70 14,46 30,24 56,18 80,32 86,56 74,80 58,88"},
        {"ya", "10,50 40,34 74,26 88,40 78,56 60,56 | 46,10 56,22 | 26,24 44,60 56,92"},
    };
    return table;
}

std::vector<std::vector<Vec2>> strokes_of(const std::string& name) {
    const auto found = characters().find(name);
    if (found == characters().end())
        throw input_error("brush", "character is not known (got \"" + name + "\", expected one of brush.cpp)");
    std::vector<std::vector<Vec2>> strokes(1);
    std::istringstream words(found->second);
    for (std::string word; words >> word;) {
        if (word == "|")
            strokes.emplace_back();
        else
            strokes.back().push_back({float(std::stoi(word)), float(std::stoi(word.substr(word.find(',') + 1)))});
    }
    return strokes;
}

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

/// Curve through four points, between b and c. Source: Catmull and Rom 1974, uniform, tension 1/2.
Vec2 spline(Vec2 a, Vec2 b, Vec2 c, Vec2 d, float t) {
    return (b * 2.0f + (c - a) * t + (a * 2.0f - b * 5.0f + c * 4.0f - d) * (t * t) +
            (b * 3.0f - a - c * 3.0f + d) * (t * t * t)) *
           0.5f;
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

void draw_ring(Ink& ink, Vec2 centre, float radius, float width) {
    if (width <= 0) return stamp(ink, centre, radius);
    const int steps = int(8 * radius / width) + 16;
    for (int k = 0; k < steps; ++k) {
        const float phi = 2 * pi * float(k) / float(steps);
        stamp(ink, centre + Vec2{std::cos(phi), std::sin(phi)} * radius, 0.5f * width);
    }
}

}  // namespace pluvia
