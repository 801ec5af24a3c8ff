#include "scenes/moulding.h"

#include "scenes/assembly.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

void add_moulding(Shape& shape, const std::vector<Vec2>& profile, float x0, float x1, float back, const Tint& tint) {
    for (size_t i = 1; i < profile.size(); ++i) {
        const Vec2 a = profile[i - 1], b = profile[i];
        add_facet(shape, {Vec3{x0, a.y, a.x}, {x1, a.y, a.x}, {x1, b.y, b.x}, {x0, b.y, b.x}}, tint);
        if (b.y - a.y < 1e-5f || std::max(a.x, b.x) - back < 1e-5f) continue;
        add_facet(shape, {Vec3{x0, a.y, back}, {x0, a.y, a.x}, {x0, b.y, b.x}, {x0, b.y, back}}, tint);
        add_facet(shape, {Vec3{x1, a.y, a.x}, {x1, a.y, back}, {x1, b.y, back}, {x1, b.y, b.x}}, tint);
    }
}

void add_sill(Shape& shape, float x0, float x1, float y, float out, float height, const Tint& tint) {
    add_moulding(shape,
                 {{0, y - height},
                  {out - 0.012f, y - height},
                  {out, y - height + 0.012f},
                  {out, y - 0.022f},
                  {out - 0.01f, y - 0.012f},
                  {-0.1f, y + 0.006f}},
                 x0, x1, -0.1f, tint);
}

void add_band(Shape& shape, float x0, float x1, float y0, float y1, float out, const Tint& tint) {
    const float bevel = std::min(0.02f, 0.5f * out);
    add_moulding(shape,
                 {{0, y0}, {out - bevel, y0}, {out, y0 + bevel}, {out, y1 - bevel}, {out - bevel, y1}, {0, y1 + 0.01f}},
                 x0, x1, 0, tint);
}

float add_cornice(Shape& shape, float x0, float x1, float y, float out, float pitch, const Tint& tint) {
    // Architrave, frieze, dentils, corona and cyma, in tenths of the projection.
    const float u = 0.1f * out;
    add_band(shape, x0, x1, y, y + 2.2f * u, 1.2f * u, tint);
    add_moulding(shape, {{0.4f * u, y + 2.2f * u}, {0.4f * u, y + 7 * u}}, x0, x1, -0.05f, tint);
    const float d = y + 7 * u;
    std::vector<Vec2> crown = {
        {0.4f * u, d},         {1.6f * u, d + 0.4f * u}, {1.6f * u, d + 2.2f * u}, {2.6f * u, d + 2.8f * u},
        {8 * u, d + 3.0f * u}, {8.2f * u, d + 3.2f * u}, {8.2f * u, d + 5.0f * u}};
    for (int i = 1; i <= 6; ++i) {  // cyma recta
        const float t = float(i) / 6;
        crown.push_back({(8.2f + 1.8f * (t - 0.09f * std::sin(2 * 3.14159f * t))) * u, d + (5.0f + 2.4f * t) * u});
    }
    crown.push_back({10 * u, d + 8 * u});
    crown.push_back({-0.3f, d + 8.6f * u});
    add_moulding(shape, crown, x0, x1, -0.3f, tint);
    Chance chance{uint64_t(x1 * 100)};
    const int dentils = int((x1 - x0) / (2.4f * u));
    for (int i = 0; i < dentils; ++i) {
        const float x = x0 + (x1 - x0) * (float(i) + 0.25f) / float(dentils), w = 0.5f * (x1 - x0) / float(dentils);
        add_box(shape, {x, d + 0.5f * u, 1.5f * u}, {x + w, d + 2.2f * u, 2.6f * u}, chance.tint(0.12f), 0.006f);
    }
    const int brackets = std::max(2, int((x1 - x0) / pitch));
    for (int i = 0; i <= brackets; ++i) {  // scrolled consoles
        const float half = 0.9f * u, x = std::clamp(x0 + (x1 - x0) * float(i) / float(brackets), x0 + half, x1 - half);
        const float top = d + 2.9f * u, bottom = y + 1.5f * u;
        std::vector<Vec2> scroll = {{0.4f * u, bottom}};
        for (int k = 0; k <= 8; ++k) {
            const float t = float(k) / 8;
            scroll.push_back({(1.8f + 5.4f * t * t + 0.5f * std::sin(6.28f * t)) * u, bottom + (top - bottom) * t});
        }
        add_moulding(shape, scroll, x - half, x + half, 0.3f * u, chance.tint(0.12f));
    }
    return d + 8.6f * u;
}

void add_quoins(Shape& shape, float x, float sign, float y0, float y1, float out) {
    const int count = std::max(1, int((y1 - y0) / 0.36f));
    Chance chance{uint64_t(std::abs(x) * 1000) + uint64_t(y1 * 10)};
    for (int i = 0; i < count; ++i) {
        const float bottom = y0 + (y1 - y0) * float(i) / float(count),
                    top = y0 + (y1 - y0) * float(i + 1) / float(count);
        const float reach = sign * (i % 2 == 0 ? 0.52f : 0.34f);
        add_box(shape, {std::min(x, x + reach), bottom + 0.006f, -0.05f}, {std::max(x, x + reach), top - 0.006f, out},
                chance.tint(0.22f), 0.018f);
    }
}

}  // namespace pluvia
