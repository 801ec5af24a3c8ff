// Two- and three-component vectors: float for rays and shading, double for placing things in the world.
#pragma once

#include <cmath>
#include <cstdint>

namespace pluvia {

template <class T>
struct Vector2 {
    T x = 0, y = 0;

    friend constexpr Vector2 operator+(Vector2 a, Vector2 b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr Vector2 operator-(Vector2 a, Vector2 b) { return {a.x - b.x, a.y - b.y}; }
    friend constexpr Vector2 operator*(Vector2 a, T s) { return {a.x * s, a.y * s}; }
    friend constexpr Vector2 operator*(T s, Vector2 a) { return a * s; }
    friend constexpr bool operator==(Vector2, Vector2) = default;
};

template <class T>
struct Vector3 {
    T x = 0, y = 0, z = 0;

    constexpr Vector3() = default;
    constexpr Vector3(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
    template <class U>
    constexpr explicit Vector3(Vector3<U> v) : x(T(v.x)), y(T(v.y)), z(T(v.z)) {}

    constexpr T operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }

    friend constexpr Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend constexpr Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend constexpr Vector3 operator-(Vector3 a) { return {-a.x, -a.y, -a.z}; }
    friend constexpr Vector3 operator*(Vector3 a, T s) { return {a.x * s, a.y * s, a.z * s}; }
    friend constexpr Vector3 operator*(T s, Vector3 a) { return a * s; }
    friend constexpr Vector3 operator*(Vector3 a, Vector3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
    friend constexpr Vector3 operator/(Vector3 a, T s) { return a * (1 / s); }
    constexpr Vector3& operator+=(Vector3 b) { return *this = *this + b; }
    constexpr Vector3& operator*=(T s) { return *this = *this * s; }
    friend constexpr bool operator==(Vector3, Vector3) = default;
};

using Vec2 = Vector2<float>;
using Vec3 = Vector3<float>;
using Vec3d = Vector3<double>;

template <class T>
constexpr T dot(Vector3<T> a, Vector3<T> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vector3<T> cross(Vector3<T> a, Vector3<T> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
constexpr T length_squared(Vector3<T> a) {
    return dot(a, a);
}
template <class T>
T length(Vector3<T> a) {
    return std::sqrt(dot(a, a));
}
/// Unit vector along a; the zero vector gives components that are not finite.
template <class T>
Vector3<T> normalize(Vector3<T> a) {
    return a / length(a);
}
template <class T>
constexpr Vector3<T> min(Vector3<T> a, Vector3<T> b) {
    return {a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}
template <class T>
constexpr Vector3<T> max(Vector3<T> a, Vector3<T> b) {
    return {a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z};
}
template <class T>
bool is_finite(Vector3<T> a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

}  // namespace pluvia
