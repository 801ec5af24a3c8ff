#include "renderer/rain/streaks.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "renderer/rain/drop_population.h"

#include <algorithm>
#include <array>
#include <limits>
#include <sstream>

namespace pluvia {
namespace {

void check_settings(const RainSettings& settings) {
    const auto require = [](bool valid, const char* name, double value, const char* expected) {
        if (valid) return;
        std::ostringstream what;
        what << "out of range (got " << value << ", expected " << expected << ")";
        throw usage_error(std::string("rain ") + name, what.str());
    };
    for (double intensity : settings.intensities_mm_per_h) check_intensity(intensity);
    const double wind = length(settings.wind), width = settings.min_width_pixels, ground = settings.lowest_ground;
    if (settings.wind_travel)
        require(length(*settings.wind_travel) <= 1e7, "wind_travel", length(*settings.wind_travel), "at most 10000 km");
    require(wind <= 100, "wind", wind, "at most 100 m/s");
    require(width > 0 && width <= 1000, "min_width_pixels", width, "above 0, at most 1000");
    require(settings.painted_distance >= 0 && settings.painted_distance <= 1000, "painted_distance",
            settings.painted_distance, "0 to 1000 m");
    require(settings.share > 0 && settings.share <= 1, "share", settings.share, "above 0, at most 1");
    require(settings.near > 0 && settings.near <= 1000, "near", settings.near, "above 0, at most 1000 m");
    require(std::abs(ground) <= 1e6, "lowest_ground", ground, "within 1000 km of 0");
}

// Half space of points p with dot(normal, p - camera) <= limit, where the camera is when the shutter opens.
struct HalfSpace {
    Vec3d normal;
    double limit;
};

// Where the drops of one size class may be at shutter open to be seen during the exposure, widened by what a drop
// moves, its radius and the lens.
struct SearchRegion {
    Vec3d camera;
    std::array<HalfSpace, 6> sides;
    Vec3d lower, upper;  // world, a box around it
    double approach;     // metres by which a drop may come nearer from shutter open to mid-exposure

    /// Whether a box with this lower corner may reach into the region.
    bool touches(Vec3d corner, Vec3d size) const {
        const Vec3d p = corner - camera;
        return std::all_of(sides.begin(), sides.end(), [&](const HalfSpace& side) {
            return dot(side.normal, p) + dot(min(side.normal, Vec3d()), size) <= side.limit;
        });
    }
};

/// How many times wider than it is a drop at this view depth is painted.
double widening(const RainSettings& settings, double depth) {
    return settings.painted_distance > 0 ? std::max(1.0, depth / settings.painted_distance) : 1.0;
}

/// The same of a drop that is drawn: its streak is painted_width pixels wide at least.
double painted_widening(const RainSettings& settings, const View& view, double diameter, double depth) {
    if (settings.painted_distance <= 0) return 1;
    return std::max(widening(settings, depth), painted_width * depth / (diameter * view.focal_pixels));
}

double farthest_depth(const View& view, const RainSettings& settings, const SizeClass& size) {
    const double depth = size.d2 * view.focal_pixels / settings.min_width_pixels, painted = settings.painted_distance;
    return painted > 0 && depth >= painted ? painted_reach * painted : depth;
}

Vec3d camera_at_open(const View& view) {
    return view.position - view.velocity * (view.exposure_time / 2);
}

/// Tangent of an angle off the axis with so much added; below a right angle.
double widened(double tangent, double angle) {
    constexpr double largest = 1.5;
    return angle > 0 ? std::max(tangent, std::tan(std::min(std::atan(tangent) + angle, largest))) : tangent;
}

SearchRegion search_region(const View& view, const RainSettings& settings, const SizeClass& size) {
    const double exposure = view.exposure_time, depth = farthest_depth(view, settings, size);
    const double radius = size.d2 / 2 * painted_widening(settings, view, size.d2, depth);
    const Vec3d velocity = settings.wind - view.velocity;
    const Vec3d slow = velocity - Vec3d(0, fall_speed(size.d1), 0), fast = velocity - Vec3d(0, fall_speed(size.d2), 0);
    // Largest speed against a direction: what a drop may be outside in the beginning and still come in.
    const auto inwards = [&](Vec3d normal) { return std::max(-dot(normal, slow), -dot(normal, fast)); };

    const double depth_reached = depth + exposure * std::max(length(slow), length(fast));
    // A ray from the rim of the lens passes a point at depth z this far from where the central ray passes it.
    const double beside = view.lens_radius * (std::max(1.0, std::abs(1 - depth_reached / view.focus_distance)) +
                                              radius / view.focus_distance);

    SearchRegion region;
    region.camera = camera_at_open(view);
    // Slopes of the picture's sides against the axis; as the camera turns, what is at a corner moves farthest.
    const double half_width = view.width / 2.0, half_height = view.height / 2.0, f = view.focal_pixels;
    const double turn = length(view.angular_velocity) * exposure / 2 * std::hypot(1, view.width / f, view.height / f);
    const double right = widened((half_width - view.centre_offset.x) / f, turn);
    const double left = widened((half_width + view.centre_offset.x) / f, turn);
    const double top = widened((half_height + view.centre_offset.y) / f, turn);
    const double bottom = widened((half_height - view.centre_offset.y) / f, turn);
    const double x = std::max(left, right), y = std::max(top, bottom);
    const std::array<Vec3d, 4> side_normals = {Vec3d(1, 0, -right), Vec3d(-1, 0, -left), Vec3d(0, 1, -top),
                                               Vec3d(0, -1, -bottom)};
    double margin = 0;
    for (int i = 0; i < 4; ++i) {
        const Vec3d normal = normalize(view.world_vector_from_view(side_normals[i]));
        region.sides[i] = {normal, radius + beside + exposure * std::max(0.0, inwards(normal))};
        margin = std::max(margin, region.sides[i].limit);
    }
    // Depth counts at mid-exposure.
    const Vec3d forward = -view.back;
    region.approach = exposure / 2 * inwards(forward);
    region.sides[4] = {forward, depth + region.approach};
    region.sides[5] = {-forward, -settings.near + exposure / 2 * inwards(-forward)};

    constexpr double infinity = std::numeric_limits<double>::infinity();
    region.lower = Vec3d(infinity, infinity, infinity);
    region.upper = -region.lower;
    for (double z : {-region.sides[5].limit, region.sides[4].limit}) {
        const double half_x = std::max(0.0, x * z + margin * std::sqrt(1 + x * x));
        const double half_y = std::max(0.0, y * z + margin * std::sqrt(1 + y * y));
        for (int corner = 0; corner < 4; ++corner) {
            const Vec3d v(corner & 1 ? half_x : -half_x, corner & 2 ? half_y : -half_y, z);
            const Vec3d p = region.camera + view.world_vector_from_view(v);
            region.lower = min(region.lower, p);
            region.upper = max(region.upper, p);
        }
    }
    region.lower.y = std::max(region.lower.y, settings.lowest_ground);
    region.upper.y = std::min(region.upper.y, settings.lowest_ground + rain_height);
    return region;
}

struct Cell {
    int size_class;
    CellIndex index;
};

std::vector<Cell> cells_in_region(const DropPopulation& population, int size_class, const SearchRegion& region,
                                  double time) {
    std::vector<Cell> cells;
    if (region.lower.y > region.upper.y) return cells;  // the picture shows only what is under the ground
    const Lattice lattice = lattice_at(population, size_class, time);
    const Vec3d size(lattice.edge, lattice.edge, lattice.edge);
    const CellIndex first = lattice.cell_at(region.lower), last = lattice.cell_at(region.upper);
    for (int64_t z = first.z; z <= last.z; ++z)
        for (int64_t y = first.y; y <= last.y; ++y)
            for (int64_t x = first.x; x <= last.x; ++x)
                if (region.touches(lattice.corner({x, y, z}), size)) cells.push_back({size_class, {x, y, z}});
    return cells;
}

Streak streak_of(const Drop& drop, const DropPopulation& population, const View& view, double widening) {
    const auto to_view = [&](Vec3d v) { return Vec3d(dot(v, view.right), dot(v, view.up), -dot(v, view.back)); };
    Vec3d start = drop.position - camera_at_open(view);
    Vec3d velocity = drop_velocity(population, drop.diameter) - view.velocity;
    if (!(view.angular_velocity == Vec3d())) {
        const Vec3d turning = cross(view.angular_velocity, start + velocity * (view.exposure_time / 2));
        start += turning * (view.exposure_time / 2);
        velocity = velocity - turning;
    }
    return {Vec3(to_view(start)), Vec3(to_view(velocity)), float(drop.diameter / 2 * widening), drop.threshold_mm_per_h,
            drop.key};
}

void sort_by_depth(std::vector<Streak>& streaks, float exposure_time) {
    struct Entry {
        float depth;
        uint32_t index;
    };
    std::vector<Entry> order(streaks.size());
    for (size_t i = 0; i < streaks.size(); ++i) order[i] = {nearest_depth(streaks[i], exposure_time), uint32_t(i)};
    std::sort(order.begin(), order.end(), [&](Entry a, Entry b) {
        return a.depth != b.depth ? a.depth < b.depth : streaks[a.index].key < streaks[b.index].key;
    });
    std::vector<Streak> sorted(streaks.size());
    for (size_t i = 0; i < streaks.size(); ++i) sorted[i] = streaks[order[i].index];
    streaks = std::move(sorted);
}

}  // namespace

std::vector<Streak> find_streaks(const View& view, const RainSettings& settings) {
    check_settings(settings);
    double max_intensity = 0;
    for (double intensity : settings.intensities_mm_per_h) max_intensity = std::max(max_intensity, intensity);

    DropPopulation population{settings.seed, settings.wind, settings.lowest_ground, {}};
    const double middle = view.shutter_open + view.exposure_time / 2;
    if (settings.wind_travel) population.blown = *settings.wind_travel - settings.wind * middle;
    std::array<SearchRegion, size_classes.size()> regions;
    std::vector<Cell> cells;
    for (int c = 0; c < int(size_classes.size()); ++c) {
        if (farthest_depth(view, settings, size_classes[c]) < settings.near) continue;
        regions[c] = search_region(view, settings, size_classes[c]);
        const std::vector<Cell> found = cells_in_region(population, c, regions[c], view.shutter_open);
        cells.insert(cells.end(), found.begin(), found.end());
    }

    const auto mid_depth = [&](const Drop& drop) {
        const Vec3d velocity = drop_velocity(population, drop.diameter) - view.velocity;
        const Vec3d middle = drop.position - camera_at_open(view) + velocity * (view.exposure_time / 2);
        return -dot(middle, view.back);
    };
    const auto is_streak = [&](const Drop& drop, double depth) {
        if (settings.painted_distance > 0 && depth > painted_reach * settings.painted_distance) return false;
        if (settings.share < 1 && unit_double(hash_key(drop.key, 0x7368617265)) >= settings.share) return false;
        const double width = drop.diameter * widening(settings, depth);
        return depth >= settings.near && width * view.focal_pixels >= settings.min_width_pixels * depth;
    };
    constexpr int cells_per_block = 16;
    const int block_count = (int(cells.size()) + cells_per_block - 1) / cells_per_block;
    std::vector<std::vector<Streak>> found(block_count);
    parallel_for(block_count, [&](int block) {
        const size_t end = std::min(cells.size(), size_t(block + 1) * cells_per_block);
        for (size_t i = size_t(block) * cells_per_block; i < end; ++i) {
            const auto& [size_class, index] = cells[i];
            const SearchRegion& region = regions[size_class];
            const Vec3d line(0, size_classes[size_class].cell_edge, 0);
            const auto least_diameter = [&](Vec3d lower_end) {
                if (!region.touches(lower_end, line)) return std::numeric_limits<double>::infinity();
                const double nearest =
                    -dot(lower_end - region.camera, view.back) - std::max(0.0, dot(line, view.back)) - region.approach;
                // A little less, so that rounding leaves the decision to is_streak.
                const double least = (1 - 1e-6) * settings.min_width_pixels * nearest / view.focal_pixels;
                return least / widening(settings, nearest);
            };
            const auto keep = [&](const Drop& drop) {
                const double depth = mid_depth(drop);
                if (is_streak(drop, depth) && region.touches(drop.position, {}))
                    found[block].push_back(
                        streak_of(drop, population, view, painted_widening(settings, view, drop.diameter, depth)));
            };
            visit_drops(population, size_class, index, view.shutter_open, max_intensity, least_diameter, keep);
        }
    });

    std::vector<Streak> streaks;
    for (const std::vector<Streak>& part : found) streaks.insert(streaks.end(), part.begin(), part.end());
    sort_by_depth(streaks, float(view.exposure_time));
    return streaks;
}

}  // namespace pluvia
