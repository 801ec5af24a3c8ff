// Rain from frame to frame while wind and intensity change.
#include "renderer/rain/drop_size.h"
#include "renderer/rain/streaks.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>

namespace pluvia {
namespace {

constexpr double frame_seconds = 0.01, first_second = 600;

/// m/s, ten minutes after the sequence began: the wind veers and freshens.
Vec3d wind_at(double time) {
    const double t = time - first_second;
    return {5 + 20 * t, 0, 2 - 15 * t};
}
/// Metres that the air has moved; before first_second the wind was 1 m/s along x.
Vec3d travel_at(double time) {
    const double t = time - first_second;
    return {first_second + 5 * t + 10 * t * t, 0, 2 * t - 7.5 * t * t};
}

struct Seen {
    Vec3d middle;   // world, at mid-exposure
    double radius;  // metres
    float threshold;
};

/// Drops of frame i by key.
std::map<uint64_t, Seen> frame(int i, double intensity, bool with_travel) {
    const double time = first_second + i * frame_seconds;
    View view;
    view.width = 256, view.height = 128, view.focal_pixels = 150;
    view.position = {12, 300, -40};
    view.exposure_time = 1.0 / 500, view.shutter_open = time - view.exposure_time / 2;
    RainSettings settings;
    settings.intensities_mm_per_h = {intensity};
    settings.wind = wind_at(time);
    if (with_travel) settings.wind_travel = travel_at(time);
    std::map<uint64_t, Seen> seen;
    for (const Streak& s : find_streaks(view, settings)) {
        const Vec3d in_view = Vec3d(s.start) + Vec3d(s.velocity) * (view.exposure_time / 2);
        seen[s.key] = {view.position + view.world_vector_from_view(in_view), s.radius, s.threshold_mm_per_h};
    }
    return seen;
}

}  // namespace

TEST_CASE("a drop is in the next frame where its fall and the wind between put it, while both rain and wind change") {
    size_t common = 0, jumped = 0, gone = 0, unexplained = 0;
    for (int i = 0; i < 5; ++i) {
        const double intensity = 50 + 4 * i;  // mm/h: 400 more in a second
        const auto now = frame(i, intensity, true), next = frame(i + 1, intensity + 4, true);
        const Vec3d blown =
            travel_at(first_second + (i + 1) * frame_seconds) - travel_at(first_second + i * frame_seconds);
        for (const auto& [key, drop] : now) {
            const auto found = next.find(key);
            if (found == next.end()) {
                ++gone;  // it has left the picture
                continue;
            }
            const double fall = fall_speed(2 * drop.radius) * frame_seconds;
            const Vec3d off = found->second.middle - (drop.middle + blown - Vec3d(0, fall, 0));
            ++common;
            // Where the wind changes during an exposure of 2 ms the frame has its mean: 25 m/s2 x 1 ms x 1 ms.
            if (length(off) > 1e-4) ++jumped;
        }
        // Rain that grows takes no drop away, and a drop that appears in the middle of the picture is one that it did
        // not rain before, but for those that jump.
        for (const auto& [key, drop] : next) {
            const Vec3d before = drop.middle - blown;
            const bool was_in_middle =
                std::abs(before.x - 12) < 0.3 && std::abs(before.y - 300) < 0.1 && before.z < -40.5 && before.z > -41;
            unexplained += was_in_middle && !now.contains(key) && drop.threshold <= float(intensity);
        }
    }
    CAPTURE(common);
    CAPTURE(jumped);
    CAPTURE(gone);
    CHECK(common > 500);
    CHECK(unexplained * 50 < common);
    CHECK(jumped * 100 < common);  // drops that jump by their cell's edge: see drop_population.h
    CHECK(common > 2 * gone);
}

TEST_CASE("without the way of the wind a change of it sets every drop elsewhere") {
    const auto now = frame(0, 50, false), next = frame(1, 50, false);
    size_t common = 0;
    for (const auto& [key, drop] : now) common += next.contains(key);
    CHECK(now.size() > 100);
    CHECK(common * 20 < now.size());  // 120 m away
}

TEST_CASE("in a steady wind the way of the wind changes nothing") {
    View view;
    view.width = 256, view.height = 128, view.focal_pixels = 150;
    view.shutter_open = 3, view.exposure_time = 1.0 / 64;  // so that the product is exact
    RainSettings plain;
    plain.intensities_mm_per_h = {50};
    plain.wind = {2, 0, -1};
    RainSettings told = plain;
    told.wind_travel = plain.wind * (view.shutter_open + view.exposure_time / 2);
    const auto a = find_streaks(view, plain), b = find_streaks(view, told);
    REQUIRE(a.size() == b.size());
    CHECK(a.size() > 100);
    for (size_t i = 0; i < a.size(); ++i) {
        REQUIRE(a[i].key == b[i].key);
        REQUIRE(a[i].start == b[i].start);
    }
}

}  // namespace pluvia
