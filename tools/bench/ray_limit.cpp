// How many rays of a path tracer's mix Embree traces at most on a scene: what `pluvia render --json` reports as rays
// per second of rendering is measured against this (speed.py does).
//
//     ray_limit SCENE.glb [WIDTHxHEIGHT, 1024x512] [samples per pixel, 16] [threads, all]
//               [segments=S shadows=H] [light=lamps|sky]
//
// Paths as a renderer's, with nothing around them: a primary ray through the pixel; at every hit a shadow ray, to a
// random emissive triangle where the scene has any (light=lamps), else half of them to a sun 40 degrees high and half
// into the sky (light=sky); cosine-weighted bounces that survive with probability 1/2. Triangles are flattened into one
// geometry with Embree's default flags and no filters. segments, shadows: of rays that a renderer's mean path has,
// those for the closest hit and those for shadows. Bounces after the second then survive with the probability that
// makes paths as long, and each hit gets as many shadow rays. Prints rays and paths per second and per second of
// processor time, the best of three runs.
#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "renderer/core/sampling.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/surface.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <vector>

using namespace pluvia;

namespace {

constexpr uint32_t max_bounces = 32;
constexpr float step_off = 1e-3f;  // metres between a hit and the next ray

/// How long paths are and how many shadow rays their vertices have.
struct Mix {
    int sure_bounces = 0;   // that no roulette ends
    float survival = 0.5f;  // probability of each bounce after them
    float shadow_rays = 1;  // per vertex, in the mean
};

struct RayCount {
    int64_t segments = 0, shadows = 0, unblocked = 0;
    int64_t rays() const { return segments + shadows; }
    void operator+=(const RayCount& o) { segments += o.segments, shadows += o.shadows, unblocked += o.unblocked; }
};

/// Random numbers that cost next to nothing: splitmix64 (Steele, Lea and Flood 2014).
struct Dice {
    uint64_t state;
    float next() {
        uint64_t z = state += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return unit_float(z ^ (z >> 31));
    }
    Vec2 next_2d() {
        const float x = next();
        return {x, next()};
    }
};

struct Soup {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    std::vector<std::array<Vec3, 3>> emitters;

    explicit Soup(const Scene& source) {
        std::vector<Vec3> corner;
        for (int i = 0; i < int(source.instances.size()); ++i) {
            const Mesh& mesh = source.meshes[source.instances[i].mesh];
            const bool emits = source.materials[mesh.material].emits();
            for (int k = 0; k < int(mesh.triangles.size()); ++k) {
                const auto c = corners(source, i, k);
                for (const Vec3d p : c) corner.push_back(Vec3(p));
                if (emits) emitters.push_back({Vec3(c[0]), Vec3(c[1]), Vec3(c[2])});
            }
        }
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertices = static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                    RTC_FORMAT_FLOAT3, sizeof(Vec3), corner.size()));
        auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), corner.size() / 3));
        for (size_t i = 0; i < corner.size(); ++i) vertices[i] = corner[i], indices[i] = uint32_t(i);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
        std::printf("%zu triangles, %zu of them emit\n", corner.size() / 3, emitters.size());
    }
    ~Soup() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

RTCRay embree_ray(Vec3 origin, Vec3 direction, float t_max) {
    RTCRay r = {};
    r.org_x = origin.x, r.org_y = origin.y, r.org_z = origin.z;
    r.dir_x = direction.x, r.dir_y = direction.y, r.dir_z = direction.z;
    r.tfar = t_max, r.mask = ~0u;
    return r;
}

/// Traces a shadow ray where the light is above the horizon.
void shadow_ray(const Soup& soup, Vec3 from, Vec3 n, Dice& dice, RayCount& count) {
    const float choice = dice.next();
    const Vec2 u = dice.next_2d();
    Vec3 wi;
    float distance = std::numeric_limits<float>::infinity();
    if (!soup.emitters.empty()) {
        const auto& t = soup.emitters[size_t(choice * float(soup.emitters.size()))];
        const Vec2 b = sample_triangle(u);
        const Vec3 to_light = t[0] * (1 - b.x - b.y) + t[1] * b.x + t[2] * b.y - from;
        distance = length(to_light);
        wi = to_light / distance;
        distance *= 1 - 1e-3f;
    } else {
        wi = choice < 0.5f ? normalize(Vec3(0.5f, 0.64f, 0.3f)) : ShadingBasis(n).to_world(sample_cosine_hemisphere(u));
    }
    if (dot(wi, n) <= 0) return;
    ++count.shadows;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = embree_ray(from, wi, distance);
    rtcOccluded1(soup.scene, &context, &query);
    count.unblocked += query.tfar >= 0;  // counted, so that no compiler finds the shadow rays useless
}

void trace(const Soup& soup, Vec3 origin, Vec3 direction, const Mix& mix, Dice& dice, RayCount& count) {
    for (uint32_t bounce = 0; bounce < max_bounces; ++bounce) {
        ++count.segments;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query;
        query.ray = embree_ray(origin, direction, std::numeric_limits<float>::infinity());
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(soup.scene, &context, &query);
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) break;
        Vec3 n = normalize(Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
        if (dot(n, direction) > 0) n = -n;
        origin = origin + direction * query.ray.tfar + n * step_off;
        const int shadow_rays = int(mix.shadow_rays + dice.next());
        for (int i = 0; i < shadow_rays; ++i) shadow_ray(soup, origin, n, dice, count);
        if (int(bounce) >= mix.sure_bounces && dice.next() >= mix.survival) break;
        direction = ShadingBasis(n).to_world(sample_cosine_hemisphere(dice.next_2d()));
    }
}

/// All paths of a picture. seed: of their random numbers.
RayCount trace_picture(const Soup& soup, const View& view, const CameraSettings& size, int samples, const Mix& mix,
                       uint64_t seed) {
    std::atomic<int64_t> segments = 0, shadows = 0, unblocked = 0;
    parallel_for(size.height, [&](int y) {
        RayCount row;
        Dice dice{hash_key(seed, uint64_t(y))};
        for (int x = 0; x < size.width; ++x)
            for (int s = 0; s < samples; ++s) {
                const Vec2 u = dice.next_2d();
                const Vec3d d = view.world_vector_from_view(
                    Vec3d(normalize(view.view_direction({float(x) + u.x, float(y) + u.y}))));
                trace(soup, Vec3(view.position), Vec3(d), mix, dice, row);
            }
        segments += row.segments, shadows += row.shadows, unblocked += row.unblocked;
    });
    return {segments, shadows, unblocked};
}

/// The mix whose mean path has the given numbers of rays, or as close as sure bounces allow.
Mix fitted_mix(const Soup& soup, const View& view, const CameraSettings& size, double segments, double shadows) {
    const double paths = double(size.width) * size.height;
    Mix mix{2, 0.5f, 1};
    float low = 0, high = 1;
    for (int step = 0; step < 10; ++step) {
        mix.survival = (low + high) / 2;
        const RayCount count = trace_picture(soup, view, size, 1, mix, 99);
        (double(count.segments) / paths < segments ? low : high) = mix.survival;
        if (step == 9) mix.shadow_rays = float(shadows * paths / double(std::max<int64_t>(count.shadows, 1)));
    }
    return mix;
}

double processor_seconds() {
    return double(std::clock()) / CLOCKS_PER_SEC;
}

void measure(const Soup& soup, const View& view, const CameraSettings& size, int samples, const Mix& mix) {
    const double paths = double(size.width) * size.height * samples;
    double best = 0, best_of_processor = 0, rays_per_path = 0;
    for (int run = 0; run < 3; ++run) {
        const auto start = std::chrono::steady_clock::now();
        const double processor_start = processor_seconds();
        const RayCount count = trace_picture(soup, view, size, samples, mix, uint64_t(run));
        const double processor = processor_seconds() - processor_start;
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        const double rays = double(count.rays());
        best = std::max(best, rays / seconds), best_of_processor = std::max(best_of_processor, rays / processor);
        rays_per_path = rays / paths;
        std::printf("run %d: %.2f million rays/s, a path has %.3f segments, %.3f shadow rays and %.3f of these free\n",
                    run, rays / seconds * 1e-6, double(count.segments) / paths, double(count.shadows) / paths,
                    double(count.unblocked) / paths);
    }
    std::printf(
        "best: %.2f million rays/s, %.2f rays a path, %.2f million paths/s, %.3f million rays a second of processor\n",
        best * 1e-6, rays_per_path, best / rays_per_path * 1e-6, best_of_processor * 1e-6);
}

}  // namespace

int main(int count, char** arguments) {
    double segments = 0, shadows = 0;
    bool sky = false;
    std::vector<const char*> plain;
    for (int i = 1; i < count; ++i) {
        const char* a = arguments[i];
        if (std::sscanf(a, "segments=%lf", &segments) == 1 || std::sscanf(a, "shadows=%lf", &shadows) == 1) continue;
        if (!std::strncmp(a, "light=", 6))
            sky = !std::strcmp(a, "light=sky");
        else
            plain.push_back(a);
    }
    if (plain.empty()) {
        std::fprintf(stderr,
                     "ray_limit SCENE.glb [WIDTHxHEIGHT] [SAMPLES] [THREADS] [segments=S shadows=H] "
                     "[light=lamps|sky]\n");
        return 2;
    }
    CameraSettings settings;
    if (plain.size() > 1) std::sscanf(plain[1], "%dx%d", &settings.width, &settings.height);
    const int samples = plain.size() > 2 ? std::atoi(plain[2]) : 16;
    set_thread_count(plain.size() > 3 ? std::atoi(plain[3]) : 0);

    const Scene scene = load_gltf(plain[0]);
    const View view = make_view(find_camera(scene, ""), settings);
    Soup soup(scene);
    if (sky) soup.emitters.clear();
    Mix mix;
    if (segments > 0) {
        CameraSettings small = settings;
        small.width = std::max(settings.width / 4, 1), small.height = std::max(settings.height / 4, 1);
        mix = fitted_mix(soup, make_view(find_camera(scene, ""), small), small, segments, shadows);
        std::printf("survival %.3f, shadow rays a vertex %.3f\n", double(mix.survival), double(mix.shadow_rays));
    }
    measure(soup, view, settings, samples, mix);
}
