// Time to find all streaks that cover a camera ray: screen bins of several tile sizes against an Embree scene of user
// primitives or of quads. Prints a table; no options. The choice made from it is the default of StreakBins.
//   cmake --build build --target streak_lookup
#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "renderer/rain/drop_size.h"
#include "renderer/rain/streak_bins.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>

using namespace pluvia;

namespace {

double seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Totals {
    size_t rays = 0, hits = 0;
    double fraction = 0;
};

// One ray at a random position in every pixel, tile after tile of 32 x 32 as a renderer goes.
template <class Look>
Totals trace(const View& view, float t_max, Look&& look) {
    Totals totals;
    std::vector<StreakHit> hits;
    for (int tile_y = 0; tile_y < view.height; tile_y += 32)
        for (int tile_x = 0; tile_x < view.width; tile_x += 32)
            for (int i = 0; i < 1024; ++i) {
                const int x = tile_x + i % 32, y = tile_y + i / 32;
                const uint64_t key = hash_key(7, x, y);
                const Vec2 pixel{x + unit_float(key), y + unit_float(mix_bits(key))};
                look(pixel, Ray{{}, normalize(view.view_direction(pixel)), t_max}, hits);
                ++totals.rays;
                totals.hits += hits.size();
                for (const StreakHit& hit : hits) totals.fraction += hit.covered.fraction();
            }
    return totals;
}

void report(const std::string& name, double build, size_t bytes, const View& view, float t_max,
            const std::function<void(Vec2, const Ray&, std::vector<StreakHit>&)>& look) {
    double best = 1e30;
    Totals totals;
    for (int repeat = 0; repeat < 3; ++repeat) {
        const double begin = seconds();
        totals = trace(view, t_max, look);
        best = std::min(best, seconds() - begin);
    }
    std::printf("  %-14s %9.1f %9.1f %9.1f %10.4f %12.8f\n", name.c_str(), build * 1e3, double(bytes) * 1e-6,
                best * 1e9 / double(totals.rays), double(totals.hits) / double(totals.rays),
                totals.fraction / double(totals.rays));
}

// 64 rays at random positions in every eighth pixel of every eighth row: what they share is found once.
void report_shared(const StreakBins& bins, const View& view, float t_max) {
    constexpr int samples = 64, step = 8;
    std::vector<uint32_t> candidates;
    std::array<Vec2, samples> positions;
    StreakBins::Touched touched;
    std::vector<StreakHit> hits;
    double best = 1e30;
    size_t rays = 0, found = 0;
    for (int repeat = 0; repeat < 3; ++repeat) {
        double spent = 0;
        rays = found = 0;
        for (int y = 0; y < view.height; y += step)
            for (int x = 0; x < view.width; x += step) {
                std::array<Ray, samples> of_pixel;
                for (int i = 0; i < samples; ++i) {
                    const uint64_t key = hash_key(8, x, y * samples + i);
                    positions[i] = {float(x) + unit_float(key), float(y) + unit_float(mix_bits(key))};
                    of_pixel[i] = {{}, normalize(view.view_direction(positions[i])), t_max};
                }
                const double begin = seconds();
                bins.find_candidates(x, y, candidates);
                bins.find_touched(candidates, positions, touched);
                for (int i = 0; i < samples; ++i) {
                    find_hits(bins, touched[i], of_pixel[i], hits);
                    found += hits.size();
                }
                spent += seconds() - begin;
                rays += samples;
            }
        best = std::min(best, spent);
    }
    std::printf("  bins, 64 rays of each pixel together: %.1f ns/ray, %.4f hits/ray, %.1f ns/hit\n",
                best * 1e9 / double(rays), double(found) / double(rays), best * 1e9 / double(found));
}

// What an Embree callback needs: the streaks, the ray at hand and the hits found so far.
struct Query {
    RTCIntersectContext context;  // first, so that a pointer to it is a pointer to the query
    const std::vector<Streak>* streaks;
    float exposure;
    const Ray* ray;
    std::vector<StreakHit>* hits;

    void meet(uint32_t index) {
        const auto covered = covered_interval((*streaks)[index], *ray, exposure);
        if (covered && covered->distance < ray->t_max) hits->push_back({index, *covered, 0});
    }
};

Query& query_of(RTCIntersectContext* context) {
    return *reinterpret_cast<Query*>(context);
}

struct StreakScene {
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    std::vector<Streak> streaks;
    float exposure;

    ~StreakScene() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    void attach(RTCGeometry geometry) {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
    }

    void add_primitives() {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, unsigned(streaks.size()));
        rtcSetGeometryUserData(geometry, this);
        const auto bounds = [](const RTCBoundsFunctionArguments* a) {
            const auto& self = *static_cast<const StreakScene*>(a->geometryUserPtr);
            const Streak& s = self.streaks[a->primID];
            const Vec3 end = s.start + s.velocity * self.exposure, r(s.radius, s.radius, s.radius);
            const Vec3 lower = min(s.start, end) - r, upper = max(s.start, end) + r;
            *a->bounds_o = {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, 0};
        };
        rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
        rtcSetGeometryOccludedFunction(geometry, [](const RTCOccludedFunctionNArguments* a) {
            if (a->valid[0]) query_of(a->context).meet(a->primID);
        });
        attach(geometry);
    }

    // A quad facing the camera around each streak, a little larger than its outline.
    void add_quads() {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
        auto* corners = static_cast<Vec3*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 4 * streaks.size()));
        auto* indices = static_cast<uint32_t*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 16, streaks.size()));
        for (size_t i = 0; i < streaks.size(); ++i) {
            const Streak& s = streaks[i];
            const Vec3 end = s.start + s.velocity * exposure;
            const Vec3 along = normalize(s.velocity) * (1.1f * s.radius);
            const Vec3 across = normalize(cross(s.velocity, s.start)) * (1.1f * s.radius);
            const Vec3 quad[4] = {s.start - along - across, s.start - along + across, end + along + across,
                                  end + along - across};
            std::copy(quad, quad + 4, corners + 4 * i);
            for (int k = 0; k < 4; ++k) indices[4 * i + k] = uint32_t(4 * i + k);
        }
        rtcSetGeometryOccludedFilterFunction(geometry, [](const RTCFilterFunctionNArguments* a) {
            query_of(a->context).meet(RTCHitN_primID(a->hit, a->N, 0));
            a->valid[0] = 0;  // go on to the next
        });
        attach(geometry);
    }

    void look(const Ray& ray, std::vector<StreakHit>& hits) const {
        hits.clear();
        Query query;
        rtcInitIntersectContext(&query.context);
        query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        query.streaks = &streaks;
        query.exposure = exposure;
        query.ray = &ray;
        query.hits = &hits;
        RTCRay r{};
        r.dir_x = ray.direction.x;
        r.dir_y = ray.direction.y;
        r.dir_z = ray.direction.z;
        r.tfar = ray.t_max + float(largest_drop);
        r.mask = ~0u;
        rtcOccluded1(scene, &query.context, &r);
        std::sort(hits.begin(), hits.end(),
                  [](const StreakHit& a, const StreakHit& b) { return a.covered.distance < b.covered.distance; });
    }
};

}  // namespace

int main() {
    set_thread_count(1);
    View view;
    view.width = 2048;
    view.height = 1024;
    view.focal_pixels = 1991;
    for (double intensity : {10.0, 100.0})
        for (double min_width : {1.0, 0.25}) {
            RainSettings settings;
            settings.intensities_mm_per_h = {intensity};
            settings.min_width_pixels = min_width;
            settings.lowest_ground = -500;
            const double begin = seconds();
            const std::vector<Streak> streaks = find_streaks(view, settings);
            std::printf("%g mm/h, streaks of %g pixels and more: %zu, found in %.1f ms\n", intensity, min_width,
                        streaks.size(), (seconds() - begin) * 1e3);
            for (float t_max : {1e30f, 8.0f}) {
                std::printf(" rays end at %g m\n  %-14s %9s %9s %9s %10s %12s\n", t_max, "structure", "build ms", "MB",
                            "ns/ray", "hits/ray", "covered");
                for (auto [width, height] : {std::pair(4, 4), {4, 8}, {8, 8}, {8, 16}, {16, 16}, {32, 32}}) {
                    const double start = seconds();
                    const StreakBins bins(streaks, view, width, height);
                    const double build = seconds() - start;
                    size_t entries = 0;
                    for (int y = 0; y < view.height; y += height)
                        for (int x = 0; x < view.width; x += width) entries += bins.candidates(x, y).size();
                    const size_t bytes = 4 * entries + streaks.size() * (sizeof(Streak) + sizeof(StreakFootprint));
                    report("bins " + std::to_string(width) + "x" + std::to_string(height), build, bytes, view, t_max,
                           [&](Vec2 pixel, const Ray& ray, auto& hits) { find_hits(bins, pixel, ray, hits); });
                }
                report_shared(StreakBins(streaks, view), view, t_max);
                for (bool quads : {false, true}) {
                    StreakScene scene;
                    size_t bytes = streaks.size() * sizeof(Streak);
                    rtcSetDeviceMemoryMonitorFunction(
                        scene.device,
                        [](void* user, ssize_t change, bool) {
                            *static_cast<size_t*>(user) += size_t(change);
                            return true;
                        },
                        &bytes);
                    scene.streaks = streaks;
                    scene.exposure = float(view.exposure_time);
                    const double start = seconds();
                    quads ? scene.add_quads() : scene.add_primitives();
                    const double build = seconds() - start;
                    report(quads ? "embree quads" : "embree user", build, bytes, view, t_max,
                           [&](Vec2, const Ray& ray, auto& hits) { scene.look(ray, hits); });
                }
            }
        }
}
