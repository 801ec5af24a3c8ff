// The rain shadow: which places rain does not reach because something stands above them. A map of the first surface
// that a drop meets on parallel ways down, along the fall of a median drop in the wind. Cells are filled when something
// asks for them, so that a scene pays for what is in view. Asked by the medium of fine rain (dry_parts.h) and by wet
// ground (wet_ground.h); streaks are sheltered by exact rays (shelter.h).
#pragma once

#include "renderer/accel/ray_scene.h"

#include <cstdlib>
#include <memory>

namespace pluvia {

class RainShadow {
public:
    /// wind: m/s, world. Keeps the reference. One fall for all intensities, so that what one gets does not depend on
    /// the others; drops that are smaller or larger are blown a little farther or less.
    RainShadow(const Scene& scene, const RayScene& ray_scene, Vec3d wind);

    /// Share of rain that reaches a point and the cells around it, 0 to 1. A surface asks from clearance() above
    /// itself.
    float exposure(Vec3 p, Counters& counters) const;
    /// Whether rain reaches a point: by one cell in each square of medium_cells x medium_cells.
    bool is_open(Vec3 p, Counters& counters) const;

    /// Unit vector, scene coordinates.
    Vec3 fall() const { return fall_; }
    /// Side of a cell over level ground, metres: 5 cm, more where the scene is larger than 400 m.
    float cell_size() const { return cell_; }
    /// Distance from a surface, along its normal, at which the surface itself shadows no cell around.
    float clearance() const { return 2 * cell_; }
    /// Distance along a ray beyond which nothing is sheltered.
    float end_of_shelter(const Ray& ray) const;

private:
    struct Free {
        void operator()(float* p) const { std::free(p); }
    };
    struct Place {
        float u, v;  // in cells
        bool inside;
    };
    Place place(Vec3 p) const;
    /// Height of the first surface on the way down through a cell, -inf where there is none. Leaves count as the rays
    /// of light see them: a mask stops a drop where it is opaque, a blended surface the share that it hides.
    float top(int column, int row, Counters& counters) const;

    static constexpr int medium_cells = 4;
    const RayScene* ray_scene_;
    Vec3 fall_;
    float drift_x_, drift_z_;  // metres that a drop is blown sideways per metre of height
    Vec3 lower_, upper_;       // box of the scene
    float corner_x_ = 0, corner_z_ = 0, cell_ = 1, cells_per_metre_ = 1;
    int columns_ = 0, rows_ = 0, tiles_across_ = 0;
    // 0 = not asked for yet. In tiles of one page of memory: what nobody asks for is never touched and takes no room.
    std::unique_ptr<float, Free> tops_;
};

}  // namespace pluvia
