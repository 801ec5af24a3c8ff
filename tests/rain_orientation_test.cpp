// How streaks lie on the picture: where they point, how long they are for their width, how sparse they are.
#include "renderer/rain/drop_population.h"
#include "renderer/rain/drop_size.h"
#include "renderer/rain/streaks.h"
#include "tests/statistics.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

namespace pluvia {
namespace {

/// Looks north and so many radians up.
View view_up(double pitch) {
    View view;
    view.width = 512, view.height = 256;
    view.focal_pixels = 500;
    view.position = {0, 300, 0};
    view.back = {0, -std::sin(pitch), std::cos(pitch)};
    view.up = cross(view.back, view.right);
    return view;
}

RainSettings rain(double min_width) {
    RainSettings settings;
    settings.intensities_mm_per_h = {100};
    settings.min_width_pixels = min_width;
    return settings;
}

/// Fourth moment of the differences between neighbours in a row over the square of their second; 3 if they were normal.
double gradient_kurtosis(const std::vector<float>& plane, int width) {
    double second = 0, fourth = 0, count = 0;
    for (size_t i = 0; i + 1 < plane.size(); ++i) {
        if (int(i % size_t(width)) == width - 1) continue;
        const double d = double(plane[i + 1]) - plane[i];
        second += d * d, fourth += d * d * d * d, ++count;
    }
    return fourth * count / (second * second);
}

}  // namespace

TEST_CASE("in still air streaks are upright for a level camera and run towards the nadir for one that looks up") {
    for (const double pitch : {0.0, 0.3, -0.6}) {
        CAPTURE(pitch);
        const View view = view_up(pitch);
        int count = 0;
        for (const Streak& streak : find_streaks(view, rain(1))) {
            const Vec3 end = streak.start + streak.velocity * float(view.exposure_time);
            if (streak.start.z < 0.2f || end.z < 0.2f) continue;
            const Vec2 a = view.pixel_from_view(streak.start), b = view.pixel_from_view(end);
            // Straight down in view coordinates is (0, -cos, -sin): on the picture cot(pitch) below the centre.
            const double x = a.x - view.width / 2.0, y = a.y - view.height / 2.0;
            const double to_x = -x * std::sin(pitch), to_y = -view.focal_pixels * std::cos(pitch) - y * std::sin(pitch);
            const double along_x = b.x - a.x, along_y = b.y - a.y;
            const double sine =
                (along_x * to_y - along_y * to_x) / (std::hypot(along_x, along_y) * std::hypot(to_x, to_y));
            CHECK(std::abs(sine) < 1e-3);
            ++count;
        }
        CHECK(count > 150);
    }
}

TEST_CASE("streaks of some width have the lengths that Marshall and Palmer's drops fall in the exposure") {
    // Length over width is fall speed times exposure over diameter; drops of each size are seen in a volume that grows
    // with the cube of their diameter.
    const View view = view_up(0);
    constexpr double min_width = 0.25, near = 0.1;
    const std::array<double, 9> edges = {3e-4, 6e-4, 9e-4, 1.2e-3, 1.5e-3, 1.8e-3, 2.2e-3, 2.8e-3, 6e-3};  // m
    const auto ratio = [&](double diameter) { return fall_speed(diameter) * view.exposure_time / diameter; };
    std::array<double, 8> expected = {}, found = {};
    constexpr int seeds = 8, steps = 400;
    for (size_t bin = 0; bin < expected.size(); ++bin)
        for (int i = 0; i < steps; ++i) {
            const double d1 = edges[bin] + (edges[bin + 1] - edges[bin]) * i / steps;
            const double d2 = edges[bin] + (edges[bin + 1] - edges[bin]) * (i + 1) / steps;
            const double far = view.focal_pixels * (d1 + d2) / 2 / min_width;
            const double volume = view.width * view.height / (view.focal_pixels * view.focal_pixels) *
                                  (far * far * far - near * near * near) / 3;
            expected[bin] += seeds * volume * number_density(100, d1, d2);
        }
    for (int seed = 0; seed < seeds; ++seed) {
        RainSettings settings = rain(min_width);
        settings.seed = uint64_t(seed);
        for (const Streak& streak : find_streaks(view, settings)) {
            const Vec2 middle = view.pixel_from_view(streak.start + streak.velocity * float(view.exposure_time / 2));
            if (middle.x < 0 || middle.y < 0 || middle.x >= float(view.width) || middle.y >= float(view.height))
                continue;
            const Vec3 end = streak.start + streak.velocity * float(view.exposure_time);
            if (end.z <= 0) continue;
            const Vec2 a = view.pixel_from_view(streak.start), b = view.pixel_from_view(end);
            const double width = 2 * streak.radius * view.focal_pixels / streak.start.z;
            const double length_over_width = std::hypot(b.x - a.x, b.y - a.y) / width;
            for (size_t bin = 0; bin < found.size(); ++bin)
                found[bin] += length_over_width <= ratio(edges[bin]) && length_over_width > ratio(edges[bin + 1]);
        }
    }
    for (size_t bin = 0; bin < expected.size(); ++bin) {
        CAPTURE(bin);
        CAPTURE(expected[bin]);
        CAPTURE(found[bin]);
        CHECK(expected[bin] > 30);
        CHECK(std::abs(found[bin] - expected[bin]) < 5 * std::sqrt(expected[bin]) + 1);
    }
}

TEST_CASE("streaks are sparse: the rain layer's gradients have long tails, the longer the less it rains") {
    View view = view_up(0.5);
    view.width = 256, view.height = 128;
    RenderSettings settings;
    settings.samples = 16;
    settings.rain.intensities_mm_per_h = {10, 100};
    settings.rain.min_width_pixels = 1;
    const Picture picture = render_picture(Scene(), Environment::uniform(Rgb(1)), view, settings);
    const double light = gradient_kurtosis(picture.plane("rain_010.A"), view.width);
    const double heavy = gradient_kurtosis(picture.plane("rain_100.A"), view.width);
    CAPTURE(light);
    CAPTURE(heavy);
    CHECK(heavy > 10);
    CHECK(light > 2 * heavy);
}

}  // namespace pluvia
