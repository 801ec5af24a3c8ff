// Streaks sorted into screen tiles, so that a camera ray meets only the few that may cross it.
// How a streak covers a ray is in coverage.h.
#pragma once

#include "renderer/core/view.h"
#include "renderer/rain/coverage.h"
#include "renderer/rain/streaks.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace pluvia {

/// A streak as it lies on the picture: every ray that can meet the drop during the exposure has its pixel position
/// within radius of the line from (x, y) to (x + dx, y + dy). Pixels.
struct alignas(32) StreakFootprint {
    float x, y, dx, dy;
    float inverse_length_squared;  // of (dx, dy); 0 for a point
    float radius;
    float nearest_depth;  // metres

    float distance_squared(Vec2 pixel) const {
        const float px = pixel.x - x, py = pixel.y - y;
        const float s = std::min(std::max((px * dx + py * dy) * inverse_length_squared, 0.0f), 1.0f);
        const float ex = px - s * dx, ey = py - s * dy;
        return ex * ex + ey * ey;
    }
    bool may_cover(Vec2 pixel, float margin = 0) const {
        return distance_squared(pixel) <= (radius + margin) * (radius + margin);
    }
};

class StreakBins {
public:
    /// Takes the streaks of find_streaks, or those of them that remain after others have been removed, in their order.
    /// The view is the one they were found for. Tiles are measured in pixels; the default, upright as streaks are, was
    /// measured by tools/bench/streak_lookup.cpp.
    StreakBins(std::vector<Streak> streaks, const View& view, int tile_width = 4, int tile_height = 8);

    /// In order of nearest_depth, then key; StreakHit::streak is an index into this.
    std::span<const Streak> streaks() const { return streaks_; }
    std::span<const StreakFootprint> footprints() const { return footprints_; }
    float exposure_time() const { return exposure_time_; }
    float focal_pixels() const { return focal_pixels_; }
    /// Greatest nearest_depth of a streak that may cover the ray before its end: its point beside a drop's centre is
    /// less than a radius from it, so the depths differ by less than that.
    float farthest(const Ray& ray) const { return ray.t_max * ray.direction.z + largest_radius_; }
    double shutter_open() const { return shutter_open_; }  // seconds of the sequence
    Vec3 world_vector(Vec3 in_view) const { return right_ * in_view.x + up_ * in_view.y + forward_ * in_view.z; }

    /// Indices, rising and thereby in order of nearest depth, of the streaks that rays through this pixel may meet.
    /// Outside of the picture: those of the nearest pixel.
    std::span<const uint32_t> candidates(int pixel_x, int pixel_y) const;
    /// Replaces found by those of them that rays through this very pixel may meet, in the same order: all samples of a
    /// pixel then share the search.
    void find_candidates(int pixel_x, int pixel_y, std::vector<uint32_t>& found) const;

    /// Those of the candidates, in the order of either search, that may cover the ray before its end.
    std::span<const uint32_t> before_end(std::span<const uint32_t> candidates, const Ray& ray) const;
    /// Per position on the picture.
    using Touched = std::array<std::vector<uint32_t>, 64>;
    /// Those of the candidates, in their order, that rays through each of up to 64 positions may meet. Replaces
    /// touched, as far as there are positions.
    void find_touched(std::span<const uint32_t> candidates, std::span<const Vec2> positions, Touched& touched) const;

private:
    std::vector<Streak> streaks_;
    std::vector<StreakFootprint> footprints_;
    float exposure_time_, focal_pixels_, largest_radius_ = 0;
    double shutter_open_;
    Vec3 right_, up_, forward_;  // view axes in the world
    int tile_width_, tile_height_, columns_, rows_;
    std::vector<uint64_t> first_;  // of each tile in entries_, row by row, and the end
    std::vector<uint32_t> entries_;
};

struct StreakHit {
    uint32_t streak;  // index into StreakBins::streaks()
    Covered covered;
    float width;  // of the drop in pixels, at the view depth where it covers the ray
};

/// Replaces hits by all streaks that cover the ray nearer than ray.t_max, from front to back (ties by key).
/// ray: view coordinates, from a point of the lens (the origin for a pinhole) through the point in focus behind a
/// position on the picture, direction of unit length. touched: those that it may meet, of StreakBins::find_touched.
void find_hits(const StreakBins& bins, std::span<const uint32_t> touched, const Ray& ray, std::vector<StreakHit>& hits);
/// The same of the candidates of a pixel, from either search of the bins; looked up where they are not given.
/// pixel: the position on the picture that the ray belongs to.
void find_hits(const StreakBins& bins, std::span<const uint32_t> candidates, Vec2 pixel, const Ray& ray,
               std::vector<StreakHit>& hits);
inline void find_hits(const StreakBins& bins, Vec2 pixel, const Ray& ray, std::vector<StreakHit>& hits) {
    find_hits(bins, bins.candidates(int(pixel.x), int(pixel.y)), pixel, ray, hits);
}

}  // namespace pluvia
