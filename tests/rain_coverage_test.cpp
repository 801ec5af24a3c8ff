#include "renderer/rain/coverage.h"

#include "renderer/core/view.h"
#include "renderer/rain/drop_size.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <bitset>
#include <cmath>
#include <numbers>

using namespace pluvia;

namespace {

// Distance of the drop's centre from the ray's line at a fraction of the exposure.
double distance_from_ray(const Streak& streak, const Ray& ray, double exposure, double fraction) {
    const Vec3d w = Vec3d(streak.start) + Vec3d(streak.velocity) * (exposure * fraction) - Vec3d(ray.origin);
    return length(cross(w, Vec3d(ray.direction))) / length(Vec3d(ray.direction));
}

// A drop near a random ray, so that most pairs meet.
struct Meeting {
    Streak streak;
    Ray ray;
};
Meeting random_meeting(uint64_t key, float exposure) {
    const auto u = [&](uint64_t n) { return uniform(key, 0, n); };
    Meeting m;
    m.ray.origin = {0.01f * u(0), 0.01f * u(1), 0};
    m.ray.direction = normalize(Vec3(u(2) - 0.5f, u(3) - 0.5f, 1));
    m.streak.radius = 0.0001f + 0.0029f * u(4);
    m.streak.velocity = Vec3(20 * u(5) - 10, -2 - 8 * u(6), 20 * u(7) - 10);
    const Vec3 aside = (Vec3(u(8), u(9), u(10)) - Vec3(0.5f, 0.5f, 0.5f)) * (4 * m.streak.radius);
    const float when = 1.4f * u(11) - 0.2f;
    m.streak.start = m.ray.at(0.5f + 10 * u(12)) + aside - m.streak.velocity * (when * exposure);
    m.streak.threshold_mm_per_h = 1;
    m.streak.key = key;
    return m;
}

Streak falling_streak(double diameter, double depth, double speed, double exposure) {
    const float v = float(speed);
    return {{0, float(speed * exposure / 2), float(depth)}, {0, -v, 0}, float(diameter / 2), 1, 1};
}

// Sum over pixels of the covered fraction, by n x n rays in each of the pixels around the streak.
double summed_coverage(const View& view, const Streak& streak, int n) {
    const float exposure = float(view.exposure_time);
    const Vec2 a = view.pixel_from_view(streak.start);
    const Vec2 b = view.pixel_from_view(streak.start + streak.velocity * exposure);
    const float margin = 3 + 2 * streak.radius * float(view.focal_pixels) / streak.start.z;
    double sum = 0;
    for (int y = int(std::min(a.y, b.y) - margin); float(y) < std::max(a.y, b.y) + margin; ++y)
        for (int x = int(std::min(a.x, b.x) - margin); float(x) < std::max(a.x, b.x) + margin; ++x)
            for (int i = 0; i < n * n; ++i) {
                const Vec2 pixel{float(x) + (float(i % n) + 0.5f) / float(n),
                                 float(y) + (float(i / n) + 0.5f) / float(n)};
                const Ray ray{{}, normalize(view.view_direction(pixel))};
                if (const auto covered = covered_interval(streak, ray, exposure)) sum += covered->fraction();
            }
    return sum / (n * n);
}

// Far and long, so that perspective changes the drop's outline by less than 1e-4 along the streak.
View long_lens() {
    View view;
    view.width = 400;
    view.height = 600;
    view.focal_pixels = 20000;
    return view;
}

}  // namespace

TEST_CASE("at the ends of the covered interval the drop touches the ray, in between it covers it") {
    const float exposure = 1.0f / 60;
    int met = 0;
    for (uint64_t i = 0; i < 100000; ++i) {
        const auto [streak, ray] = random_meeting(i, exposure);
        const auto covered = covered_interval(streak, ray, exposure);
        if (!covered) {
            for (int step = 0; step <= 8; ++step)  // nothing was overlooked
                if (distance_from_ray(streak, ray, exposure, step / 8.0) < streak.radius * (1 - 1e-6))
                    FAIL("pair " << i << " covers at " << step / 8.0);
            continue;
        }
        ++met;
        // A fraction rounds by 6e-8, in which the drop moves at most 25 m/s * 6e-8 / 60 = 2.5e-8 m.
        const auto touches = [&](float fraction, float limit) {
            const double d = distance_from_ray(streak, ray, exposure, fraction);
            return fraction == limit ? d <= streak.radius + 3e-8 : std::abs(d - streak.radius) < 3e-8;
        };
        if (!(touches(covered->begin, 0) && touches(covered->end, 1))) FAIL("pair " << i << " does not end there");
        const double middle = 0.5 * (double(covered->begin) + double(covered->end));
        if (distance_from_ray(streak, ray, exposure, middle) > streak.radius) FAIL("pair " << i << " is not covered");
        const Vec3 centre = streak.start + streak.velocity * float(middle * exposure);
        if (length(ray.at(covered->distance) - centre) > streak.radius + 4e-6f) FAIL("pair " << i << " is elsewhere");
    }
    CHECK(met > 20000);
}

TEST_CASE("a drop that falls along the ray covers it throughout or never") {
    const Ray ray{{}, normalize(Vec3(0.2f, 0.1f, 1))};
    for (float speed : {0.0f, 1e-9f, -8.0f, 8.0f}) {
        CAPTURE(speed);
        Streak streak{ray.at(3), ray.direction * speed, 0.001f, 1, 1};
        const auto covered = covered_interval(streak, ray, 1.0f / 60);
        REQUIRE(covered);
        CHECK(covered->begin == 0);
        CHECK(covered->end == 1);
        CHECK(covered->distance == doctest::Approx(3 + speed / 120).epsilon(1e-6).scale(0));
        streak.start.x += 0.0011f;
        CHECK(!covered_interval(streak, ray, 1.0f / 60));
    }
    const Streak still = falling_streak(2e-3, 2, 5, 0);  // a shutter time of zero is an instant
    CHECK(covered_interval(still, Ray{{}, {0, 0, 1}}, 0)->fraction() == 1);
}

TEST_CASE("a drop behind the camera covers nothing, one that passes by only while it is in front") {
    const Ray ray{{}, {0, 0, 1}};
    CHECK(!covered_interval({{0, 0, -1}, {0, 0, -1}, 0.001f, 1, 1}, ray, 0.01f));
    const Streak approaching{{0, 0, 0.104f}, {0, 0, -20}, 0.001f, 1, 1};  // 4 mm away at half of 0.01 s
    const auto covered = covered_interval(approaching, ray, 0.01f);
    REQUIRE(covered);
    CHECK(covered->begin == 0);
    CHECK(covered->end == doctest::Approx(0.5).epsilon(1e-6));
    const Streak leaving{{0, 0, -0.096f}, {0, 0, 20}, 0.001f, 1, 1};
    CHECK(covered_interval(leaving, ray, 0.01f)->begin == doctest::Approx(0.5).epsilon(1e-6));
}

TEST_CASE("in the middle of a streak a drop covers D / (v T) of the exposure") {
    for (double d : {0.5e-3, 1e-3, 2e-3, 4e-3}) {
        const double v = fall_speed(d), exposure = 1.0 / 60;
        const auto covered = covered_interval(falling_streak(d, 4, v, exposure), Ray{{}, {0, 0, 1}}, float(exposure));
        REQUIRE(covered);
        CHECK(covered->fraction() == doctest::Approx(d / (v * exposure)).epsilon(1e-5).scale(0));
        CHECK((covered->begin + covered->end) / 2 == doctest::Approx(0.5).epsilon(1e-6));
    }
}

TEST_CASE("coverage summed over pixels is the area of the drop's disk, whatever its speed") {
    const View view = long_lens();
    for (double d : {0.3e-3, 2e-3})
        for (double speed : {0.5, 3.0, 5.8}) {
            CAPTURE(d);
            CAPTURE(speed);
            const double width = d * view.focal_pixels / 10;
            // Rays on a grid of 1/32 pixel measure the smaller disk, 0.6 pixels wide, to about 1 in 1000.
            const int n = d < 1e-3 ? 32 : 12;
            CHECK(summed_coverage(view, falling_streak(d, 10, speed, view.exposure_time), n) ==
                  doctest::Approx(std::numbers::pi / 4 * width * width).epsilon(2e-3).scale(0));
        }
}

TEST_CASE("doubling the exposure halves the coverage in the middle and keeps its sum over pixels") {
    View view = long_lens();
    const auto middle = [](const Streak& streak, double exposure) {
        return covered_interval(streak, Ray{{}, {0, 0, 1}}, float(exposure))->fraction();
    };
    const double t = 1.0 / 120;
    const Streak once = falling_streak(2e-3, 10, 5.8, t), twice = falling_streak(2e-3, 10, 5.8, 2 * t);
    CHECK(middle(twice, 2 * t) == doctest::Approx(middle(once, t) / 2).epsilon(1e-5).scale(0));
    view.exposure_time = t;
    const double sum = summed_coverage(view, once, 12);
    view.exposure_time = 2 * t;
    CHECK(summed_coverage(view, twice, 12) == doctest::Approx(sum).epsilon(2e-3).scale(0));  // grid of 1/12 pixel
}

TEST_CASE("the union of intervals gives each drop exactly the time that no nearer drop took") {
    for (uint64_t seed = 0; seed < 300; ++seed) {
        constexpr int steps = 1024;  // interval ends on this grid are exact in float, so results must be equal
        std::bitset<steps> taken;
        ExposureUnion exposure;
        double sum = 0;
        const int count = 1 + int(seed % 60);
        const int longest = seed % 3 == 0 ? 400 : 12;  // few gaps, or more intervals than fit without the heap
        for (int i = 0; i < count; ++i) {
            const int begin = int(uniform(seed, i, 0) * (steps - 1));
            const int end = std::min(steps, begin + 1 + int(uniform(seed, i, 1) * float(longest)));
            int fresh = 0;
            for (int k = begin; k < end; ++k) {
                fresh += !taken[k];
                taken[k] = true;
            }
            const float weight = exposure.add(float(begin) / steps, float(end) / steps);
            CHECK(weight == float(fresh) / steps);
            sum += weight;
        }
        CHECK(exposure.total() == float(taken.count()) / steps);
        CHECK(sum + exposure.transmittance() == 1);
    }
}

TEST_CASE("weights of any intervals and what remains add up to one") {
    for (uint64_t seed = 0; seed < 300; ++seed) {
        ExposureUnion exposure;
        double sum = 0;
        for (int i = 0; i < 100; ++i) {
            const float begin = uniform(seed, i, 0);
            const float end = std::min(1.0f, begin + 0.05f * uniform(seed, i, 1) + 1e-6f);
            if (begin >= end) continue;
            const float weight = exposure.add(begin, end);
            CHECK(weight >= 0);
            sum += weight;
        }
        CHECK(exposure.transmittance() >= 0);
        CHECK(std::abs(sum + exposure.transmittance() - 1) < 1e-6);  // 100 weights rounded to float
    }
}
