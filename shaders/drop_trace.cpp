#include "shaders/drop_trace.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pluvia {
namespace {

/// How far a point is outside of the unstretched shape (negative inside), and the gradient of that.
struct Level {
    float value;
    Vec3 gradient;
};

Level level_at(const DropShape& s, Vec3 p) {
    const float r = length(p);
    const Vec3 n = p / r;
    const float along = n.x * s.cos_phi + n.z * s.sin_phi;  // sin theta cos(phi - phi_drop)
    const float q = 1.5f * (5 * n.y * n.y - 1);
    const float radius = 1 + s.a2 * (1.5f * n.y * n.y - 0.5f) + s.a3 * q * along;
    const Vec3 slope(s.a3 * q * s.cos_phi, 3 * s.a2 * n.y + 15 * s.a3 * n.y * along, s.a3 * q * s.sin_phi);
    return {r - radius, n - (slope - n * dot(n, slope)) / r};
}

/// Where a line enters (side = -1) or leaves (+1) the shape: the line's parameter, by Newton's method. Empty where the
/// line misses. Unstretched frame.
std::optional<float> crossing(const DropShape& shape, Vec3 origin, Vec3 direction, float side) {
    const float a = length_squared(direction), b = dot(origin, direction), c = length_squared(origin);
    const auto at_radius = [&](float radius) {
        const float discriminant = b * b - a * (c - radius * radius);
        return discriminant > 0 ? std::optional((-b + side * std::sqrt(discriminant)) / a) : std::nullopt;
    };
    const auto polish = [&](float t, int steps) -> std::optional<float> {
        for (int i = 0; i < steps; ++i) {
            const Level level = level_at(shape, origin + direction * t);
            const float slope = dot(level.gradient, direction);
            if (!(slope * side > 0)) return std::nullopt;  // past the nearest point
            const float step = level.value / slope;
            t -= step;
            if (std::abs(step) < 1e-3f) return t;  // and now the level is below 1e-6
        }
        return std::nullopt;
    };
    if (shape.a2 == 0 && shape.a3 == 0) return at_radius(1);
    if (const auto near = at_radius(1))
        if (const auto t = polish(*near, 4)) return t;
    // Close to the silhouette only from outside does every step come nearer.
    if (const auto outside = at_radius(shape.largest_radius())) return polish(*outside, 30);
    return std::nullopt;
}

/// Light of a ray as coherence of its electric field along axis and along cross(direction, axis); what is polarised
/// circularly is left out, since it turns into nothing else but under total reflection.
struct Beam {
    Vec3 direction, axis;
    float s, p, sp;

    float power() const { return s + p; }
    void turn_to(Vec3 new_axis) {
        float c = dot(axis, new_axis), d = dot(cross(direction, axis), new_axis);
        const float size = std::hypot(c, d);  // 1 but for rounding
        c /= size, d /= size;
        const float old_s = s, old_p = p, old_sp = sp;
        s = std::clamp(c * c * old_s + d * d * old_p + 2 * c * d * old_sp, 0.0f, old_s + old_p);
        p = old_s + old_p - s;
        sp = c * d * (old_p - old_s) + (c * c - d * d) * old_sp;
        axis = new_axis;
    }
};

struct Split {
    Beam reflected, transmitted;  // transmitted has no power under total reflection
};

/// normal: unit, against the beam; eta: index of the far side over that of the near side.
Split split(Beam beam, Vec3 normal, float eta) {
    const float cos_i = std::clamp(-dot(beam.direction, normal), 0.0f, 1.0f);
    const Vec3 across = cross(beam.direction, normal);
    const float sin_i = length(across);
    if (sin_i > 1e-3f) beam.turn_to(across / sin_i);  // below, both polarisations are reflected alike
    const float cos_t_squared = 1 - (1 - cos_i * cos_i) / (eta * eta);
    Split result{beam, beam};
    Beam& r = result.reflected;
    Beam& t = result.transmitted;
    r.direction = normalize(beam.direction + normal * (2 * cos_i));
    if (cos_t_squared <= 0) {
        // The reflected polarisations are out of step. Source: Born and Wolf 1999, section 1.5.4, equation 60.
        const float half = cos_i * std::sqrt(std::max(0.0f, sin_i * sin_i - eta * eta)) / (sin_i * sin_i);
        r.sp *= (1 - half * half) / (1 + half * half);
        t.s = t.p = t.sp = 0;
        return result;
    }
    const float cos_t = std::sqrt(cos_t_squared);
    const float rs = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    const float rp = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    r.s *= rs * rs, r.p *= rp * rp, r.sp *= rs * rp;
    const float ts = std::max(0.0f, 1 - rs * rs), tp = std::max(0.0f, 1 - rp * rp);
    t.s *= ts, t.p *= tp, t.sp *= std::sqrt(ts * tp);
    t.direction = normalize(beam.direction / eta + normal * (cos_i / eta - cos_t));
    return result;
}

}  // namespace

DropExits trace_drop(const DropShape& shape, Vec3 origin, Vec3 direction, float tail) {
    const Vec3 shrink(1 / shape.half_width, 1 / shape.half_height, 1 / shape.half_width);
    const Vec3 stretch(shape.half_width, shape.half_height, shape.half_width);
    DropExits exits;
    Vec3 from = origin * shrink;
    const auto entry = crossing(shape, from, direction * shrink, -1);
    if (!entry) return exits;
    from = from + direction * shrink * *entry;
    const auto outward = [&](Vec3 p) { return normalize(level_at(shape, p).gradient * shrink); };

    Beam beam{direction, Vec3(), 0.5f, 0.5f, 0};
    beam.axis = std::abs(direction.x) < 0.9f ? normalize(cross(direction, Vec3(1, 0, 0)))
                                             : normalize(cross(direction, Vec3(0, 1, 0)));
    Split parts = split(beam, outward(from), water_ior);
    exits.add(parts.reflected.direction, parts.reflected.power());
    beam = parts.transmitted;
    // Some rays are reflected totally again and again; what they hold after many times leaves anywhere.
    constexpr int most_reflections = 40;
    for (int i = 0; i < most_reflections; ++i) {
        const Vec3 way = beam.direction * shrink;
        const auto exit = crossing(shape, from, way, 1);
        // Rounding may leave the ray nothing to cross where it only touches the surface: it goes on as it is.
        if (!exit) break;
        from = from + way * *exit;
        parts = split(beam, -outward(from), 1 / water_ior);
        if (parts.transmitted.power() > 0) {
            const float inside = parts.reflected.power();
            const bool last = inside < tail || exits.room() == 1;
            exits.add(parts.transmitted.direction, parts.transmitted.power() + (last ? inside : 0));
            if (last) return exits;
        }
        beam = parts.reflected;
    }
    exits.add(beam.direction, beam.power());
    return exits;
}

}  // namespace pluvia
