#include "renderer/transport/sky_sights.h"

#include "renderer/core/parallel.h"
#include "renderer/transport/camera_ray.h"
#include "renderer/transport/direct_light.h"

#include <algorithm>
#include <array>
#include <functional>
#include <mutex>
#include <numeric>

namespace pluvia {
namespace {

constexpr uint64_t sight_domain = 0x73696768;
constexpr int most_paths = 1 << 17;
constexpr int pixels_per_path = 2;
constexpr int most_vertices = 4;     // of a path: light that is scattered more often is little
constexpr int looks_per_vertex = 8;  // directions in which the sky may be

/// One path. Of the directions that meet something at a vertex it goes on in the first.
class SightPath {
public:
    SightPath(const RayScene& ray_scene, const Environment& environment, const WetGround* wet_ground, uint64_t seed,
              int x, int y, std::vector<SkySight>& sights, Counters& counters)
        : ray_scene_(ray_scene),
          environment_(environment),
          wet_ground_(wet_ground),
          seed_(seed),
          x_(uint32_t(x)),
          y_(uint32_t(y)),
          sights_(sights),
          counters_(counters) {}

    void trace(const View& view, const Bounds& far_scene) {
        const Sampler first = sampler(0);
        const Vec2 u = first.get_2d(Draw::pixel);
        Ray ray =
            scene_ray(view, far_scene, view_ray(view, {float(x_) + u.x, float(y_) + u.y}, first.get_2d(Draw::lens)))
                .near;
        RayHit hit;
        if (!ray_scene_.closest_hit(ray, {first.key(Draw::opacity)}, hit, counters_)) return;
        for (int vertex = 0; vertex < most_vertices; ++vertex)
            if (!look_around(vertex, ray, hit)) return;
    }

private:
    Sampler sampler(int look) const { return Sampler(seed_, x_, y_, uint32_t(look)).fork(sight_domain); }

    /// False where the path ends; else ray and hit are those of its next vertex.
    bool look_around(int vertex, Ray& ray, RayHit& hit) {
        const Vec2 lobe = sampler(0).get_2d(Draw::lobe, uint32_t(vertex));
        Surface surface = evaluate_surface(ray_scene_.scene(), hit.point, ray.direction, lobe.y, counters_);
        if (wet_ground_) wet_ground_->wet(surface, hit.point, ray.direction, counters_);
        const ShadingBasis basis(surface.shading_normal);
        const PreparedBsdf bsdf = prepare(surface.bsdf, basis.to_local(-ray.direction));
        const Receiver receiver = receiver_at(surface, bsdf);
        bool goes_on = false;
        for (int look = 0; look < looks_per_vertex; ++look) {
            const Sampler of_look = sampler(look).fork(uint64_t(vertex));
            const auto next = sample(bsdf, of_look.get_1d(Draw::lobe), of_look.get_2d(Draw::bsdf));
            if (!next) continue;
            const Vec3 wi = basis.to_world(next->wi);
            if ((dot(wi, surface.geometric_normal) > 0) == next->transmitted) continue;
            // Dark surfaces scatter little of what they take.
            if (of_look.get_1d(Draw::roulette) >= max_component(next->weight)) continue;
            const Vec3 side = next->transmitted ? -surface.geometric_normal : surface.geometric_normal;
            const Ray out{offset_from_surface(surface.position, side, surface.extent), wi};
            RayHit met;
            if (!ray_scene_.closest_hit(out, {of_look.key(Draw::opacity)}, met, counters_)) {
                if (!next->delta) sights_.push_back({receiver, environment_.sky(wi).block});
            } else if (!goes_on) {
                goes_on = true;
                ray = out, hit = met;
            }
        }
        return goes_on;
    }

    const RayScene& ray_scene_;
    const Environment& environment_;
    const WetGround* wet_ground_;
    uint64_t seed_;
    uint32_t x_, y_;
    std::vector<SkySight>& sights_;
    Counters& counters_;
};

}  // namespace

bool is_worth_guiding(const Lights& lights) {
    const Environment& environment = lights.environment();
    if (!environment.has_blocks() || environment.disc_illuminance() > environment.sky_illuminance()) return false;
    if (lights.lamps_outshine_sky()) return false;
    // A sun may be part of the picture, and wider than the true one. Of a sky without, the brightest 64th has at most
    // 0.28 of the light, with the sun low behind haze.
    constexpr double outshone_by_sun = 0.4;
    std::array<double, Environment::block_count> light;
    for (int b = 0; b < Environment::block_count; ++b) light[size_t(b)] = environment.block(b).probability;
    const auto brightest_end = light.begin() + Environment::block_count / 64;
    std::ranges::nth_element(light, brightest_end, std::greater());
    return std::accumulate(light.begin(), brightest_end, 0.0) < outshone_by_sun;
}

std::vector<SkySight> find_sky_sights(const RayScene& ray_scene, const Environment& environment, const View& view,
                                      const WetGround* wet_ground, uint64_t seed, Counters& counters) {
    const int64_t pixels = int64_t(view.width) * view.height;
    const auto paths = int(std::clamp<int64_t>(pixels / pixels_per_path, 1, most_paths));
    const Bounds far_scene = far_bounds(ray_scene.scene(), view);
    constexpr int paths_at_once = 256;
    std::vector<SkySight> all;
    std::mutex mutex;
    parallel_for((paths + paths_at_once - 1) / paths_at_once, [&](int part) {
        std::vector<SkySight> sights;
        Counters of_part;
        for (int i = part * paths_at_once; i < std::min((part + 1) * paths_at_once, paths); ++i) {
            const auto pixel = int64_t((double(i) + 0.5) / paths * double(pixels));
            const int x = int(pixel % view.width), y = int(pixel / view.width);
            SightPath(ray_scene, environment, wet_ground, seed, x, y, sights, of_part).trace(view, far_scene);
        }
        const std::lock_guard lock(mutex);
        all.insert(all.end(), sights.begin(), sights.end());
        counters += of_part;
    });
    return all;
}

}  // namespace pluvia
