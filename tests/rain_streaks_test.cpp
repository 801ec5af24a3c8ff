#include "renderer/rain/streaks.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/rain/drop_population.h"
#include "renderer/rain/drop_size.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <unordered_map>
#include <unordered_set>

using namespace pluvia;

namespace {

View small_view() {
    View view;
    view.width = 256;
    view.height = 128;
    view.focal_pixels = 249;  // 35 mm lens on a 36 mm sensor
    view.position = {12, 300, -40};
    return view;
}

// Turns the camera up by pitch and to the left by yaw, radians.
void turn(View& view, double yaw, double pitch) {
    const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
    view.right = {cy, 0, -sy};
    view.back = {sy * cp, -sp, cy * cp};
    view.up = cross(view.back, view.right);
}

RainSettings rain(double intensity, double min_width) {
    RainSettings settings;
    settings.intensities_mm_per_h = {intensity};
    settings.min_width_pixels = min_width;
    return settings;
}

bool same(const Streak& a, const Streak& b) {
    return a.start == b.start && a.velocity == b.velocity && a.radius == b.radius && a.key == b.key &&
           a.threshold_mm_per_h == b.threshold_mm_per_h;
}

// Number of drops in the frustum at one instant that are at least min_width wide and beyond near: the solid angle per
// depth times the number density of the large enough.
double expected_streaks(const View& view, double intensity, double min_width, double near) {
    const int steps = 4000;
    const double far = largest_drop * view.focal_pixels / min_width, h = (far - near) / steps;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double z = near + (i + 0.5) * h;
        const double least = std::max(smallest_drop, min_width * z / view.focal_pixels);
        sum += z * z * number_density(intensity, least, largest_drop) * h;
    }
    return sum * view.width * view.height / (view.focal_pixels * view.focal_pixels);
}

}  // namespace

TEST_CASE("the number of streaks of some width equals the integral over the frustum") {
    for (double intensity : {0.1, 10.0, 100.0, 500.0})
        for (double min_width : {0.25, 0.1})
            for (double pitch : {0.0, 1.2}) {
                CAPTURE(intensity);
                CAPTURE(min_width);
                CAPTURE(pitch);
                View view = small_view();
                turn(view, 0.7, pitch);
                double expected = 0;
                int found = 0;
                for (uint64_t seed = 0; seed < (min_width < 0.2 ? 2u : 20u); ++seed) {
                    RainSettings settings = rain(intensity, min_width);
                    settings.seed = seed;
                    settings.wind = {4, 0, 1};
                    expected += expected_streaks(view, intensity, min_width, settings.near);
                    for (const Streak& streak : find_streaks(view, settings)) {
                        const Vec3 middle = streak.start + streak.velocity * float(view.exposure_time / 2);
                        const Vec2 p = view.pixel_from_view(middle);
                        found += p.x >= 0 && p.y >= 0 && p.x < float(view.width) && p.y < float(view.height);
                    }
                }
                CAPTURE(expected);
                CAPTURE(found);
                CHECK(std::abs(found - expected) < 5 * std::sqrt(expected));
            }
}

TEST_CASE("the integral over the frustum is the closed form where drops of any size are seen") {
    View view;
    view.width = 2048;
    view.height = 1024;
    view.focal_pixels = 1991;
    // W H / f^2 N0 / beta 2 (f / (k beta))^3; cutting at 6 mm loses 1.0 % of it at 100 mm/h.
    const double beta = size_slope(100);
    const double whole = 0.5290 * 8e6 / beta * 2 * std::pow(1991 / beta, 3);
    CHECK(expected_streaks(view, 100, 1, 0.01) == doctest::Approx(whole).epsilon(0.02).scale(0));
}

/// By an angle in radians about an axis, as their product. Source: Rodrigues 1840.
Vec3d turned(Vec3d v, Vec3d rotation) {
    const double angle = length(rotation);
    if (angle == 0) return v;
    const Vec3d axis = rotation / angle;
    return v * std::cos(angle) + cross(axis, v) * std::sin(angle) + axis * (dot(axis, v) * (1 - std::cos(angle)));
}

TEST_CASE("the streaks of a turning camera are as near to the true paths as is said") {
    View view = small_view();
    view.velocity = view.back * -12.0;
    view.angular_velocity = {0.2, 0.5, -0.1};
    const double turn = length(view.angular_velocity) * view.exposure_time, f = view.focal_pixels;
    const DropPopulation population{rain(100, 0.25).seed, {}, 0};
    int compared = 0;
    for (const Streak& streak : find_streaks(view, rain(100, 0.25))) {
        // Back to the world by the streak's middle; there the drop falls straight.
        const Vec3d middle =
            view.world_vector_from_view(Vec3d(streak.start + streak.velocity * float(view.exposure_time / 2)));
        const Vec3d motion = drop_velocity(population, 2 * double(streak.radius)) - view.velocity;
        for (const double at : {-0.5, 0.5}) {
            const double time = at * view.exposure_time;
            const Vec3d world = turned(middle + motion * time, view.angular_velocity * -time);
            const Vec3d truth(dot(world, view.right), dot(world, view.up), -dot(world, view.back));
            const Vec3 path = streak.start + streak.velocity * float(time + view.exposure_time / 2);
            if (truth.z < 0.5 || std::hypot(truth.x, truth.y) > 0.3 * truth.z) continue;
            const Vec2 a = view.pixel_from_view(Vec3(truth)), b = view.pixel_from_view(path);
            const double moved = length(motion) * view.exposure_time;
            // Off the axis distances on the picture are stretched by up to 1 + tan^2.
            const double bound = 1.09 * f * (turn * turn / 8 * 1.05 + turn * moved / (4 * truth.z)) + 1e-3;
            CHECK(std::hypot(a.x - b.x, a.y - b.y) <= bound);
            ++compared;
        }
    }
    CHECK(compared > 500);
}

TEST_CASE("no drop is missed that is wide enough at mid-exposure and comes into the picture") {
    for (int test = 0; test < 8; ++test) {
        CAPTURE(test);
        View view = small_view();
        view.shutter_open = 1234.5;
        RainSettings settings = rain(100, 0.25);
        if (test >= 1) turn(view, 0.9, -0.4);
        if (test == 2) turn(view, -2, 1.5);
        if (test == 3) turn(view, 1, -1.5);
        if (test >= 2) settings.wind = {9, 0, -5};
        if (test == 4) view.velocity = {-20, 0, 25};
        if (test == 5) {
            view.lens_radius = 0.02;
            view.focus_distance = 1.5;
            view.velocity = view.back * 40.0;  // backwards: drops rush away
        }
        if (test == 6) view.angular_velocity = {0, 20, 0};  // a tenth of a turn in 1/30 s
        if (test == 7) view.angular_velocity = view.back * 15.0 + view.right * 8.0;
        std::unordered_set<uint64_t> found;
        for (const Streak& streak : find_streaks(view, settings)) {
            found.insert(streak.key);
            const double depth = streak.start.z + streak.velocity.z * view.exposure_time / 2;
            CHECK(depth >= settings.near * (1 - 1e-5));
            CHECK(2 * streak.radius * view.focal_pixels >= settings.min_width_pixels * depth * (1 - 1e-5));
        }
        int seen = 0, missed = 0;
        const DropPopulation population{settings.seed, settings.wind, settings.lowest_ground};
        const Vec3d camera = view.position - view.velocity * (view.exposure_time / 2);
        const double far = largest_drop * view.focal_pixels / settings.min_width_pixels;
        for (int c = 2; c < int(size_classes.size()); ++c) {
            const double reach = size_classes[c].d2 * view.focal_pixels / settings.min_width_pixels * 1.3 + 1;
            const Lattice lattice = lattice_at(population, c, view.shutter_open);
            const CellIndex first = lattice.cell_at(view.position - Vec3d(reach, reach, reach));
            const CellIndex last = lattice.cell_at(view.position + Vec3d(reach, reach, reach));
            for (int64_t z = first.z; z <= last.z; ++z)
                for (int64_t y = first.y; y <= last.y; ++y)
                    for (int64_t x = first.x; x <= last.x; ++x)
                        visit_drops(
                            population, c, {x, y, z}, view.shutter_open, 100, [](Vec3d) { return 0.0; },
                            [&](const Drop& drop) {
                                const Vec3d v = drop_velocity(population, drop.diameter) - view.velocity;
                                const auto at = [&](double time) {
                                    const Vec3d p = turned(drop.position - camera + v * time,
                                                           view.angular_velocity * (view.exposure_time / 2 - time));
                                    return Vec3d(dot(p, view.right), dot(p, view.up), -dot(p, view.back));
                                };
                                const double depth = at(view.exposure_time / 2).z;
                                if (depth < settings.near || depth > far ||
                                    drop.diameter * view.focal_pixels < settings.min_width_pixels * depth)
                                    return;
                                bool visible = false;
                                for (int step = 0; step <= 20; ++step) {
                                    const Vec3d p = at(view.exposure_time * step / 20);
                                    if (p.z < 2 * drop.diameter) continue;
                                    const Vec2 pixel = view.pixel_from_view(Vec3(p));
                                    const double wide =
                                        drop.diameter / 2 * view.focal_pixels / p.z + view.blur_radius_pixels(p.z);
                                    visible |= pixel.x > -wide && pixel.y > -wide && pixel.x < view.width + wide &&
                                               pixel.y < view.height + wide;
                                }
                                seen += visible;
                                missed += visible && !found.count(drop.key);
                            });
        }
        CHECK(seen > 200);
        CHECK(missed == 0);
    }
}

TEST_CASE("streaks of 10 mm/h are bit for bit the same when 100 mm/h is asked for as well") {
    View view = small_view();
    turn(view, 0.3, 0.2);
    RainSettings one = rain(10, 0.1), two = one;
    two.intensities_mm_per_h = {100, 10};
    const std::vector<Streak> alone = find_streaks(view, one);
    std::vector<Streak> among;
    for (const Streak& streak : find_streaks(view, two))
        if (streak.threshold_mm_per_h <= 10) among.push_back(streak);
    REQUIRE(alone.size() == among.size());
    CHECK(alone.size() > 500);
    for (size_t i = 0; i < alone.size(); ++i) CHECK(same(alone[i], among[i]));
}

TEST_CASE("streaks do not depend on the number of threads and are ordered by depth") {
    const View view = small_view();
    set_thread_count(1);
    const std::vector<Streak> serial = find_streaks(view, rain(100, 0.1));
    set_thread_count(4);
    const std::vector<Streak> parallel = find_streaks(view, rain(100, 0.1));
    set_thread_count(0);
    REQUIRE(serial.size() == parallel.size());
    for (size_t i = 0; i < serial.size(); ++i) CHECK(same(serial[i], parallel[i]));
    const float exposure = float(view.exposure_time);
    for (size_t i = 1; i < serial.size(); ++i)
        CHECK(nearest_depth(serial[i - 1], exposure) <= nearest_depth(serial[i], exposure));
}

TEST_CASE("a streak of the next frame starts where the drop has fallen to") {
    View view = small_view(), next = view;
    view.shutter_open = 500;
    next.shutter_open = 500 + 1.0 / 30;
    RainSettings settings = rain(100, 0.1);
    settings.wind = {2, 0, 1};
    std::unordered_map<uint64_t, Streak> later;
    for (const Streak& streak : find_streaks(next, settings)) later[streak.key] = streak;
    int shared = 0, elsewhere = 0;
    for (const Streak& streak : find_streaks(view, settings)) {
        const auto match = later.find(streak.key);
        if (match == later.end()) continue;
        ++shared;
        const Vec3 off = match->second.start - streak.start - streak.velocity * float(1.0 / 30);
        elsewhere += length(off) > 2e-5f;  // float positions up to 15 m, several roundings of 1e-6
    }
    CHECK(shared > 1000);
    CHECK(elsewhere < 0.02 * shared);  // those that jumped by a cell within two sixtieths of a second
}

TEST_CASE("wind slants streaks by its ratio to the fall speed, small drops most") {
    const View view = small_view();
    RainSettings settings = rain(100, 0.1);
    settings.wind = {3, 0, 0};
    for (const Streak& streak : find_streaks(view, settings)) {
        // 3 m/s: 46 degrees at 0.5 mm, 20 at 4 mm
        const double slope = streak.velocity.x / -streak.velocity.y;
        CHECK(slope == doctest::Approx(3 / fall_speed(2 * streak.radius)).epsilon(1e-5).scale(0));
    }
}

TEST_CASE("without rain there are no streaks") {
    RainSettings settings = rain(0, 1);
    CHECK(find_streaks(small_view(), settings).empty());
    settings.intensities_mm_per_h = {};
    CHECK(find_streaks(small_view(), settings).empty());
    settings = rain(100, 0.1);
    settings.lowest_ground = 400;  // the camera looks at places under the ground
    CHECK(find_streaks(small_view(), settings).empty());
}

TEST_CASE("settings out of range are usage errors") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const View view = small_view();
    for (double bad : {nan, 1001.0}) CHECK_THROWS_AS(find_streaks(view, rain(bad, 1)), Error);
    for (double bad : {nan, 0.0, -1.0}) CHECK_THROWS_AS(find_streaks(view, rain(10, bad)), Error);
    for (double bad : {nan, 0.0, -1.0}) {
        RainSettings settings = rain(10, 1);
        settings.near = bad;
        CHECK_THROWS_AS(find_streaks(view, settings), Error);
    }
    RainSettings windy = rain(10, 1), deep = windy;
    windy.wind = {nan, 0, 0};
    CHECK_THROWS_AS(find_streaks(view, windy), Error);
    deep.lowest_ground = nan;
    CHECK_THROWS_AS(find_streaks(view, deep), Error);
}
