// The rain stage: light that fine rain and fog scatter towards the camera.
#include "renderer/core/sampling.h"
#include "renderer/transport/equiangular.h"
#include "renderer/transport/rain_stage.h"

#include <algorithm>

namespace pluvia {

static constexpr float lamp_reach = 200;  // metres within which lamps are looked for; farther ones are found less often

/// Light of the medium at the distance of scratch.scattering, appended to scratch.scattered with the weights that
/// roulette leaves. One number decides for all intensities: what one gets does not depend on the others.
template <class Worth, class Trace>
static void append_scattered(RainScratch& scratch, float choice, const Worth& worth, const Trace& trace) {
    const auto& [distance, weights] = scratch.scattering;
    const float greatest = *std::max_element(weights.begin(), weights.end());
    if (!(greatest > 0)) return;  // in the dry
    const float q_max = worth(greatest);
    if (q_max < 1 && choice >= q_max) return;
    const Rgb light = trace();
    int place = scratch.scattered_count++;
    for (; place > 0 && scratch.scattered[place - 1].distance > distance; --place)
        std::swap(scratch.scattered[place - 1], scratch.scattered[place]);
    RainScratch::Scattered& result = scratch.scattered[place];
    result.distance = distance;
    result.light.assign(weights.size(), Rgb(0));
    for (size_t i = 0; i < weights.size(); ++i) {
        const float q = worth(weights[i]);
        if (q >= 1 || choice < q) result.light[i] = light * (weights[i] / std::min(q, 1.0f));
    }
}

/// Light from all around at a point of the medium, of lamps alone where the rest is in a table. Of lamps it takes the
/// share that scatter_near_lamp leaves.
void RainStage::scatter(Scatterer scatterer, const CameraSegment& segment, const RainSegment& in_rain,
                        const Sampler& pixel_sampler, RainScratch& scratch, Counters& counters) const {
    const Sampler sampler = pixel_sampler.fork(hash_key(medium_domain, uint64_t(scatterer)));
    medium_->sample(scatterer, in_rain, sampler.get_1d(Draw::medium_distance), scratch.scattering);
    const float distance = scratch.scattering.distance;
    if (distance == 0) return;
    counters.count(Feature::medium_point);
    const Vec3 position = segment.ray.at(distance);
    const ScatterFunction function = scatter_function(scatterer, segment.ray.direction);
    const bool tabled = segment.drop_light != nullptr;
    ScatteredLight event = tabled ? ScatteredLight(*tracer_, function, position, sampler)
                                  : ScatteredLight(*tracer_, function, position, scratch.distant, sampler);
    const Lights& lights = tracer_->lights();
    Vec3 anchor;
    if (lights.has_local()) {
        // Lamps are picked for a random point of the segment, wherever on it their light is then looked for. Given that
        // point the two ways to sample a lamp's light have densities that can be weighed against each other.
        const float near_end = std::min(in_rain.end, in_rain.begin + lamp_reach);
        anchor = segment.ray.at(in_rain.begin + sampler.get_1d(Draw::medium_anchor) * (near_end - in_rain.begin));
        if (const auto& lamp = event.lamp()) {
            const EquiangularDistance near_lamp(segment.ray, lights.position(*lamp), in_rain.begin, in_rain.end);
            const float here = medium_->pdf(scatterer, in_rain, distance) * lamp->probability;
            const float there = near_lamp.pdf(distance) * lights.choice_probability({anchor, Vec3()}, lamp->light);
            event.weigh_lamp(power_heuristic(here, there));
        }
    }
    const float brightness = tabled ? event.unshadowed() : std::max(segment.background_luminance, event.unshadowed());
    append_scattered(
        scratch, sampler.get_1d(Draw::streak_choice),
        [&](float weight) { return worth(weight * brightness, segment, settings_.medium_roulette); },
        [&] {
            // The same for all intensities, so that what one gets does not depend on the others.
            const PathWorth path{segment.background_luminance, float(settings_.medium_roulette)};
            if (tabled) return event.trace_lights(path, counters);
            counters.count(Feature::medium_path);
            return event.trace(path, counters);
        });
    if (lights.has_local()) scatter_near_lamp(scatterer, segment, in_rain, anchor, sampler, scratch, counters);
}

/// Light of one lamp at a point of the segment that is sampled close to the lamp: without it the halo of a lamp is all
/// fireflies.
void RainStage::scatter_near_lamp(Scatterer scatterer, const CameraSegment& segment, const RainSegment& in_rain,
                                  Vec3 anchor, const Sampler& event_sampler, RainScratch& scratch,
                                  Counters& counters) const {
    const Sampler sampler = event_sampler.fork(medium_domain);
    const Lights& lights = tracer_->lights();
    const Vec2 u = sampler.get_2d(Draw::light_choice);
    const auto lamp = lights.choose_local({anchor, Vec3()}, u.x, sampler.get_2d(Draw::light_point));
    if (!lamp) return;
    const EquiangularDistance near_lamp(segment.ray, lights.position(*lamp), in_rain.begin, in_rain.end);
    const float distance = near_lamp.sample(u.y), density = near_lamp.pdf(distance);
    const Vec3 position = segment.ray.at(distance);
    const LightSample light = lights.illuminate(position, *lamp);
    if (is_black(light.radiance)) return;
    counters.count(Feature::medium_lamp);

    // The light sample of scatter() at the same place, and the density with which it would have been found there.
    const float probability = lights.choice_probability({position, Vec3()}, lamp->light);
    const float there = medium_->pdf(scatterer, in_rain, distance) * probability;
    float mis = power_heuristic(density * lamp->probability, there);
    const float phase = evaluate_scatter(scatter_function(scatterer, segment.ray.direction), light.wi).value;
    // What a path continued by the phase function finds is its share as weighed against the light sample of scatter().
    if (!light.delta && !segment.drop_light) mis *= power_heuristic(light.pdf * probability / lamp->probability, phase);
    const Rgb contribution = light.radiance * (phase * mis / light.pdf);
    if (is_black(contribution)) return;
    medium_->weigh(scatterer, in_rain, distance, density, scratch.scattering);
    append_scattered(
        scratch, sampler.get_1d(Draw::streak_choice),
        [&](float weight) { return worth(weight * luminance(contribution), segment, settings_.medium_roulette); },
        [&] {
            return contribution *
                   visible_share(tracer_->ray_scene(), position, light, {sampler.key(Draw::light_point)}, counters);
        });
}

}  // namespace pluvia
