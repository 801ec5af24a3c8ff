// Rain: what it takes from light that passes it, and where a single drop sends light.
#include "renderer/core/random.h"
#include "renderer/core/units.h"
#include "renderer/rain/drop_population.h"
#include "renderer/rain/drop_size.h"
#include "shaders/fresnel.h"
#include "shaders/raindrop.h"
#include "tools/validate/closed_forms.h"
#include "tools/validate/known_scenes.h"
#include "tools/validate/running_mean.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace pluvia {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct DropRay {
    double cos_turn;  // between the directions before and after
    double light;     // share
};

/// Follows one ray through a sphere of water: vectors, Snell's law and Fresnel's for each polarisation. impact:
/// distance from the axis in radii, below 1. Calls leave for every way out, until less than 1e-9 of the light is left.
template <class Leave>
void trace_drop(double impact, Leave&& leave) {
    constexpr double n = water_ior;
    const Vec3d before(0, 0, 1), entry(impact, 0, -std::sqrt(1 - impact * impact));
    const double i = std::asin(impact), t = std::asin(impact / n);
    const auto reflectance = [&](double sign) {  // of s and p; sines and tangents of sum and difference
        if (impact < 1e-7) return std::pow((n - 1) / (n + 1), 2);
        return sign > 0 ? std::pow(std::sin(i - t) / std::sin(i + t), 2)
                        : std::pow(std::tan(i - t) / std::tan(i + t), 2);
    };
    const double r[2] = {reflectance(1), reflectance(-1)};
    const Vec3d mirrored = before - entry * (2 * dot(before, entry));
    leave(DropRay{dot(mirrored, before), (r[0] + r[1]) / 2});
    // Inside: Snell's law in vectors.
    Vec3d inside = before / n + entry * (std::cos(i) / n - std::cos(t));
    Vec3d position = entry;
    double left[2] = {1 - r[0], 1 - r[1]};
    while (left[0] + left[1] > 1e-9) {
        // The chord's other end; near the rim there are so many that rounding would add up.
        position = normalize(position + inside * (-2 * dot(position, inside)));
        const double cosine = dot(inside, position);
        const Vec3d out = inside * n + position * (std::cos(i) - n * cosine);
        leave(DropRay{dot(out, before), (left[0] * (1 - r[0]) + left[1] * (1 - r[1])) / 2});
        inside = normalize(inside - position * (2 * cosine));
        for (int k = 0; k < 2; ++k) left[k] *= r[k];
    }
}

/// Share of light that the phase function turns by low to high degrees.
double phase_share(double low, double high) {
    constexpr int steps = 20000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double theta = (low + (high - low) * (i + 0.5) / steps) * degree;
        sum += double(drop_phase(float(std::cos(theta)))) * std::sin(theta);
    }
    return sum * 2 * std::numbers::pi * (high - low) * degree / steps;
}

/// Radiance of drops narrower than a pixel, in a world with 1 - its cosine to the view axis. The view leaves the rain
/// from above within 6 m, all of whose drops are streaks: nothing else takes or adds light.
Estimate drops_in_uneven_world(uint64_t seed) {
    const double elevation = 30 * degree, near = 5, end = 11;
    const Vec3d axis(0, std::sin(elevation), -std::cos(elevation));
    Image<Rgb> world(512, 256);
    for (int y = 0; y < world.height; ++y)
        for (int x = 0; x < world.width; ++x) {
            const Vec3d d(direction_from_equirectangular((x + 0.5) / world.width, (y + 0.5) / world.height));
            world.at(x, y) = Rgb(float(1 - dot(d, axis)));
        }
    Scene ground;  // a speck that says above what it rains
    add_quad(ground, {0, 0, 0}, {1e-3f, 0, 0}, {0, 0, -1e-3f}, lambert(Rgb(0)));
    const Vec3d eye(0, rain_height - end * std::sin(elevation), 0);
    const View view = look_at(eye, eye + axis, 32, 16, 1000);
    RenderSettings settings{.samples = 256};
    settings.rain.intensities_mm_per_h = {1000};
    settings.rain.near = near;
    settings.rain.min_width_pixels = 0.02;
    RunningMean brightness;
    for (int k = 0; k < 12; ++k) {
        settings.seed = settings.rain.seed = seed + uint64_t(k);
        const Picture picture = render_picture(ground, Environment(world), view, settings);
        brightness.add(picture.mean("rain_1000.G") / picture.mean("rain_1000.A"));
    }
    return {brightness.mean(), brightness.standard_error()};
}

}  // namespace

std::vector<ClosedFormResult> measure_rain(uint64_t seed) {
    // A card behind rain; streaks are drops at least so many pixels wide.
    constexpr double distance = 6, width = 0.04;
    std::vector<ClosedFormResult> results;
    for (const double intensity : {100.0, 1000.0}) {
        Scene scene;
        add_quad(scene, {-100, 400, float(-distance)}, {200, 0, 0}, {0, 200, 0}, emitter(Rgb(1)));
        const View view = look_at({0, 500, 0}, {0, 500, -1}, 32, 16, 64);
        RenderSettings settings{.samples = 16};
        settings.rain.intensities_mm_per_h = {intensity};
        settings.rain.min_width_pixels = width;
        RunningMean passed;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const double stretch = length(Vec3d(view.view_direction({float(x) + 0.5f, float(y) + 0.5f})));
                constexpr int steps = 500;
                const double step = (distance - settings.rain.near) / steps;
                double depth = 0;
                for (int i = 0; i < steps; ++i) {
                    const double z = settings.rain.near + (i + 0.5) * step;
                    const double smallest = std::max(smallest_drop, width * z / view.focal_pixels);
                    depth += extinction(intensity, smallest, largest_drop) * stretch * step;
                }
                passed.add(std::exp(-depth));
            }
        const Estimate covered =
            estimate(scene, Environment(), view, settings, fmt::format("rain_{:03}.A", int(intensity)), 24, seed);
        results.push_back(rendered_result(
            fmt::format("light that passes the streaks of {} m of rain of {} mm/h: Beer-Lambert", distance, intensity),
            passed.mean(), 1e-5, {1 - covered.mean, covered.standard_error}));
    }
    return results;
}

std::vector<ClosedFormResult> measure_drops(uint64_t seed) {
    struct Range {
        double low, high;
        RunningMean share;
    };
    std::vector<Range> ranges;
    for (const auto& [low, high] :
         {std::pair{0.0, 15.0}, {15.0, 30.0}, {30.0, 45.0}, {45.0, 60.0}, {60.0, 80.0}, {137.0, 145.0}})
        ranges.push_back({low, high, {}});
    RunningMean asymmetry;
    constexpr int sets = 16, rays = 40'000;
    for (int set = 0; set < sets; ++set) {
        std::vector<double> sums(ranges.size(), 0.0);
        double cosines = 0;
        for (int ray = 0; ray < rays; ++ray) {
            // Even light on the drop's disk, one ray in each of many rings of equal area.
            const double u = unit_float(hash_key(seed, uint64_t(set), uint64_t(ray)));
            trace_drop(std::sqrt((ray + u) / rays), [&](const DropRay& out) {
                const double cosine = std::clamp(out.cos_turn, -1.0, 1.0), turn = std::acos(cosine) / degree;
                cosines += out.light * cosine / rays;
                for (size_t r = 0; r < ranges.size(); ++r)
                    if (turn >= ranges[r].low && turn < ranges[r].high) sums[r] += out.light / rays;
            });
        }
        for (size_t r = 0; r < ranges.size(); ++r) ranges[r].share.add(sums[r]);
        asymmetry.add(cosines);
    }
    std::vector<ClosedFormResult> results;
    // The phase function sends light that is reflected inside six times or more, 0.05 % of all, one way.
    for (const Range& r : ranges)
        results.push_back(
            {fmt::format("light that a drop turns by {} to {} degrees, against traced rays", r.low, r.high),
             r.share.mean(), phase_share(r.low, r.high), r.share.standard_error(), 5e-4});
    results.push_back({"mean cosine of the turn, against traced rays", asymmetry.mean(), drop_asymmetry(),
                       asymmetry.standard_error(), 5e-4});
    const Estimate drops = drops_in_uneven_world(seed);
    results.push_back({"drops rendered in a world of 1 - cosine to the view: 1 - mean cosine of traced rays",
                       1 - asymmetry.mean(), drops.mean, drops.standard_error, 5e-4});
    return results;
}

}  // namespace pluvia
