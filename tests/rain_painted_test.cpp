// Streaks as "Learning from Rendering" paints them: too wide, not too far away, and fewer than there are.
#include "renderer/rain/drop_size.h"
#include "renderer/rain/streaks.h"

#include <doctest/doctest.h>

#include <cmath>
#include <unordered_map>

using namespace pluvia;

namespace {

constexpr double painted = 1.78;  // metres

View paper_view() {
    View view;
    view.width = 2048;
    view.height = 1024;
    view.focal_pixels = 1991;  // 35 mm lens on a 36 mm sensor
    view.position = {3, 300, -8};
    return view;
}

RainSettings painted_rain(double intensity) {
    RainSettings settings;
    settings.intensities_mm_per_h = {intensity};
    settings.min_width_pixels = 1;
    settings.painted_distance = painted;
    settings.seed = 11;
    return settings;
}

double middle_depth(const View& view, const Streak& s) {
    return s.start.z + s.velocity.z * view.exposure_time / 2;
}

bool starts_inside(const View& view, const Streak& s) {
    const double x = view.focal_pixels * s.start.x / s.start.z, y = view.focal_pixels * s.start.y / s.start.z;
    return std::abs(x) < view.width / 2.0 && std::abs(y) < view.height / 2.0;
}

TEST_CASE("painted streaks are as wide as at the painted distance, three pixels at least, and end five times as far") {
    const View view = paper_view();
    RainSettings true_rain = painted_rain(25);
    true_rain.painted_distance = 0;
    true_rain.min_width_pixels = 0.15;  // as wide as any that is painted truly is
    std::unordered_map<uint64_t, float> true_radius;
    for (const Streak& s : find_streaks(view, true_rain)) true_radius[s.key] = s.radius;
    int widened = 0, floored = 0, beyond = 0;
    for (const Streak& s : find_streaks(view, painted_rain(25))) {
        const double z = middle_depth(view, s), width = 2 * s.radius * view.focal_pixels / z;
        if (!starts_inside(view, s)) continue;  // the wider may be seen where the true one is not
        REQUIRE(true_radius.contains(s.key));
        const double as_at = 2 * true_radius[s.key] * view.focal_pixels / std::min(z, painted);
        CHECK(as_at >= 1 - 1e-5);
        CHECK(width == doctest::Approx(std::max(as_at, 3.0)).epsilon(1e-5).scale(0));
        CHECK(z <= 5 * painted);
        beyond += z > painted;
        (as_at < 3 ? floored : widened)++;
    }
    CHECK(beyond > 1000);
    CHECK(widened > 20);
    CHECK(floored > 1000);
}

TEST_CASE("the number of painted streaks is the integral over the frustum, and the share of it that is asked for") {
    const View view = paper_view();
    for (double intensity : {10.0, 100.0}) {
        RainSettings settings = painted_rain(intensity);
        double expected = 0;
        const int steps = 4000;
        const double near = settings.near, far = 5 * painted, h = (far - near) / steps;
        for (int i = 0; i < steps; ++i) {
            const double z = near + (i + 0.5) * h;
            const double least = std::max(smallest_drop, std::min(z, painted) / view.focal_pixels);
            expected += z * z * number_density(intensity, least, largest_drop) * h;
        }
        expected *= view.width * view.height / (view.focal_pixels * view.focal_pixels);
        const auto count = [&] {
            double n = 0;
            for (const Streak& s : find_streaks(view, settings)) {
                // At mid-exposure, where the integral counts.
                Streak middle = s;
                middle.start += s.velocity * float(view.exposure_time / 2);
                n += starts_inside(view, middle);
            }
            return n;
        };
        const double all = count();
        CHECK(std::abs(all - expected) < 5 * std::sqrt(expected));
        settings.share = 0.1;
        const double some = count();
        CHECK(std::abs(some - 0.1 * all) < 5 * std::sqrt(0.1 * 0.9 * all));
    }
}

TEST_CASE("a picture half as wide shows the same painted streaks") {
    const View view = paper_view();
    View half = view;
    half.width /= 2, half.height /= 2, half.focal_pixels /= 2;
    const auto large = find_streaks(view, painted_rain(25)), small = find_streaks(half, painted_rain(25));
    REQUIRE(large.size() == small.size());
    bool same = true;
    for (size_t i = 0; i < large.size(); ++i)
        same &= large[i].key == small[i].key && large[i].radius == small[i].radius;
    CHECK(same);
}

TEST_CASE("a larger share keeps the streaks of a smaller one") {
    const View view = paper_view();
    RainSettings settings = painted_rain(10);
    settings.share = 0.3;
    std::unordered_map<uint64_t, float> more;
    for (const Streak& s : find_streaks(view, settings)) more[s.key] = s.radius;
    settings.share = 0.1;
    const auto fewer = find_streaks(view, settings);
    CHECK(fewer.size() > 100);
    for (const Streak& s : fewer) CHECK(more.contains(s.key));
}

}  // namespace
