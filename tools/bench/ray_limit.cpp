// How many rays of a path tracer's mix Embree traces at most on a scene: what `pluvia render --json` reports as rays
// per second of rendering is measured against this.
//
//     ray_limit SCENE.glb [WIDTHxHEIGHT, 1024x512] [samples per pixel, 16] [threads, all]
//
// Paths as a renderer's, with nothing around them: a primary ray through the pixel; at every hit a shadow ray, to a
// random emissive triangle where the scene has any, else half of them to a sun 40 degrees high and half into the
// sky; cosine-weighted bounces that survive with probability 1/2. Triangles are flattened into one geometry with
// Embree's default flags and no filters. Prints rays and paths per second, the best of three runs.
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
#include <vector>

using namespace pluvia;

namespace {

constexpr int max_bounces = 8;
constexpr float step_off = 1e-3f;  // metres between a hit and the next ray

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

/// Whether light is blocked; a ray is counted.
bool shadow_ray(const Soup& soup, Vec3 from, Vec3 n, const Sampler& sampler, uint32_t bounce, int64_t& rays) {
    const Vec2 choice = sampler.get_2d(Draw::light_choice, bounce), u = sampler.get_2d(Draw::light_point, bounce);
    Vec3 wi;
    float distance = std::numeric_limits<float>::infinity();
    if (!soup.emitters.empty()) {
        const auto& t = soup.emitters[size_t(choice.x * float(soup.emitters.size()))];
        const Vec2 b = sample_triangle(u);
        const Vec3 to_light = t[0] * (1 - b.x - b.y) + t[1] * b.x + t[2] * b.y - from;
        distance = length(to_light);
        wi = to_light / distance;
        distance *= 1 - 1e-3f;
    } else {
        wi = choice.x < 0.5f ? normalize(Vec3(0.5f, 0.64f, 0.3f))
                             : ShadingBasis(n).to_world(sample_cosine_hemisphere(u));
    }
    if (dot(wi, n) <= 0) return true;
    ++rays;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay query = embree_ray(from, wi, distance);
    rtcOccluded1(soup.scene, &context, &query);
    return query.tfar < 0;
}

/// Traces a path and returns its rays. unblocked: so that no compiler finds the shadow rays useless.
int64_t trace(const Soup& soup, Vec3 origin, Vec3 direction, const Sampler& sampler, int64_t& unblocked) {
    int64_t rays = 0;
    for (uint32_t bounce = 0; bounce < max_bounces; ++bounce) {
        ++rays;
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
        unblocked += !shadow_ray(soup, origin, n, sampler, bounce, rays);
        if (sampler.get_1d(Draw::roulette, bounce) >= 0.5f) break;
        direction = ShadingBasis(n).to_world(sample_cosine_hemisphere(sampler.get_2d(Draw::bsdf, bounce)));
    }
    return rays;
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 2) {
        std::fprintf(stderr, "ray_limit SCENE.glb [WIDTHxHEIGHT] [SAMPLES] [THREADS]\n");
        return 2;
    }
    CameraSettings settings;
    if (count > 2) std::sscanf(arguments[2], "%dx%d", &settings.width, &settings.height);
    const int samples = count > 3 ? std::atoi(arguments[3]) : 16;
    set_thread_count(count > 4 ? std::atoi(arguments[4]) : 0);

    const Scene scene = load_gltf(arguments[1]);
    const View view = make_view(find_camera(scene, ""), settings);
    const Soup soup(scene);
    const double paths = double(settings.width) * settings.height * samples;
    double best = 0, ratio = 0;
    for (int run = 0; run < 3; ++run) {
        std::atomic<int64_t> rays = 0, unblocked = 0;
        const auto start = std::chrono::steady_clock::now();
        parallel_for(settings.height, [&](int y) {
            int64_t row_rays = 0, row_unblocked = 0;
            for (int x = 0; x < settings.width; ++x)
                for (int s = 0; s < samples; ++s) {
                    const Sampler sampler{uint64_t(run), uint32_t(x), uint32_t(y), uint32_t(s)};
                    const Vec2 u = sampler.get_2d(Draw::pixel);
                    const Vec3d d = view.world_vector_from_view(
                        Vec3d(normalize(view.view_direction({float(x) + u.x, float(y) + u.y}))));
                    row_rays += trace(soup, Vec3(view.position), Vec3(d), sampler, row_unblocked);
                }
            rays += row_rays, unblocked += row_unblocked;
        });
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        best = std::max(best, double(rays) / seconds);
        ratio = double(rays) / paths;
        std::printf("run %d: %.2f million rays/s, %.2f of the shadow rays a path are free\n", run,
                    double(rays) / seconds * 1e-6, double(unblocked) / paths);
    }
    std::printf("best: %.2f million rays/s, %.2f rays a path, %.2f million paths/s\n", best * 1e-6, ratio,
                best / ratio * 1e-6);
}
