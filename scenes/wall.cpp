#include "scenes/wall.h"

#include "scenes/assembly.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

float Opening::head(float x) const {
    if (rise <= 0) return top;
    const float s = std::clamp((x - middle()) / (0.5f * width()), -1.0f, 1.0f);
    return top - rise + rise * std::sqrt(std::max(0.0f, 1 - s * s));
}

Opening Opening::inset(float margin) const {
    return {left + margin, right - margin, bottom, top - margin, rise > margin ? rise - 0.3f * margin : rise};
}

namespace {

/// x of the ends of the pieces of an opening's head.
std::vector<float> head_steps(const Opening& o) {
    if (o.rise <= 0) return {o.left, o.right};
    std::vector<float> xs;
    for (int i = 0; i <= arch_pieces; ++i)  // equal angles, so that the steep ends are as smooth as the crown
        xs.push_back(o.middle() - 0.5f * o.width() * std::cos(float(std::numbers::pi) * float(i) / arch_pieces));
    xs.front() = o.left, xs.back() = o.right;
    return xs;
}

}  // namespace

void add_wall(Shape& shape, Vec2 lower, Vec2 upper, float z, const std::vector<Opening>& openings, const Tint& tint) {
    std::vector<float> cuts = {lower.x, upper.x};
    for (const Opening& o : openings)
        for (const float x : head_steps(o)) cuts.push_back(x);
    std::sort(cuts.begin(), cuts.end());
    for (size_t i = 1; i < cuts.size(); ++i) {
        const float x0 = cuts[i - 1], x1 = cuts[i];
        if (x1 - x0 < 1e-5f) continue;
        std::vector<const Opening*> above;  // openings that this strip meets, from below
        for (const Opening& o : openings)
            if (o.left < x0 + 1e-5f && o.right > x1 - 1e-5f) above.push_back(&o);
        std::sort(above.begin(), above.end(), [](auto a, auto b) { return a->bottom < b->bottom; });
        float y0 = lower.y, y1 = lower.y;  // lower edge at x0 and x1
        const auto close = [&](float top) {
            if (top - std::max(y0, y1) > 1e-5f)
                add_facet(shape, {Vec3{x0, y0, z}, {x1, y1, z}, {x1, top, z}, {x0, top, z}}, tint);
        };
        for (const Opening* o : above) {
            close(o->bottom);
            y0 = o->head(x0), y1 = o->head(x1);
        }
        close(upper.y);
    }
}

void add_reveal(Shape& shape, const Opening& o, float front, float back, const Tint& tint) {
    const float spring = o.top - o.rise;
    add_facet(
        shape,
        {Vec3{o.left, o.bottom, front}, {o.left, o.bottom, back}, {o.left, spring, back}, {o.left, spring, front}},
        tint);
    add_facet(
        shape,
        {Vec3{o.right, o.bottom, back}, {o.right, o.bottom, front}, {o.right, spring, front}, {o.right, spring, back}},
        tint);
    add_facet(shape,
              {Vec3{o.left, o.bottom, front},
               {o.right, o.bottom, front},
               {o.right, o.bottom, back},
               {o.left, o.bottom, back}},
              tint);
    const auto xs = head_steps(o);
    for (size_t i = 1; i < xs.size(); ++i) {
        const float x0 = xs[i - 1], x1 = xs[i];
        add_facet(
            shape,
            {Vec3{x0, o.head(x0), back}, {x1, o.head(x1), back}, {x1, o.head(x1), front}, {x0, o.head(x0), front}},
            tint);
    }
}

void add_head_stones(Shape& shape, const Opening& o, float depth, float z, float out, int count, float grey) {
    Chance chance{uint64_t(o.left * 1000) + uint64_t(o.top * 77777)};
    const float half = 0.5f * o.width(), spring = o.top - o.rise;
    for (int i = 0; i < count; ++i) {
        const auto at = [&](float t, float up) {
            if (o.rise > 0) {  // along the ellipse, stones pointing to its middle
                const float phi = float(std::numbers::pi) * (1 - t);
                return Vec2{o.middle() + (half + up) * std::cos(phi), spring + (o.rise + up) * std::sin(phi)};
            }
            // A flat arch fans out by a fifth of its depth at the ends.
            return Vec2{o.left + t * o.width() + (t - 0.5f) * 0.45f * up, o.top + up};
        };
        const float gap = 0.004f / std::max(o.width(), 0.3f);
        const float t0 = float(i) / float(count) + gap, t1 = float(i + 1) / float(count) - gap;
        const float proud = out + chance(0, 0.006f) + (i == count / 2 ? 0.025f : 0.0f);
        const float rise = depth + (i == count / 2 ? 0.04f : 0.0f);
        const Vec2 a = at(t0, 0), b = at(t1, 0), c = at(t1, rise), d = at(t0, rise);
        const float shade = grey * chance(0.8f, 1.05f), u = chance(0, 2), v = chance(0, 2);
        const Tint tint = {Rgb(shade), {u, v}};
        const auto lift = [&](Vec2 p, float height) { return Vec3(p.x, p.y, z + height); };
        const Vec2 centre = (a + b + c + d) * 0.25f;
        const auto in = [&](Vec2 p) {  // chamfer
            const Vec2 to = centre - p;
            return p + to * (0.012f / std::max(0.02f, std::hypot(to.x, to.y)));
        };
        const Vec2 corners[4] = {a, b, c, d};
        add_facet(shape, {lift(in(a), proud), lift(in(b), proud), lift(in(c), proud), lift(in(d), proud)}, tint);
        for (int k = 0; k < 4; ++k) {
            const Vec2 p = corners[k], q = corners[(k + 1) % 4];
            add_facet(shape, {lift(p, proud - 0.01f), lift(q, proud - 0.01f), lift(in(q), proud), lift(in(p), proud)},
                      tint);
            add_facet(shape, {lift(p, -0.02f), lift(q, -0.02f), lift(q, proud - 0.01f), lift(p, proud - 0.01f)}, tint);
        }
    }
}

void add_architrave(Shape& shape, const Opening& o, float width, float back, float front, const Tint& tint) {
    // Inner and outer line from the lower left around the head to the lower right.
    std::vector<Vec2> inner = {{o.left, o.bottom}}, outer = {{o.left - width, o.bottom}};
    if (o.rise > 0) {
        for (int i = 0; i <= arch_pieces; ++i) {
            const float phi = float(std::numbers::pi) * (1 - float(i) / arch_pieces);
            const float c = std::cos(phi), s = std::sin(phi);
            inner.push_back({o.middle() + 0.5f * o.width() * c, o.top - o.rise + o.rise * s});
            outer.push_back({o.middle() + (0.5f * o.width() + width) * c, o.top - o.rise + (o.rise + width) * s});
        }
    } else {
        inner.insert(inner.end(), {{o.left, o.top}, {o.right, o.top}});
        outer.insert(outer.end(), {{o.left - width, o.top + width}, {o.right + width, o.top + width}});
    }
    inner.push_back({o.right, o.bottom});
    outer.push_back({o.right + width, o.bottom});
    const float bevel = std::min(0.012f, 0.2f * width);
    for (size_t i = 1; i < inner.size(); ++i) {
        const auto at = [](Vec2 p, float z) { return Vec3(p.x, p.y, z); };
        const auto between = [&](size_t k, float t) { return inner[k] + (outer[k] - inner[k]) * t; };
        const float t = bevel / width;
        const size_t j = i - 1;
        add_facet(shape,
                  {at(between(i, t), front), at(between(j, t), front), at(between(j, 1 - t), front),
                   at(between(i, 1 - t), front)},
                  tint);
        add_facet(shape,
                  {at(inner[i], front - bevel), at(inner[j], front - bevel), at(between(j, t), front),
                   at(between(i, t), front)},
                  tint);
        add_facet(shape,
                  {at(between(i, 1 - t), front), at(between(j, 1 - t), front), at(outer[j], front - bevel),
                   at(outer[i], front - bevel)},
                  tint);
        add_facet(shape,
                  {at(inner[i], back), at(inner[j], back), at(inner[j], front - bevel), at(inner[i], front - bevel)},
                  tint);
        add_facet(shape,
                  {at(outer[i], front - bevel), at(outer[j], front - bevel), at(outer[j], back), at(outer[i], back)},
                  tint);
    }
}

}  // namespace pluvia
