#include "renderer/transport/picture_drop_light.h"

#include "renderer/transport/camera_ray.h"
#include "renderer/transport/scattered_light.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr int samples = 16;  // of a cell, for each slice that its pixels reach

constexpr uint64_t drop_light_domain = 0x6472706c;

}  // namespace

DropLight picture_drop_light(const PathTracer& tracer, const FarLight& far, const PictureSource& picture,
                             const View& view, uint64_t seed, float near, Counters& counters) {
    const auto estimate = [&](const DropLight::Area& area, Counters& of_cell) {
        const Vec3 ahead = scene_ray(view, {}, view_ray(view, area.middle(), {})).ray.direction;
        DropLightSamples found(far.of_drop(ahead), ahead);
        for (int n = 0; n < samples; ++n) {
            const Sampler of_ray =
                Sampler(seed, uint32_t(area.column), uint32_t(area.row), uint32_t(n)).fork(drop_light_domain);
            const Vec2 pixel = area.at(of_ray.get_2d(Draw::pixel));
            const Ray seen = view_ray(view, pixel, {});
            const Ray ray = scene_ray(view, {}, seen).ray;
            const float deepest =
                picture.z.at(std::min(int(pixel.x), view.width - 1), std::min(int(pixel.y), view.height - 1));
            const ScatterFunction function = DropScatter{ray.direction};
            for (int slice = 0; slice < DropLight::slices; ++slice) {
                const Sampler sampler = of_ray.fork(uint64_t(slice));
                const float depth = DropLight::depth_in(slice, near, deepest, sampler.get_1d(Draw::medium_distance));
                if (depth >= deepest) break;
                const Vec3 position = ray.at(depth / seen.direction.z);
                const Vec3 wi = sample_scatter(function, sampler.get_2d(Draw::streak_phase));
                const ScatterValue scatter = evaluate_scatter(function, wi);
                // Against what the far light has for the same direction: they differ where something is near.
                const PathResult path =
                    tracer.trace({position, wi}, {scatter.pdf, {position, Vec3()}}, sampler, 1, of_cell, {});
                const Rgb around = std::isinf(path.distance) ? far.open(wi) : path.radiance;
                const Rgb nearby = (around - far.radiance(wi)) * (scatter.value / scatter.pdf);
                const ScatteredLight lamps(tracer, function, position, std::nullopt, sampler);
                const Rgb of_lamp = lamps.trace_lights({}, of_cell);
                found.add(slice, {nearby + of_lamp}, of_cell);
                found.offer(slice, wi, luminance(around), sampler.key(Draw::light_pick));
                if (lamps.lamp())
                    found.offer(slice, lamps.lamp_direction(), luminance(of_lamp), sampler.key(Draw::roulette));
            }
        }
        return found;
    };
    return DropLight(view, 1, false, estimate, counters);
}

}  // namespace pluvia
