#include "renderer/transport/scene_drop_light.h"

#include "renderer/core/sampling.h"
#include "renderer/transport/camera_ray.h"
#include "renderer/transport/scattered_light.h"

#include <algorithm>
#include <limits>

namespace pluvia {
namespace {

constexpr int least_size = 2;                                               // pixels of a cell
constexpr int pixels_per_sample = 4, least_samples = 4, most_samples = 64;  // of a cell and slice

constexpr uint64_t drop_light_domain = 0x64726f70, lamp_domain = 0x6c616d70;

class SceneDropLight {
public:
    SceneDropLight(const PathTracer& tracer, const View& view, const Bounds& far_scene, const RainShadow* shadow,
                   uint64_t seed, float near)
        : tracer_(tracer), view_(view), far_scene_(far_scene), shadow_(shadow), seed_(seed), near_(near) {}

    DropLightSamples find(const DropLight::Area& area, Counters& counters) const {
        DropLightSamples found(Rgb(0), scene_ray(view_, far_scene_, view_ray(view_, area.middle(), {})).ray.direction);
        const int samples = std::clamp(area.width * area.height / pixels_per_sample, least_samples, most_samples);
        for (int n = 0; n < samples; ++n)
            add_ray(area,
                    Sampler(seed_, uint32_t(area.column), uint32_t(area.row), uint32_t(n)).fork(drop_light_domain),
                    found, counters);
        return found;
    }

private:
    /// A drop in each slice that the ray reaches.
    void add_ray(const DropLight::Area& area, const Sampler& of_ray, DropLightSamples& found,
                 Counters& counters) const {
        const Ray seen = view_ray(view_, area.at(of_ray.get_2d(Draw::pixel)), {});
        const SceneRay ray = scene_ray(view_, far_scene_, seen);
        float deepest = std::numeric_limits<float>::infinity();
        RayHit hit;
        if (tracer_.ray_scene().closest_hit(ray.near, {of_ray.key(Draw::opacity)}, hit, counters))
            deepest = float(ray.before + hit.distance) * seen.direction.z;
        for (int slice = 0; slice < DropLight::slices; ++slice) {
            const Sampler sampler = of_ray.fork(uint64_t(slice));
            const float depth = DropLight::depth_in(slice, near_, deepest, sampler.get_1d(Draw::medium_distance));
            if (depth >= deepest) return;
            const Vec3 position = ray.ray.at(depth / seen.direction.z);
            if (shadow_ && !shadow_->is_open(position, counters)) continue;
            add_drop(slice, position, DropScatter{ray.ray.direction}, sampler, found, counters);
        }
    }

    void add_drop(int slice, Vec3 position, const DropScatter& drop, const Sampler& sampler, DropLightSamples& found,
                  Counters& counters) const {
        Rgb light;
        if (const auto distant =
                tracer_.lights().sample_distant(sampler.get_1d(Draw::light_choice), sampler.get_2d(Draw::sky_point))) {
            const ScatterValue scatter = drop.evaluate(distant->wi);
            const float mis = distant->delta ? 1.0f : power_heuristic(distant->pdf, scatter.pdf);
            light = distant->radiance * (scatter.value * mis / distant->pdf);
            if (!is_black(light))
                light *=
                    visible_share(tracer_.ray_scene(), position, *distant, {sampler.key(Draw::sky_point)}, counters);
            found.offer(slice, distant->wi, luminance(light), sampler.key(Draw::light_pick));
        }
        const Vec3 wi = drop.sample(sampler.get_2d(Draw::streak_phase));
        const ScatterValue scatter = drop.evaluate(wi);
        const PathResult path =
            tracer_.trace({position, wi}, {scatter.pdf, {position, Vec3()}, samples_alone}, sampler, 1, counters, {});
        const Rgb of_path = path.radiance * (scatter.value / scatter.pdf);
        found.offer(slice, wi, luminance(of_path), sampler.key(Draw::roulette));
        const ScatterFunction function = drop;
        const Sampler lamp_sampler = sampler.fork(lamp_domain);
        const ScatteredLight of_lamps(tracer_, function, position, lamp_sampler);
        found.add(slice, {light + of_path, of_lamps.unshadowed()}, counters);
    }

    const PathTracer& tracer_;
    const View& view_;
    const Bounds& far_scene_;
    const RainShadow* shadow_;
    uint64_t seed_;
    float near_;
};

}  // namespace

DropLight scene_drop_light(const PathTracer& tracer, const View& view, const Bounds& far_scene,
                           const RainShadow* shadow, uint64_t seed, float near, Counters& counters) {
    const SceneDropLight drops(tracer, view, far_scene, shadow, seed, near);
    return DropLight(
        view, least_size, true,
        [&](const DropLight::Area& area, Counters& of_cell) { return drops.find(area, of_cell); }, counters);
}

}  // namespace pluvia
