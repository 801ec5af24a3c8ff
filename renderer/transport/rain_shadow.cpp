#include "renderer/transport/rain_shadow.h"

#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "renderer/rain/drop_size.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace pluvia {
namespace {

constexpr float finest_cell = 0.05f;  // metres
constexpr int most_cells = 8192;      // along a side
constexpr int tile = 32;              // cells along a side; a tile of floats fills a page

/// Half of the water of rain of 25 mm/h is in smaller drops: 3.672 / slope (Marshall and Palmer's distribution).
double median_fall_speed() {
    return fall_speed(3.672 / size_slope(25));
}

}  // namespace

RainShadow::RainShadow(const Scene& scene, const RayScene& ray_scene, Vec3d wind)
    : ray_scene_(&ray_scene), fall_(normalize(Vec3(wind - Vec3d(0, median_fall_speed(), 0)))) {
    drift_x_ = -fall_.x / fall_.y, drift_z_ = -fall_.z / fall_.y;
    const Bounds box = bounds(scene);
    if (box.empty() || !(fall_.y < 0)) return;
    lower_ = Vec3(box.lower), upper_ = Vec3(box.upper);
    // A place is named by where its drop passed the height of the scene's top.
    const float height = upper_.y - lower_.y;
    const float shift_x = drift_x_ * height, shift_z = drift_z_ * height;
    corner_x_ = lower_.x - std::max(0.0f, shift_x), corner_z_ = lower_.z - std::max(0.0f, shift_z);
    const float size_x = upper_.x - lower_.x + std::abs(shift_x), size_z = upper_.z - lower_.z + std::abs(shift_z);
    cell_ = std::max(finest_cell, std::max(size_x, size_z) / float(most_cells - 1));
    cells_per_metre_ = 1 / cell_;
    columns_ = int(size_x / cell_) + 1, rows_ = int(size_z / cell_) + 1;
    tiles_across_ = (columns_ + tile - 1) / tile;
    const size_t tiles = size_t(tiles_across_) * size_t((rows_ + tile - 1) / tile);
    tops_.reset(static_cast<float*>(std::calloc(tiles * tile * tile, sizeof(float))));
    if (!tops_) throw Error(ExitCode::render_failed, "rain shadow", "no memory is left for its map");
}

RainShadow::Place RainShadow::place(Vec3 p) const {
    const float height = upper_.y - p.y;
    const float u = (p.x - drift_x_ * height - corner_x_) * cells_per_metre_;
    const float v = (p.z - drift_z_ * height - corner_z_) * cells_per_metre_;
    return {u, v, height > 0 && u >= 0 && v >= 0 && u < float(columns_) && v < float(rows_)};
}

float RainShadow::top(int column, int row, Counters& counters) const {
    constexpr float nothing = -std::numeric_limits<float>::infinity();
    if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return nothing;
    const size_t in_tile = size_t(row % tile) * tile + size_t(column % tile);
    const size_t index = (size_t(row / tile) * size_t(tiles_across_) + size_t(column / tile)) * tile * tile + in_tile;
    const std::atomic_ref<float> stored(tops_.get()[index]);
    float known = stored.load(std::memory_order_relaxed);
    if (known != 0) return known;

    // Through a random point of the cell, so that twigs thinner than cells shelter their share.
    const uint64_t key = hash_key(uint64_t(uint32_t(column)), uint32_t(row));
    const float x = corner_x_ + (float(column) + unit_float(key)) * cell_;
    const float z = corner_z_ + (float(row) + unit_float(mix_bits(key))) * cell_;
    constexpr float above = 1;  // metres over the scene's top
    const Vec3 from(x - drift_x_ * above, upper_.y + above, z - drift_z_ * above);
    RayHit hit;
    float height = nothing;
    if (ray_scene_->closest_hit({from, fall_}, {key}, hit, counters)) height = from.y + fall_.y * hit.distance;
    if (height == 0) height = std::numeric_limits<float>::min();
    // Two threads may have met here with the same height; one of them counts.
    if (stored.compare_exchange_strong(known, height, std::memory_order_relaxed)) counters.count(Feature::rain_shadow);
    return height;
}

float RainShadow::exposure(Vec3 p, Counters& counters) const {
    const Place at = place(p);
    if (!at.inside) return 1;
    const float u = at.u - 0.5f, v = at.v - 0.5f;
    const float column = std::floor(u), row = std::floor(v), s = u - column, t = v - row;
    const auto open = [&](int i, int k) { return top(int(column) + i, int(row) + k, counters) <= p.y ? 1.0f : 0.0f; };
    return (open(0, 0) * (1 - s) + open(1, 0) * s) * (1 - t) + (open(0, 1) * (1 - s) + open(1, 1) * s) * t;
}

bool RainShadow::is_open(Vec3 p, Counters& counters) const {
    const Place at = place(p);
    if (!at.inside) return true;
    constexpr int mask = ~(medium_cells - 1);
    return top(int(at.u) & mask, int(at.v) & mask, counters) <= p.y;
}

float RainShadow::end_of_shelter(const Ray& ray) const {
    if (!tops_) return 0;
    float end = std::numeric_limits<float>::infinity();
    // Of the box sheared along the fall only the heights are simple; sideways a ray leaves the box's own range last.
    const Vec3 slack(std::abs(drift_x_), 0, std::abs(drift_z_));
    const Vec3 lower = lower_ - slack * (upper_.y - lower_.y), upper = upper_ + slack * (upper_.y - lower_.y);
    for (int axis = 0; axis < 3; ++axis) {
        const float d = ray.direction[axis], o = ray.origin[axis];
        if (d > 0) end = std::min(end, (upper[axis] - o) / d);
        if (d < 0) end = std::min(end, (lower[axis] - o) / d);
    }
    return std::max(0.0f, end);
}

}  // namespace pluvia
