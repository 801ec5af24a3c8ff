#include "shaders/streak_tracing.h"

#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "renderer/core/units.h"
#include "shaders/drop_trace.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace pluvia {
namespace {

constexpr double fall_speed_of_drop = 5.2;  // m/s: Kessler 1969, 130 sqrt(D)

/// Lights whose disc may hold a direction, looked up by elevation and azimuth in cells of about two degrees.
class LightFinder {
public:
    explicit LightFinder(float radius) : min_cosine_(std::cos(radius)) {
        for (int i = 0; i < streak_light_count; ++i) directions_[size_t(i)] = streak_light(i).direction();
        cells_.resize(size_t(rows) * columns);
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const float y = -1 + (float(row) + 0.5f) * 2 / rows, level = std::sqrt(1 - y * y);
                const float azimuth = -pi + (float(column) + 0.5f) * 2 * pi / columns;
                const Vec3 middle(level * std::sin(azimuth), y, level * std::cos(azimuth));
                // Cells are even in y: near the axis they reach far in elevation.
                const float y_end = std::abs(y) + 1.0f / rows,
                            reach_up = std::asin(std::min(1.0f, y_end)) - std::asin(std::abs(y));
                const float reach = radius + reach_up + 2 * pi / columns;
                for (int i = 0; i < streak_light_count; ++i)
                    if (dot(directions_[size_t(i)], middle) > std::cos(reach))
                        cells_[size_t(row) * columns + column].push_back(uint8_t(i));
            }
    }
    template <class Visit>
    void visit(Vec3 direction, Visit&& visit) const {
        const int row = std::clamp(int((direction.y + 1) * (rows / 2)), 0, rows - 1);
        const float azimuth = std::atan2(direction.x, direction.z);
        const int column = std::clamp(int((azimuth + pi) * (columns / (2 * pi))), 0, columns - 1);
        for (const uint8_t light : cells_[size_t(row) * columns + column])
            if (dot(directions_[light], direction) > min_cosine_) visit(light);
    }

private:
    static constexpr int rows = 128, columns = 180;
    float min_cosine_;
    std::array<Vec3, streak_light_count> directions_;
    std::vector<std::vector<uint8_t>> cells_;
};

/// Point i of a sequence that fills a cube evenly. Source: Roberts 2018, sequence R3.
struct CubePoint {
    double u, w, t;
};
CubePoint cube_point(uint64_t i, uint64_t start) {
    const auto fraction = [&](uint64_t step, uint64_t axis) {
        return double((hash_key(start, axis) + i * step) >> 11) * 0x1p-53;
    };
    return {fraction(0xd1b54a32d192ed03, 0), fraction(0xabc98388fb8fac03, 1), fraction(0x8cb92ba72f3d8dd7, 2)};
}

struct Geometry {
    Vec3 direction, right, up;       // of the camera's rays; of its picture
    double half_width, half_height;  // of the drop's silhouette at rest, radii
    double path;                     // of the drop over the picture, radii
    int rows;
};

Geometry geometry_of(double view, int width) {
    const double c = std::cos(view), s = std::sin(view), radius = streak_diameter / 2;
    const double q = equilibrium_axis_ratio(1000 * streak_diameter);
    const double wide = std::pow(q, -1.0 / 3), high = std::pow(q, 2.0 / 3);
    Geometry g;
    g.direction = Vec3(0, float(-s), float(-c));
    g.right = Vec3(1, 0, 0);
    g.up = Vec3(0, float(c), float(-s));
    g.half_width = wide;
    g.half_height = std::sqrt(c * c * high * high + s * s * wide * wide);
    g.path = fall_speed_of_drop * streak_exposure * c / radius;
    g.rows = int(std::ceil((g.path + 2 * g.half_height) / (2 * wide / width)));
    return g;
}

}  // namespace

int streak_rows(int view, int width) {
    return geometry_of(radians_from_degrees(streak_views[size_t(view)]), width).rows;
}

DropOscillation streak_oscillation(uint64_t seed, int index) {
    const uint64_t key = hash_key(seed, 0x73747265616b, index);
    DropOscillation drop = drop_oscillation(streak_diameter / 2, key);
    drop.amplitude2 = 0.04 + 0.10 * unit_double(hash_key(key, 11));
    drop.amplitude3 = 0.02 + 0.04 * unit_double(hash_key(key, 12));
    return drop;
}

StreakDatabase trace_streaks(const StreakTracing& settings, const std::function<void(double)>& progress) {
    const LightFinder finder(settings.light_radius);
    const double solid_angle = 2 * std::numbers::pi * (1 - std::cos(double(settings.light_radius)));
    StreakDatabase database;
    for (auto& view : database.views) view.pictures.resize(size_t(streak_light_count) * streak_oscillations);
    std::atomic<int> done = 0;
    const int tasks = int(streak_views.size()) * streak_oscillations;
    parallel_in_order(tasks, [&](int task) {
        const int v = task / streak_oscillations, oscillation = task % streak_oscillations;
        const Geometry g = geometry_of(radians_from_degrees(streak_views[size_t(v)]), settings.width);
        const int width = settings.width;
        const size_t pixels = size_t(width) * g.rows;
        const DropOscillation drop = streak_oscillation(settings.seed, oscillation);
        std::vector<float> sums((streak_light_count + 1) * pixels);
        const uint64_t rays = pixels * uint64_t(settings.rays_per_pixel), start = hash_key(settings.seed, task);
        for (uint64_t i = 0; i < rays; ++i) {
            const CubePoint p = cube_point(i, start);
            const double u = 2 * p.u - 1, w = 2 * p.w - 1;
            if (u * u + w * w >= 1.3) continue;  // beside the drop however it oscillates
            const int column = std::min(int(p.u * width), width - 1);
            const double fallen = p.t * g.path + g.half_height * (1 - w);
            const int row = std::min(int(fallen * width / (2 * g.half_width)), g.rows - 1);
            const Vec3 origin = g.right * float(u * g.half_width) + g.up * float(w * g.half_height);
            float* const pixel = sums.data() + size_t(row) * width + column;
            for (const DropExit& exit : trace_drop(drop.at(p.t * streak_exposure), origin, g.direction).all()) {
                finder.visit(exit.direction, [&](int light) { pixel[size_t(light) * pixels] += exit.weight; });
                if (exit.direction.y > 0) pixel[streak_light_count * pixels] += exit.weight;
            }
        }
        // Every pixel would hold the share of its stay that the drop covers it, if all exits were counted.
        const double scale = width * g.path / (double(rays) * (2 * g.half_width / width));
        StreakDatabase::View& view = database.views[size_t(v)];
        view.width = width, view.height = g.rows;
        std::vector<float> values(pixels);
        for (int light = 0; light <= streak_light_count; ++light) {
            const double unit = light < streak_light_count ? scale / solid_angle : scale;
            for (size_t i = 0; i < pixels; ++i) values[i] = float(sums[size_t(light) * pixels + i] * unit);
            (light < streak_light_count ? view.pictures[size_t(light * streak_oscillations + oscillation)]
                                        : view.ambient[size_t(oscillation)]) = picture_from(values);
        }
        progress(double(++done) / tasks);
    });
    return database;
}

}  // namespace pluvia
