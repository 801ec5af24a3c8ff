#include "renderer/scene/object_extent.h"

#include "renderer/core/parallel.h"
#include "renderer/scene/surface.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

/// The rotation nearest to a node's transform that keeps its front, and its up in the plane of both.
void set_axes(const Transform& t, OrientedBox& box) {
    Vec3d front = normalize(t.column_z);
    Vec3d right = normalize(cross(t.column_y, front));
    if (!is_finite(front) || !is_finite(right)) front = {0, 0, 1}, right = {1, 0, 0};  // flattened by its scale
    box.axes[0] = right, box.axes[1] = cross(front, right), box.axes[2] = front;
}

/// Pixels that an object covers, one bit each, within the part of the picture that it reaches.
class Cover {
public:
    Cover(const View& view, const PixelBox& reach) {
        const auto whole = [](double v, int highest) { return int(std::clamp(v, 0.0, double(highest))); };
        left_ = whole(std::floor(reach.left), view.width), right_ = whole(std::ceil(reach.right), view.width);
        top_ = whole(std::floor(reach.top), view.height), bottom_ = whole(std::ceil(reach.bottom), view.height);
        if (left_ < right_ && top_ < bottom_) covered_.resize(size_t(right_ - left_) * size_t(bottom_ - top_));
    }
    bool empty() const { return covered_.empty(); }

    /// Calls covers(pixel centre) for pixels of a box that are not covered yet.
    template <class Covers>
    void add(const PixelBox& box, Covers covers) {
        const int x0 = std::max(left_, int(std::max(box.left - 0.5, -1e6))),
                  x1 = std::min(right_, int(std::min(box.right + 0.5, 1e6)) + 1);
        const int y0 = std::max(top_, int(std::max(box.top - 0.5, -1e6))),
                  y1 = std::min(bottom_, int(std::min(box.bottom + 0.5, 1e6)) + 1);
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) {
                auto bit = covered_[size_t(y - top_) * size_t(right_ - left_) + size_t(x - left_)];
                if (!bit && covers(Vec2{float(x) + 0.5f, float(y) + 0.5f})) bit = true, ++count;
            }
    }
    int64_t count = 0;

private:
    int left_, right_, top_, bottom_;
    std::vector<bool> covered_;
};

/// Box of the part of a triangle that is in front of the camera; view coordinates.
PixelBox projected(const View& view, const std::array<Vec3d, 3>& p) {
    PixelBox box;
    const auto add = [&](Vec3d v) {
        const double s = view.focal_pixels / v.z;
        box.add(view.width / 2.0 + v.x * s, view.height / 2.0 - v.y * s);
    };
    for (int k = 0; k < 3; ++k) {
        const Vec3d a = p[size_t(k)], b = p[size_t(k + 1) % 3];
        if (a.z >= nearest_projected) add(a);
        if ((a.z < nearest_projected) == (b.z < nearest_projected)) continue;
        const double s = (nearest_projected - a.z) / (b.z - a.z);
        add({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), nearest_projected});
    }
    return box;
}

/// Where a ray from the camera meets a triangle in view coordinates.
/// Source: Moeller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
bool meets(Vec3d direction, const std::array<Vec3d, 3>& p, float& b1, float& b2) {
    const Vec3d e1 = p[1] - p[0], e2 = p[2] - p[0], n = cross(direction, e2);
    const double determinant = dot(e1, n);
    if (determinant == 0) return false;
    const Vec3d t = -p[0], q = cross(t, e1);
    const double u = dot(t, n) / determinant, v = dot(direction, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || dot(e2, q) / determinant <= 0) return false;
    b1 = float(u), b2 = float(v);
    return true;
}

struct Part {
    int instance;
    std::vector<Vec3d> positions;  // view coordinates
};

ObjectExtent extent_of(const Scene& scene, const std::vector<int>& instances, const View& view) {
    ObjectExtent extent;
    set_axes(scene.instances[size_t(instances[0])].scene_from_object, extent.box);
    Bounds own;  // along the box's axes
    std::vector<Part> parts;
    for (const int index : instances) {
        const Instance& instance = scene.instances[size_t(index)];
        Part part{index, {}};
        for (const Vec3 local : scene.meshes[size_t(instance.mesh)].positions) {
            const Vec3d p = instance.scene_from_object.point(Vec3d(local));
            own.add({dot(p, extent.box.axes[0]), dot(p, extent.box.axes[1]), dot(p, extent.box.axes[2])});
            part.positions.push_back(view.view_from_world(p));
        }
        parts.push_back(std::move(part));
    }
    const Vec3d middle = (own.lower + own.upper) * 0.5;
    extent.box.centre = extent.box.axes[0] * middle.x + extent.box.axes[1] * middle.y + extent.box.axes[2] * middle.z;
    extent.box.size = own.upper - own.lower;

    const auto for_each_triangle = [&](auto visit) {
        for (const Part& part : parts) {
            const Mesh& mesh = scene.meshes[size_t(scene.instances[size_t(part.instance)].mesh)];
            const bool holes = may_be_transparent(scene, mesh);
            for (size_t t = 0; t < mesh.triangles.size(); ++t) {
                const auto& corner = mesh.triangles[t];
                const std::array<Vec3d, 3> p = {part.positions[corner[0]], part.positions[corner[1]],
                                                part.positions[corner[2]]};
                const PixelBox box = projected(view, p);
                if (box.left <= box.right) visit(p, box, SurfacePoint{part.instance, int(t)}, holes);
            }
        }
    };
    PixelBox& whole = extent.projected;
    for_each_triangle([&](const auto&, const PixelBox& box, SurfacePoint, bool) {
        whole.add(box.left, box.top), whole.add(box.right, box.bottom);
    });
    Cover cover(view, whole);
    if (cover.empty()) return extent;
    for_each_triangle([&](const std::array<Vec3d, 3>& p, const PixelBox& box, SurfacePoint point, bool holes) {
        cover.add(box, [&](Vec2 centre) {
            return meets(Vec3d(view.view_direction(centre)), p, point.b1, point.b2) &&
                   (!holes || opacity(scene, point) >= 0.5f);
        });
    });
    extent.pixels = cover.count;
    return extent;
}

}  // namespace

PixelBox intersection(const PixelBox& a, const PixelBox& b) {
    return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right), std::min(a.bottom, b.bottom)};
}

std::vector<ObjectExtent> object_extents(const Scene& scene, const SceneObjects& objects, const View& view) {
    std::vector<std::vector<int>> instances(objects.objects.size());
    for (size_t i = 0; i < objects.object_of_instance.size(); ++i)
        instances[size_t(objects.object_of_instance[i])].push_back(int(i));
    std::vector<ObjectExtent> extents(instances.size());
    parallel_for(int(instances.size()),
                 [&](int i) { extents[size_t(i)] = extent_of(scene, instances[size_t(i)], view); });
    return extents;
}

}  // namespace pluvia
