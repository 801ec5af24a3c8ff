// The rain stage: light that fine rain and fog scatter towards the camera.
#include "renderer/core/sampling.h"
#include "renderer/transport/equiangular.h"
#include "renderer/transport/rain_stage.h"
#include "renderer/transport/scattered_light.h"

#include <algorithm>

namespace pluvia {

static constexpr float lamp_reach = 200;  // metres within which lamps are looked for; farther ones are found less often

/// Of the intensities, each with its probability worth(i).
template <class Worth>
static float greatest_worth(size_t intensities, const Worth& worth) {
    float result = 0;
    for (size_t i = 0; i < intensities; ++i) result = std::max(result, worth(i));
    return result;
}

/// Light of the medium at the distance of scratch.scattering, appended to scratch.scattered with the weights that
/// roulette leaves. One number decides for all intensities: what one gets does not depend on the others.
template <class Worth, class Trace>
static void append_scattered(RainScratch& scratch, float choice, const Worth& worth, const Trace& trace) {
    const auto& [distance, weights] = scratch.scattering;
    if (!(choice < greatest_worth(weights.size(), worth))) return;
    const Rgb light = trace();
    int place = scratch.scattered_count++;
    for (; place > 0 && scratch.scattered[place - 1].distance > distance; --place)
        std::swap(scratch.scattered[place - 1], scratch.scattered[place]);
    RainScratch::Scattered& result = scratch.scattered[place];
    result.distance = distance;
    result.light.assign(weights.size(), Rgb(0));
    for (size_t i = 0; i < weights.size(); ++i) {
        const float q = worth(i);
        if (choice < q) result.light[i] = light * (weights[i] / q);
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
    const Lights& lights = tracer_->lights();
    // Lamps are picked for a random point of the segment, wherever on it their light is then looked for. Given that
    // point the two ways to sample a lamp's light have densities that can be weighed against each other.
    Vec3 anchor;
    if (lights.has_local()) {
        const float near_end = std::min(in_rain.end, in_rain.begin + lamp_reach);
        anchor = segment.ray.at(in_rain.begin + sampler.get_1d(Draw::medium_anchor) * (near_end - in_rain.begin));
    }
    const bool tabled = segment.drop_light != nullptr;
    const float choice = sampler.get_1d(Draw::streak_choice);
    const float lamps = tabled ? (*segment.drop_light)[DropLight::slice_of(distance * in_rain.cosine)].lamps : 0;
    const std::vector<float>& weights = scratch.scattering.weights;
    const auto hoped = [&](size_t i) {
        if (!(weights[i] > 0)) return 0.0f;  // in the dry
        return tabled ? lamp_worth(weights[i] * lamps, segment, settings_.medium_roulette) : 1.0f;
    };
    if (choice < greatest_worth(weights.size(), hoped)) {
        const ScatterFunction function = scatter_function(scatterer, segment.ray.direction);
        ScatteredLight event = tabled ? ScatteredLight(*tracer_, function, position, sampler)
                                      : ScatteredLight(*tracer_, function, position, scratch.distant, sampler);
        if (const auto& lamp = event.lamp()) {
            const EquiangularDistance near_lamp(segment.ray, lights.position(*lamp), in_rain.begin, in_rain.end);
            const float here = medium_->pdf(scatterer, in_rain, distance) * lamp->probability;
            const float there = near_lamp.pdf(distance) * lights.choice_probability({anchor, Vec3()}, lamp->light);
            event.weigh_lamp(power_heuristic(here, there));
        }
        const float brightness =
            tabled ? event.unshadowed() : std::max(segment.background_luminance, event.unshadowed());
        append_scattered(
            scratch, choice,
            [&](size_t i) {
                return std::min(hoped(i), worth(weights[i] * brightness, segment, settings_.medium_roulette));
            },
            [&] {
                // The same for all intensities, so that what one gets does not depend on the others.
                const PathWorth path{segment.background_luminance, float(settings_.medium_roulette)};
                if (tabled) return event.trace_lights(path, counters);
                counters.count(Feature::medium_path);
                return event.trace(path, counters);
            });
    }
    if (lights.has_local()) scatter_near_lamp(scatterer, segment, in_rain, anchor, sampler, scratch, counters);
}

/// Light of one lamp at a point of the segment that is sampled close to the lamp: without it the halo of a lamp is all
/// fireflies.
void RainStage::scatter_near_lamp(Scatterer scatterer, const CameraSegment& segment, const RainSegment& in_rain,
                                  Vec3 anchor, const Sampler& event_sampler, RainScratch& scratch,
                                  Counters& counters) const {
    const Sampler sampler = event_sampler.fork(medium_domain);
    const float choice = sampler.get_1d(Draw::streak_choice);
    const auto hoped = [&](size_t i) {
        return segment.drop_light ? lamp_worth(scratch.lamp_veil[i], segment, settings_.medium_roulette) : 1.0f;
    };
    if (!(choice < greatest_worth(intensities_.size(), hoped))) return;
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
    const std::vector<float>& weights = scratch.scattering.weights;
    append_scattered(
        scratch, choice,
        [&](size_t i) {
            return std::min(hoped(i), worth(weights[i] * luminance(contribution), segment, settings_.medium_roulette));
        },
        [&] {
            return contribution *
                   visible_share(tracer_->ray_scene(), position, light, {sampler.key(Draw::light_point)}, counters);
        });
}

}  // namespace pluvia
