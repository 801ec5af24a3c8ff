// Affine transforms in double precision, and the shading basis around a normal.
// Transforms read right to left: world_from_node applied to a point of the node gives a point of the world.
#pragma once

#include "renderer/core/vec.h"

namespace pluvia {

/// Affine map x -> (column_x, column_y, column_z) x + translation.
struct Transform {
    Vec3d column_x = {1, 0, 0}, column_y = {0, 1, 0}, column_z = {0, 0, 1};
    Vec3d translation;

    constexpr Vec3d vector(Vec3d v) const { return column_x * v.x + column_y * v.y + column_z * v.z; }
    constexpr Vec3d point(Vec3d p) const { return vector(p) + translation; }

    /// Rows of the cofactor matrix: it carries normals (not normalised), also where the determinant is negative
    /// or zero, since it needs no inverse. The sign follows the orientation of the transformed surface.
    constexpr Vec3d normal(Vec3d n) const {
        return cross(column_y, column_z) * n.x + cross(column_z, column_x) * n.y + cross(column_x, column_y) * n.z;
    }
    constexpr double determinant() const { return dot(column_x, cross(column_y, column_z)); }

    friend constexpr Transform operator*(const Transform& a, const Transform& b) {
        return {a.vector(b.column_x), a.vector(b.column_y), a.vector(b.column_z), a.point(b.translation)};
    }
    friend constexpr bool operator==(const Transform&, const Transform&) = default;
};

constexpr Transform translate(Vec3d offset) {
    return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, offset};
}
constexpr Transform scale(Vec3d s) {
    return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}};
}

/// Rotation by the quaternion (x, y, z, w), which is normalised first.
inline Transform rotate(double x, double y, double z, double w) {
    const double s = 2 / (x * x + y * y + z * z + w * w);
    return {{1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)},
            {s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)},
            {s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)},
            {}};
}

/// Inverse of an affine map whose determinant is not zero.
constexpr Transform inverse(const Transform& m) {
    const double d = 1 / m.determinant();
    const Vec3d row_x = cross(m.column_y, m.column_z) * d;
    const Vec3d row_y = cross(m.column_z, m.column_x) * d;
    const Vec3d row_z = cross(m.column_x, m.column_y) * d;
    const Vec3d t = m.translation;
    return {{row_x.x, row_y.x, row_z.x},
            {row_x.y, row_y.y, row_z.y},
            {row_x.z, row_y.z, row_z.z},
            {-dot(row_x, t), -dot(row_y, t), -dot(row_z, t)}};
}

/// Right-handed orthonormal basis whose third axis is a unit normal.
/// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3.
struct ShadingBasis {
    Vec3 tangent, bitangent, normal;

    explicit ShadingBasis(Vec3 n) : normal(n) {
        const float sign = std::copysign(1.0f, n.z);
        const float a = -1 / (sign + n.z);
        const float b = n.x * n.y * a;
        tangent = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        bitangent = {b, sign + n.y * n.y * a, -n.y};
    }
    Vec3 to_local(Vec3 v) const { return {dot(v, tangent), dot(v, bitangent), dot(v, normal)}; }
    Vec3 to_world(Vec3 v) const { return tangent * v.x + bitangent * v.y + normal * v.z; }
};

}  // namespace pluvia
