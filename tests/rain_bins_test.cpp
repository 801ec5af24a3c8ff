#include "renderer/rain/streak_bins.h"

#include "renderer/core/parallel.h"
#include "renderer/core/sampling.h"
#include "renderer/rain/drop_size.h"
#include "tests/statistics.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace pluvia;

namespace {

struct Scenario {
    const char* name;
    View view;
    RainSettings settings;
};

std::vector<Scenario> scenarios() {
    View view;
    view.width = 301;  // no multiple of a tile
    view.height = 157;
    view.focal_pixels = 290;
    view.position = {0, 100, 0};
    RainSettings settings;
    settings.intensities_mm_per_h = {100};
    settings.min_width_pixels = 0.16;
    settings.wind = {3, 0, 2};
    std::vector<Scenario> all = {{"level", view, settings}};
    const auto add = [&](const char* name) -> Scenario& { return all.emplace_back(Scenario{name, view, settings}); };
    Scenario& lens = add("wide open lens");
    lens.view.lens_radius = 0.02;
    lens.view.focus_distance = 2;
    Scenario& drive = add("driving forwards with an open lens");
    drive.view.velocity = {0, 0, -40};
    drive.view.lens_radius = 0.01;
    drive.view.focus_distance = 20;
    Scenario& reverse = add("driving backwards");
    reverse.view.velocity = {0, 0, 40};
    Scenario& up = add("looking up");
    up.view.up = {0, 0.1, 0.994987437};
    up.view.back = {0, -0.994987437, 0.1};
    Scenario& down = add("looking down from a fast camera, close to the drops");
    down.view.up = {0, 0, -1};
    down.view.back = {0, 1, 0};
    down.view.velocity = {5, -30, 0};
    down.settings.near = 0.02;
    Scenario& tilted = add("tilted, sidewards, long exposure");
    tilted.view.right = {0.8, 0.6, 0};
    tilted.view.up = {-0.6, 0.8, 0};
    tilted.view.velocity = {15, 0, 0};
    tilted.view.exposure_time = 0.1;
    return all;
}

// A ray through a pixel position from a random point of the lens.
Ray lens_ray(const View& view, Vec2 pixel, Vec2 u) {
    const Vec3 central = view.view_direction(pixel);
    if (view.lens_radius == 0) return {{}, normalize(central)};
    const Vec2 p = sample_disk(u) * float(view.lens_radius);
    const Vec3 origin(p.x, p.y, 0);
    return {origin, normalize(central * float(view.focus_distance) - origin)};
}

}  // namespace

TEST_CASE("bins find exactly the hits that a search through all streaks finds") {
    for (const Scenario& scenario : scenarios()) {
        CAPTURE(scenario.name);
        const View& view = scenario.view;
        const float exposure = float(view.exposure_time);
        const std::vector<Streak> streaks = find_streaks(view, scenario.settings);
        CAPTURE(streaks.size());
        for (auto [tile_width, tile_height] : {std::pair(4, 8), {16, 16}}) {
            const StreakBins bins(streaks, view, tile_width, tile_height);
            std::vector<StreakHit> hits;
            size_t found = 0;
            for (uint64_t i = 0; i < 400; ++i) {
                const auto u = [&](uint64_t n) { return uniform(tile_width, i, n); };
                const Vec2 pixel{u(0) * float(view.width), u(1) * float(view.height)};
                Ray ray = lens_ray(view, pixel, {u(2), u(3)});
                if (i % 2 == 1) ray.t_max = 12 * u(4);
                find_hits(bins, pixel, ray, hits);
                std::vector<uint64_t> expected, keys;
                for (const Streak& streak : streaks)
                    if (const auto covered = covered_interval(streak, ray, exposure);
                        covered && covered->distance < ray.t_max)
                        expected.push_back(streak.key);
                for (const StreakHit& hit : hits) keys.push_back(bins.streaks()[hit.streak].key);
                found += hits.size();
                for (size_t k = 1; k < hits.size(); ++k)
                    CHECK(hits[k - 1].covered.distance <= hits[k].covered.distance);
                std::sort(expected.begin(), expected.end());
                std::sort(keys.begin(), keys.end());
                CHECK(keys == expected);
            }
            CHECK(found > 100);
        }
    }
}

TEST_CASE("of the candidates each position of a pixel keeps every streak that its rays meet, and few others") {
    const Scenario scenario = scenarios().front();
    const View& view = scenario.view;
    const StreakBins bins(find_streaks(view, scenario.settings), view);
    std::vector<uint32_t> candidates;
    StreakBins::Touched touched;
    std::vector<StreakHit> hits, of_touched;
    std::array<Vec2, 50> positions;
    size_t found = 0, kept = 0;
    for (uint64_t i = 0; i < 200; ++i) {
        const int x = int(uniform(7, i, 0) * float(view.width)), y = int(uniform(7, i, 1) * float(view.height));
        for (uint64_t k = 0; k < positions.size(); ++k)
            positions[k] = {float(x) + uniform(8, i, 2 * k), float(y) + uniform(8, i, 2 * k + 1)};
        bins.find_candidates(x, y, candidates);
        bins.find_touched(candidates, positions, touched);
        for (size_t k = 0; k < positions.size(); ++k) {
            const Ray ray = lens_ray(view, positions[k], {});
            find_hits(bins, touched[k], ray, of_touched);
            find_hits(bins, positions[k], ray, hits);
            REQUIRE(of_touched.size() == hits.size());
            for (size_t h = 0; h < hits.size(); ++h) CHECK(of_touched[h].streak == hits[h].streak);
            found += hits.size(), kept += touched[k].size();
        }
    }
    CHECK(found > 1000);
    CHECK(kept < found + found / 2);
}

TEST_CASE("bins do not depend on the number of threads") {
    const Scenario scenario = scenarios()[1];
    const std::vector<Streak> streaks = find_streaks(scenario.view, scenario.settings);
    set_thread_count(1);
    const StreakBins serial(streaks, scenario.view);
    set_thread_count(4);
    const StreakBins parallel(streaks, scenario.view);
    set_thread_count(0);
    bool equal = true;
    for (int y = 0; y < scenario.view.height; ++y)
        for (int x = 0; x < scenario.view.width; ++x) {
            const auto a = serial.candidates(x, y), b = parallel.candidates(x, y);
            equal &= std::equal(a.begin(), a.end(), b.begin(), b.end()) && std::is_sorted(a.begin(), a.end());
        }
    CHECK(equal);
}

TEST_CASE("mean transmittance is exp(-integral of the extinction of drops wide enough), at any shutter") {
    View view;
    view.width = 64;
    view.height = 48;
    view.focal_pixels = 200;
    view.position = {0, 500, 0};
    RainSettings settings;
    settings.intensities_mm_per_h = {500};
    settings.min_width_pixels = 0.08;
    settings.wind = {4, 0, 0};  // across the view: a drop's depth stays as it is at mid-exposure
    double depth_integral = 0;
    const double far = largest_drop * view.focal_pixels / settings.min_width_pixels;
    const int steps = 2000;
    for (int i = 0; i < steps; ++i) {
        const double h = (far - settings.near) / steps, z = settings.near + (i + 0.5) * h;
        depth_integral +=
            h * extinction(500, std::max(smallest_drop, settings.min_width_pixels * z / view.focal_pixels));
    }
    for (double exposure_time : {1.0 / 60, 1.0 / 1000, 1e-6}) {
        CAPTURE(exposure_time);
        view.exposure_time = exposure_time;
        // Rays of one seed share drops, seeds do not: the error is that of the mean over seeds.
        RunningMean deviations;
        const int seeds = 32, rays = 200;
        std::vector<StreakHit> hits;
        for (uint64_t seed = 0; seed < seeds; ++seed) {
            settings.seed = 100 + seed;
            const StreakBins bins(find_streaks(view, settings), view);
            double deviation = 0;
            for (uint64_t i = 0; i < rays; ++i) {
                const Vec2 pixel{uniform(seed, i, 2) * 64, uniform(seed, i, 3) * 48};
                const Ray ray{{}, normalize(view.view_direction(pixel))};
                find_hits(bins, pixel, ray, hits);
                ExposureUnion exposure;
                for (const StreakHit& hit : hits) exposure.add(hit.covered.begin, hit.covered.end);
                deviation += (exposure.transmittance() - std::exp(-depth_integral / ray.direction.z)) / rays;
            }
            deviations.add(deviation);
        }
        CAPTURE(depth_integral);
        CAPTURE(deviations.mean());
        CHECK(deviations.standard_error() < 0.15 * depth_integral);  // enough to see a coverage that is off by a factor
        CHECK(deviations.agrees_with(0));
    }
}
