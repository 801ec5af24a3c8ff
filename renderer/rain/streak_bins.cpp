#include "renderer/rain/streak_bins.h"

#include "renderer/core/parallel.h"

#include <algorithm>
#include <array>
#include <bit>

namespace pluvia {
namespace {

// Outline of a streak on the picture: the hull of two disks, one at each end of its path.
struct Outline {
    double x0, y0, radius0, x1, y1, radius1;  // pixels
};

// The outline contains every pixel position whose rays can meet the drop; false where it is never in front. Seen
// through the lens's centre, a point of the drop is at most f r sqrt(1 + tan^2) / (z - r) from its centre's picture,
// tan being that of the angle off the axis (Cauchy-Schwarz on the difference of the two projections); a ray from the
// lens's rim is off by the blur radius at the depth of that point. Along the path the inverse depth is linear on the
// picture and both are convex in it, so that the disks between the ends stay in the hull.
bool find_outline(const Streak& streak, const View& view, Outline& outline) {
    const double contact = contact_depth(streak), r = streak.radius, f = view.focal_pixels;
    const Vec3d start(streak.start), velocity(streak.velocity);
    std::array<Vec3d, 2> ends = {start, start + velocity * double(float(view.exposure_time))};
    if (ends[0].z < contact && ends[1].z < contact) return false;
    for (Vec3d& end : ends)
        if (end.z < contact) end = start + velocity * ((contact - start.z) / velocity.z);

    const auto tan_squared = [](Vec3d p) { return (p.x * p.x + p.y * p.y) / (p.z * p.z); };
    const double stretch = f * r * std::sqrt(1 + std::max(tan_squared(ends[0]), tan_squared(ends[1])));
    const auto pixel_x = [&](Vec3d p) { return view.width / 2.0 + view.centre_offset.x + p.x * f / p.z; };
    const auto pixel_y = [&](Vec3d p) { return view.height / 2.0 + view.centre_offset.y - p.y * f / p.z; };
    const auto radius = [&](Vec3d p) {
        const double blur = std::max(view.blur_radius_pixels(p.z - r), view.blur_radius_pixels(p.z + r));
        // Single precision of the footprint and of the pixel positions that will be compared with it.
        const double rounding = 1e-3 + 1e-6 * (std::abs(pixel_x(p)) + std::abs(pixel_y(p)));
        return stretch / (p.z - r) + blur + rounding;
    };
    outline = {pixel_x(ends[0]), pixel_y(ends[0]), radius(ends[0]),
               pixel_x(ends[1]), pixel_y(ends[1]), radius(ends[1])};
    return true;
}

StreakFootprint footprint_of(const Outline& outline, float depth) {
    const double dx = outline.x1 - outline.x0, dy = outline.y1 - outline.y0;
    const double length_squared = dx * dx + dy * dy, radius = std::max(outline.radius0, outline.radius1);
    return {float(outline.x0),
            float(outline.y0),
            float(dx),
            float(dy),
            length_squared > 1e-6 ? float(1 / length_squared) : 0.0f,
            float(radius),
            depth};
}

// Tiles that an interval of the picture begins and ends in; of one that lies outside, the last is before the first.
int first_tile(double position, int count) {
    return int(std::clamp(std::floor(position), 0.0, double(count)));
}
int last_tile(double position, int count) {
    return int(std::clamp(std::floor(position), -1.0, count - 1.0));
}

struct Tiling {
    int width, height, columns, rows;  // of a tile in pixels; of the picture in tiles

    // Calls visit(tile) for the tiles that the outline may touch: row by row, the part of the path whose disks reach
    // the row, and the columns under that part.
    template <class Visit>
    void visit(const Outline& o, Visit&& visit) const {
        const double dx = o.x1 - o.x0, dy = o.y1 - o.y0, dr = o.radius1 - o.radius0;
        const double top = std::min(o.y0 - o.radius0, o.y1 - o.radius1);
        const double bottom = std::max(o.y0 + o.radius0, o.y1 + o.radius1);
        const int first_row = first_tile(top / height, rows), last_row = last_tile(bottom / height, rows);
        for (int row = first_row; row <= last_row; ++row) {
            double s0 = 0, s1 = 1;
            const auto keep_where_not_negative = [&](double at_0, double slope) {
                if (slope > 0) s0 = std::max(s0, -at_0 / slope);
                if (slope < 0) s1 = std::min(s1, -at_0 / slope);
                if (slope == 0 && at_0 < 0) s1 = -1;
            };
            keep_where_not_negative(o.y0 + o.radius0 - double(row) * height, dy + dr);
            keep_where_not_negative(double(row + 1) * height - o.y0 + o.radius0, dr - dy);
            if (s0 > s1) continue;
            const double left = o.x0 - o.radius0 + std::min((dx - dr) * s0, (dx - dr) * s1);
            const double right = o.x0 + o.radius0 + std::max((dx + dr) * s0, (dx + dr) * s1);
            const int last = last_tile(right / width, columns);
            for (int column = first_tile(left / width, columns); column <= last; ++column)
                visit(size_t(row) * columns + column);
        }
    }
};

}  // namespace

StreakBins::StreakBins(std::vector<Streak> streaks, const View& view, int tile_width, int tile_height)
    : streaks_(std::move(streaks)),
      footprints_(streaks_.size()),
      exposure_time_(float(view.exposure_time)),
      focal_pixels_(float(view.focal_pixels)),
      shutter_open_(view.shutter_open),
      right_(view.right),
      up_(view.up),
      forward_(-view.back),
      tile_width_(tile_width),
      tile_height_(tile_height),
      columns_((view.width + tile_width - 1) / tile_width),
      rows_((view.height + tile_height - 1) / tile_height) {
    for (const Streak& streak : streaks_) largest_radius_ = std::max(largest_radius_, streak.radius);
    // Streaks are counted, then entered, in a fixed number of parts side by side; within a tile the parts follow each
    // other, so that the order is that of the streaks whatever the number of threads.
    constexpr int parts = 16;
    const Tiling tiling{tile_width_, tile_height_, columns_, rows_};
    const size_t tiles = size_t(columns_) * rows_;
    std::vector<uint32_t> next(parts * tiles);  // per part and tile: number, then place of the next entry in the tile
    const auto for_each_entry = [&](int part, auto&& visit) {
        const size_t end = streaks_.size() * (part + 1) / parts;
        for (size_t i = streaks_.size() * part / parts; i < end; ++i) {
            Outline outline;
            if (!find_outline(streaks_[i], view, outline)) continue;
            footprints_[i] = footprint_of(outline, nearest_depth(streaks_[i], exposure_time_));
            tiling.visit(outline, [&](size_t tile) { visit(uint32_t(i), next[part * tiles + tile], tile); });
        }
    };
    parallel_for(parts, [&](int part) { for_each_entry(part, [](uint32_t, uint32_t& n, size_t) { ++n; }); });

    first_.resize(tiles + 1);
    for (size_t tile = 0; tile < tiles; ++tile) {
        uint32_t entered = 0;
        for (int part = 0; part < parts; ++part) {
            const uint32_t count = next[part * tiles + tile];
            next[part * tiles + tile] = entered;
            entered += count;
        }
        first_[tile + 1] = first_[tile] + entered;
    }
    entries_.resize(first_[tiles]);
    parallel_for(parts, [&](int part) {
        for_each_entry(part, [&](uint32_t i, uint32_t& n, size_t tile) { entries_[first_[tile] + n++] = i; });
    });
}

std::span<const uint32_t> StreakBins::candidates(int pixel_x, int pixel_y) const {
    const int column = std::clamp(pixel_x / tile_width_, 0, columns_ - 1);
    const int row = std::clamp(pixel_y / tile_height_, 0, rows_ - 1);
    const size_t tile = size_t(row) * columns_ + column;
    return {entries_.data() + first_[tile], entries_.data() + first_[tile + 1]};
}

void StreakBins::find_candidates(int pixel_x, int pixel_y, std::vector<uint32_t>& found) const {
    found.clear();
    const Vec2 centre{float(pixel_x) + 0.5f, float(pixel_y) + 0.5f};
    constexpr float half_diagonal = 0.7072f;
    for (const uint32_t index : candidates(pixel_x, pixel_y)) {
        if (footprints_[index].may_cover(centre, half_diagonal)) found.push_back(index);
    }
}

std::span<const uint32_t> StreakBins::before_end(std::span<const uint32_t> candidates, const Ray& ray) const {
    const auto end = std::ranges::upper_bound(candidates, farthest(ray), {},
                                              [&](uint32_t index) { return footprints_[index].nearest_depth; });
    return candidates.first(size_t(end - candidates.begin()));
}

void StreakBins::find_touched(std::span<const uint32_t> candidates, std::span<const Vec2> positions,
                              Touched& touched) const {
    for (size_t i = 0; i < positions.size(); ++i) touched[i].clear();
    for (const uint32_t index : candidates) {
        const StreakFootprint footprint = footprints_[index];
        uint64_t mask = 0;
        for (size_t i = 0; i < positions.size(); ++i) mask |= uint64_t(footprint.may_cover(positions[i])) << i;
        for (; mask; mask &= mask - 1) touched[size_t(std::countr_zero(mask))].push_back(index);
    }
}

/// All hits of those streaks that pass a test.
template <class Test>
static void find_hits_where(const StreakBins& bins, std::span<const uint32_t> streaks, const Ray& ray, const Test& test,
                            std::vector<StreakHit>& hits) {
    hits.clear();
    for (const uint32_t index : bins.before_end(streaks, ray)) {
        if (!test(bins.footprints()[index])) continue;
        const Streak& streak = bins.streaks()[index];
        const std::optional<Covered> covered = covered_interval(streak, ray, bins.exposure_time());
        if (!covered || covered->distance >= ray.t_max) continue;
        const float depth = covered->distance * ray.direction.z;
        hits.push_back({index, *covered, 2 * streak.radius * bins.focal_pixels() / depth});
    }
    std::sort(hits.begin(), hits.end(), [&](const StreakHit& a, const StreakHit& b) {
        return a.covered.distance != b.covered.distance ? a.covered.distance < b.covered.distance
                                                        : bins.streaks()[a.streak].key < bins.streaks()[b.streak].key;
    });
}

void find_hits(const StreakBins& bins, std::span<const uint32_t> touched, const Ray& ray,
               std::vector<StreakHit>& hits) {
    find_hits_where(
        bins, touched, ray, [](const StreakFootprint&) { return true; }, hits);
}

void find_hits(const StreakBins& bins, std::span<const uint32_t> candidates, Vec2 pixel, const Ray& ray,
               std::vector<StreakHit>& hits) {
    const auto may_cover = [pixel](const StreakFootprint& footprint) { return footprint.may_cover(pixel); };
    find_hits_where(bins, candidates, ray, may_cover, hits);
}

}  // namespace pluvia
