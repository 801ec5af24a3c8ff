// Drops out of focus: the lens spreads a streak over its circle of confusion and takes nothing away.
#include "renderer/core/sampling.h"
#include "renderer/rain/drop_size.h"
#include "renderer/rain/streak_bins.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace pluvia;

namespace {

/// Mean coverage at a pixel position over an even grid of n x n points of the lens.
double mean_coverage(const StreakBins& bins, const View& view, Vec2 pixel, int n) {
    std::vector<StreakHit> hits;
    std::vector<uint32_t> candidates;
    bins.find_candidates(int(pixel.x), int(pixel.y), candidates);
    double sum = 0;
    for (int i = 0; i < n * n; ++i) {
        const Vec2 p = sample_disk({(float(i % n) + 0.5f) / float(n), (float(i / n) + 0.5f) / float(n)});
        const Vec3 origin = Vec3(p.x, p.y, 0) * float(view.lens_radius);
        const Ray ray{origin, normalize(view.view_direction(pixel) * float(view.focus_distance) - origin)};
        find_hits(bins, candidates, pixel, ray, hits);
        for (const StreakHit& hit : hits) sum += hit.covered.fraction();
    }
    return sum / (n * n);
}

}  // namespace

TEST_CASE("a drop out of focus is its chord spread over the circle of confusion") {
    // 35 mm lens at f/2 on a sensor 36 mm wide, in focus at 10 m; a drop of 2 mm at 1 m is then blurred over 31 pixels.
    View view;
    view.width = 2048, view.height = 1024;
    view.focal_pixels = 35.0 / 36 * 2048;
    view.lens_radius = 0.035 / 4, view.focus_distance = 10;
    const double diameter = 2e-3, speed = fall_speed(diameter), path = speed * view.exposure_time;
    const double blur = view.blur_radius_pixels(1), radius = diameter / 2 * view.focal_pixels;
    CHECK(2 * blur == doctest::Approx(31.4).scale(0).epsilon(0.005));
    const Streak streak{{0, float(path / 2), 1}, {0, float(-speed), 0}, float(diameter / 2), 1, 1};
    const StreakBins bins({streak}, view);

    double summed = 0;
    for (int x = -20; x <= 20; ++x) {
        // The middle of a streak much longer than the blur: only the lens's width matters, its chord at each place.
        double expected = 0;
        constexpr int steps = 4000;
        for (int i = 0; i < steps; ++i) {
            const double s = blur * (2 * (i + 0.5) / steps - 1), u = (x - s) / radius;
            if (std::abs(u) >= 1) continue;
            const double share = 2 / (std::numbers::pi * blur * blur) * std::sqrt(blur * blur - s * s);
            expected += share * (2 * blur / steps) * diameter / path * std::sqrt(1 - u * u);
        }
        const double measured = mean_coverage(bins, view, {1024.0f + float(x), 512}, 256);
        CAPTURE(x);
        CAPTURE(expected);
        CAPTURE(measured);
        const double middle = diameter / path * radius / blur;  // of the profile
        CHECK(std::abs(measured - expected) < 0.05 * middle);
        summed += measured;
    }
    // As much is covered across the streak as in focus: the area of the chord.
    CHECK(summed == doctest::Approx(std::numbers::pi / 4 * 2 * radius * diameter / path).scale(0).epsilon(0.01));
}
