#include "renderer/rain/rain_statistics.h"

#include "renderer/rain/drop_size.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace pluvia {
namespace {

constexpr double water_density = 1000;  // kg/m3

double smallest_streak(const View& view, const RainSettings& settings, double z) {
    return std::max(smallest_drop, settings.min_width_pixels * z / view.focal_pixels);
}

/// Integral of f from a to b by the midpoint rule.
template <class F>
double integrate(double a, double b, const F& f) {
    constexpr int steps = 4000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) sum += f(a + (b - a) * (i + 0.5) / steps);
    return b > a ? sum * (b - a) / steps : 0;
}

}  // namespace

RainStatistics rain_statistics(double intensity) {
    RainStatistics s;
    s.visibility = std::numeric_limits<double>::infinity();
    if (intensity <= 0) return s;
    s.drops_per_m3 = number_density(intensity);
    const double water = size_moment(intensity, 3);
    s.liquid_water = water_density * std::numbers::pi / 6 * water;
    double low = smallest_drop, high = largest_drop;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (size_moment(intensity, 3, smallest_drop, middle) < water / 2 ? low : high) = middle;
    }
    s.median_volume_diameter = low;
    s.extinction = extinction(intensity);
    s.visibility = -std::log(0.02) / s.extinction;
    s.volume_flux = rain_rate(intensity);
    return s;
}

double expected_streaks(const View& view, const RainSettings& settings, double intensity) {
    const double farthest = largest_drop * view.focal_pixels / settings.min_width_pixels;
    const double sum = integrate(settings.near, farthest, [&](double z) {
        return z * z * number_density(intensity, smallest_streak(view, settings, z), largest_drop);
    });
    return sum * view.width * view.height / (view.focal_pixels * view.focal_pixels);
}

double resolved_share(const View& view, const RainSettings& settings, double intensity, double distance) {
    if (intensity <= 0 || distance <= settings.near) return 0;
    const double resolved = integrate(settings.near, distance, [&](double z) {
        return extinction(intensity, smallest_streak(view, settings, z), largest_drop);
    });
    return resolved / (extinction(intensity) * (distance - settings.near));
}

}  // namespace pluvia
