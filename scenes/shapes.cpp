#include "scenes/shapes.h"

#include "renderer/core/units.h"

#include <algorithm>

namespace pluvia {
namespace {

uint32_t add_vertex(Shape& shape, Vec3 position, Vec3 normal, Vec2 uv, const Tint& tint) {
    shape.positions.push_back(position);
    shape.normals.push_back(normal);
    shape.uvs.push_back(uv + tint.uv_offset);
    shape.colors.push_back(tint.color);
    return uint32_t(shape.positions.size()) - 1;
}

/// Quadrilateral with a uv at each corner; a corner may coincide with its neighbour.
void add_face(Shape& shape, const std::array<Vec3, 4>& p, const std::array<Vec2, 4>& uv, const Tint& tint) {
    const Vec3 normal = normalize(cross(p[2] - p[0], p[3] - p[1]));
    uint32_t index[4];
    for (int k = 0; k < 4; ++k) index[k] = add_vertex(shape, p[k], normal, uv[k], tint);
    const auto add = [&](int a, int b, int c) {
        if (length(cross(p[b] - p[a], p[c] - p[a])) > 1e-10f) shape.triangles.push_back({index[a], index[b], index[c]});
    };
    add(0, 1, 2);
    add(0, 2, 3);
}

/// Face of a box or beam: uv are the metres along two of its axes, v against the grain's direction.
void add_grained_face(Shape& shape, const std::array<Vec3, 4>& p, Vec3 grain, Vec3 normal_hint, const Tint& tint) {
    const Vec3 edge = p[1] - p[0], other = p[3] - p[0];
    const bool grain_in_face = std::abs(dot(normal_hint, grain)) < 0.9f;
    const Vec3 v_axis = grain_in_face ? grain : normalize(length_squared(edge) > length_squared(other) ? edge : other);
    const Vec3 u_axis = normalize(cross(v_axis, normal_hint));
    std::array<Vec2, 4> uv;
    for (int k = 0; k < 4; ++k) uv[k] = {dot(p[k], u_axis), -dot(p[k], v_axis)};
    add_face(shape, p, uv, tint);
}

Vec3 unit_axis(int axis) {
    Vec3 v;
    v[axis] = 1;
    return v;
}

/// Regular grid of vertices, columns + 1 by rows + 1, already appended from `first` on.
void connect_grid(Shape& shape, uint32_t first, int columns, int rows) {
    const uint32_t stride = uint32_t(columns) + 1;
    for (uint32_t j = 0; j < uint32_t(rows); ++j)
        for (uint32_t i = 0; i < uint32_t(columns); ++i) {
            const uint32_t a = first + j * stride + i;
            // Where a grid closes to a point (the pole of a globe) one of the two triangles has no area.
            const auto add = [&](uint32_t b, uint32_t c, uint32_t d) {
                const Vec3 p = shape.positions[b];
                if (length(cross(shape.positions[c] - p, shape.positions[d] - p)) > 1e-10f)
                    shape.triangles.push_back({b, c, d});
            };
            add(a, a + 1, a + stride + 1);
            add(a, a + stride + 1, a + stride);
        }
}

}  // namespace

void append(Shape& shape, const Shape& part, const Transform& shape_from_part) {
    const uint32_t first = uint32_t(shape.positions.size());
    const bool mirrored = shape_from_part.determinant() < 0;
    for (const Vec3 p : part.positions) shape.positions.push_back(Vec3(shape_from_part.point(Vec3d(p))));
    for (const Vec3 n : part.normals) {
        const Vec3 turned = Vec3(normalize(shape_from_part.normal(Vec3d(n))));
        shape.normals.push_back(mirrored ? -turned : turned);
    }
    shape.uvs.insert(shape.uvs.end(), part.uvs.begin(), part.uvs.end());
    shape.colors.insert(shape.colors.end(), part.colors.begin(), part.colors.end());
    for (const auto& [a, b, c] : part.triangles) {
        if (mirrored)
            shape.triangles.push_back({first + a, first + c, first + b});
        else
            shape.triangles.push_back({first + a, first + b, first + c});
    }
}

void add_quad(Shape& shape, const std::array<Vec3, 4>& corners, Vec2 uv_lower_left, Vec2 uv_upper_right,
              const Tint& tint) {
    const Vec2 a = uv_lower_left, c = uv_upper_right;
    add_face(shape, corners, {a, Vec2{c.x, a.y}, c, Vec2{a.x, c.y}}, tint);
}

void add_box(Shape& shape, Vec3 lower, Vec3 upper, const Tint& tint, float bevel) {
    const Vec3 size = upper - lower;
    const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const Vec3 grain = unit_axis(longest);
    // Corners: index bit 0 = x, 1 = y, 2 = z. The chamfer cuts back z of the outer and x, y of the inner front ring.
    const auto corner = [&](int bits) {
        return Vec3{bits & 1 ? upper.x : lower.x, bits & 2 ? upper.y : lower.y, bits & 4 ? upper.z - bevel : lower.z};
    };
    const auto inner = [&](int bits) {
        return Vec3{bits & 1 ? upper.x - bevel : lower.x + bevel, bits & 2 ? upper.y - bevel : lower.y + bevel,
                    upper.z};
    };
    const auto face = [&](const std::array<Vec3, 4>& p) {
        add_grained_face(shape, p, grain, normalize(cross(p[2] - p[0], p[3] - p[1])), tint);
    };
    face({corner(1), corner(0), corner(2), corner(3)});  // -z
    face({corner(0), corner(4), corner(6), corner(2)});  // -x
    face({corner(5), corner(1), corner(3), corner(7)});  // +x
    face({corner(0), corner(1), corner(5), corner(4)});  // -y
    face({corner(6), corner(7), corner(3), corner(2)});  // +y
    face({inner(4), inner(5), inner(7), inner(6)});      // +z
    if (bevel <= 0) return;
    for (const auto& [a, b] : std::array<std::array<int, 2>, 4>{{{4, 5}, {5, 7}, {7, 6}, {6, 4}}})
        face({corner(a), corner(b), inner(b), inner(a)});
}

void add_facet(Shape& shape, const std::array<Vec3, 4>& p, const Tint& tint) {
    const Vec3 n = normalize(cross(p[2] - p[0], p[3] - p[1]));
    std::array<Vec2, 4> uv;
    for (int k = 0; k < 4; ++k) {
        const Vec3 q = p[k];
        if (std::abs(n.y) > 0.8f)
            uv[k] = {q.x, q.z};
        else if (std::abs(n.z) >= std::abs(n.x))
            uv[k] = {n.z > 0 ? q.x : -q.x, -q.y};
        else
            uv[k] = {n.x > 0 ? -q.z : q.z, -q.y};
    }
    add_face(shape, p, uv, tint);
}

void add_block(Shape& shape, Vec3 a, Vec3 b, const Tint& tint) {
    add_facet(shape, {Vec3{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}, tint);
    add_facet(shape, {Vec3{b.x, a.y, a.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}}, tint);
    add_facet(shape, {Vec3{b.x, a.y, b.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}}, tint);
    add_facet(shape, {Vec3{a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}}, tint);
    add_facet(shape, {Vec3{a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}}, tint);
    add_facet(shape, {Vec3{a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}}, tint);
}

void add_plank(Shape& shape, Vec3 lower, Vec3 upper, float edge, const Tint& tint) {
    const float xs[4] = {lower.x, lower.x + edge, upper.x - edge, upper.x},
                zs[4] = {lower.z, upper.z, upper.z, lower.z};
    for (int k = 0; k < 3; ++k) {
        const Vec3 left = {xs[k], lower.y, zs[k]}, right = {xs[k + 1], lower.y, zs[k + 1]},
                   up = {0, upper.y - lower.y, 0};
        add_quad(shape, {left, right, right + up, left + up}, {xs[k], -lower.y}, {xs[k + 1], -upper.y}, tint);
    }
}

void add_beam(Shape& shape, Vec3 start, Vec3 end, Vec3 up, float width, float height, const Tint& tint) {
    const Vec3 along = normalize(end - start), across = normalize(cross(along, up)), top = cross(across, along);
    const float beam_length = length(end - start);
    Shape box;
    add_box(box, {-0.5f * width, 0, -0.5f * height}, {0.5f * width, beam_length, 0.5f * height}, tint);
    append(shape, box, {Vec3d(across), Vec3d(along), Vec3d(top), Vec3d(start)});
}

void add_sheet(Shape& shape, int columns, int rows, const std::function<SheetPoint(float s, float t)>& surface,
               const Tint& tint) {
    const uint32_t first = uint32_t(shape.positions.size());
    const auto point = [&](int i, int j) { return surface(float(i) / float(columns), float(j) / float(rows)); };
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i) {
            const Vec3 ds = point(std::min(i + 1, columns), j).position - point(std::max(i - 1, 0), j).position;
            const Vec3 dt = point(i, std::min(j + 1, rows)).position - point(i, std::max(j - 1, 0)).position;
            const SheetPoint p = point(i, j);
            add_vertex(shape, p.position, normalize(cross(ds, dt)), p.uv, tint);
        }
    connect_grid(shape, first, columns, rows);
}

void add_tube(Shape& shape, const std::vector<Vec3>& path, float radius, int sides, const Tint& tint) {
    add_tube(shape, path, std::vector<float>(path.size(), radius), sides, tint);
}

void add_tube(Shape& shape, const std::vector<Vec3>& path, const std::vector<float>& radii, int sides,
              const Tint& tint) {
    const auto direction = [&](size_t i) {
        return normalize(path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0]);
    };
    Vec3 side = ShadingBasis(direction(0)).tangent;
    const uint32_t first = uint32_t(shape.positions.size());
    float along = 0;
    for (size_t i = 0; i < path.size(); ++i) {
        const Vec3 d = direction(i);
        side = side - d * dot(side, d);  // carried along, so that the tube does not twist
        side = length_squared(side) > 1e-6f ? normalize(side) : ShadingBasis(d).tangent;
        const Vec3 other = cross(d, side);
        if (i > 0) along += length(path[i] - path[i - 1]);
        for (int k = 0; k <= sides; ++k) {
            const float phi = 2 * pi * float(k) / float(sides);
            const Vec3 n = side * std::cos(phi) + other * std::sin(phi);
            add_vertex(shape, path[i] + n * radii[i], n, {phi * radii[0], -along}, tint);
        }
    }
    connect_grid(shape, first, sides, int(path.size()) - 1);
    for (const bool at_end : {false, true}) {
        const size_t ring = first + (at_end ? (path.size() - 1) * size_t(sides + 1) : 0);
        const Vec3 d = at_end ? direction(path.size() - 1) : -direction(0);
        const float radius = at_end ? radii.back() : radii.front();
        const uint32_t base = uint32_t(shape.positions.size());
        for (int k = 0; k < sides; ++k) {
            const float phi = 2 * pi * float(k) / float(sides);
            add_vertex(shape, shape.positions[ring + k], d, Vec2{std::cos(phi), std::sin(phi)} * radius, tint);
        }
        for (int k = 1; k + 1 < sides; ++k) {
            if (at_end)
                shape.triangles.push_back({base, base + k, base + k + 1});
            else
                shape.triangles.push_back({base, base + k + 1, base + k});
        }
    }
}

void flatten_creases(Shape& shape) {
    for (auto& triangle : shape.triangles) {
        const auto [a, b, c] = triangle;
        const Vec3 n = cross(shape.positions[b] - shape.positions[a], shape.positions[c] - shape.positions[a]);
        if (dot(n, shape.normals[a] + shape.normals[b] + shape.normals[c]) > 0) continue;
        for (uint32_t& corner : triangle) {
            shape.positions.push_back(shape.positions[corner]);
            shape.normals.push_back(normalize(n));
            shape.uvs.push_back(shape.uvs[corner]);
            shape.colors.push_back(shape.colors[corner]);
            corner = uint32_t(shape.positions.size()) - 1;
        }
    }
}

std::vector<Vec3> rounded(const std::vector<Vec3>& path, float radius, int steps) {
    std::vector<Vec3> result = {path.front()};
    const auto add = [&](Vec3 p) {  // arcs that meet half way share a point, which a tube must not get twice
        if (length(p - result.back()) > 1e-4f) result.push_back(p);
    };
    for (size_t i = 1; i + 1 < path.size(); ++i) {
        const Vec3 before = path[i - 1] - path[i], after = path[i + 1] - path[i];
        const float r = std::min({radius, 0.5f * length(before), 0.5f * length(after)});
        const Vec3 from = path[i] + normalize(before) * r, to = path[i] + normalize(after) * r;
        for (int k = 0; k <= steps; ++k) {  // quadratic Bezier curve with the corner as its middle point
            const float t = float(k) / float(steps);
            add(from * ((1 - t) * (1 - t)) + path[i] * (2 * t * (1 - t)) + to * (t * t));
        }
    }
    add(path.back());
    return result;
}

void add_lathe(Shape& shape, const std::vector<Vec2>& profile, int sides, Vec2 uv_size, const Tint& tint) {
    constexpr float sharp_cosine = 0.766f;  // 40 degrees
    const size_t segments = profile.size() - 1;
    std::vector<Vec2> normals(segments);  // (radial, vertical)
    std::vector<float> along(profile.size(), 0);
    for (size_t i = 0; i < segments; ++i) {
        const Vec2 d = profile[i + 1] - profile[i];
        const float segment_length = std::hypot(d.x, d.y);
        normals[i] = Vec2{d.y, -d.x} * (1 / segment_length);
        along[i + 1] = along[i] + segment_length;
    }
    const auto smoothed = [&](size_t segment, size_t neighbour) {
        const Vec2 a = normals[segment], b = normals[neighbour];
        if (a.x * b.x + a.y * b.y < sharp_cosine) return a;
        const Vec2 sum = a + b;
        return sum * (1 / std::hypot(sum.x, sum.y));
    };
    for (size_t i = 0; i < segments; ++i) {
        const uint32_t first = uint32_t(shape.positions.size());
        for (const size_t end : {size_t(0), size_t(1)}) {
            const size_t neighbour = end == 0 ? (i > 0 ? i - 1 : i) : std::min(i + 1, segments - 1);
            const Vec2 p = profile[i + end], n = smoothed(i, neighbour);
            for (int k = 0; k <= sides; ++k) {
                const float turn = float(k) / float(sides), phi = 2 * pi * turn;
                const Vec3 outward = {std::sin(phi), 0, std::cos(phi)};
                add_vertex(shape, outward * p.x + Vec3(0, p.y, 0), outward * n.x + Vec3(0, n.y, 0),
                           {turn * uv_size.x, (1 - along[i + end] / along.back()) * uv_size.y}, tint);
            }
        }
        connect_grid(shape, first, sides, 1);
    }
}

}  // namespace pluvia
