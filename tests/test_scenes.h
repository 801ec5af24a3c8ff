// Small scenes built in code, and their pictures, for the tests of light transport.
#pragma once

#include "renderer/transport/render.h"

#include <map>
#include <string>
#include <vector>

namespace pluvia {

/// A Lambert surface and nothing else.
Material lambert(Rgb albedo);
/// A surface that only emits, in cd/m2.
Material emitter(Rgb radiance);

/// Each adds one mesh and one instance, and returns the index of the instance.
int add_quad(Scene& scene, Vec3 corner, Vec3 edge_u, Vec3 edge_v, const Material& material);  // faces cross(u, v)
int add_box(Scene& scene, Vec3 lower, Vec3 upper, const Material& material);
/// Vertices on the sphere: the polyhedron is a little smaller than the sphere.
int add_sphere(Scene& scene, Vec3 centre, float radius, int segments, const Material& material);

/// Ground, two walls and a box that light each other, all of one material; seen by court_view().
Scene make_court(const Material& material);
View court_view(int width, int height);

/// A pinhole view of one pixel per degree or so: from `eye` towards `target`.
View look_at(Vec3d eye, Vec3d target, int width, int height, double focal_pixels);

/// All planes of a rendered frame.
class Picture {
public:
    int width = 0, height = 0;
    std::map<std::string, std::vector<float>> planes;
    RenderReport report;

    const std::vector<float>& plane(const std::string& channel) const { return planes.at(channel); }
    double mean(const std::string& channel) const;
    friend bool operator==(const Picture& a, const Picture& b);  // every bit of every plane
};

Picture render_picture(const Scene& scene, const Environment& environment, const View& view,
                       const RenderSettings& settings);

/// Mean and error of one channel averaged over the picture, from independent seeds.
struct Estimate {
    double mean, standard_error;
};
Estimate estimate(const Scene& scene, const Environment& environment, const View& view, RenderSettings settings,
                  const std::string& channel, int seeds);

}  // namespace pluvia
