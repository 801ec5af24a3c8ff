#include "renderer/transport/scattered_light.h"

#include "renderer/core/sampling.h"

namespace pluvia {

ScatteredLight::ScatteredLight(const PathTracer& tracer, const ScatterFunction& function, Vec3 position,
                               const Sampler& sampler, Lamps lamps)
    : tracer_(&tracer), sampler_(&sampler), function_(&function), position_(position), lamps_(lamps) {
    const Lights& lights = tracer.lights();
    if (!lights.has_local()) return;
    lamp_ =
        lights.choose_local({position, Vec3()}, sampler.get_1d(Draw::light_choice), sampler.get_2d(Draw::light_point));
    if (lamp_) add(lights.illuminate(position, *lamp_), Draw::light_point);
    if (count_ == 0) lamp_.reset();
}

ScatteredLight::ScatteredLight(const PathTracer& tracer, const ScatterFunction& function, Vec3 position,
                               const std::optional<LightSample>& distant, const Sampler& sampler)
    : ScatteredLight(tracer, function, position, sampler, Lamps::and_paths) {
    if (distant) add(*distant, Draw::sky_point);
}

void ScatteredLight::add(const LightSample& light, Draw draw) {
    if (is_black(light.radiance)) return;
    const ScatterValue scatter = evaluate_scatter(*function_, light.wi);
    const bool alone = light.delta || lamps_ == Lamps::alone;
    const float mis = alone ? 1.0f : power_heuristic(light.pdf, scatter.pdf);
    candidates_[count_] = {light, light.radiance * (scatter.value * mis / light.pdf), draw};
    unshadowed_ += luminance(candidates_[count_++].contribution);
}

void ScatteredLight::weigh_lamp(float weight) {
    unshadowed_ -= luminance(candidates_[0].contribution);
    candidates_[0].contribution *= weight;
    unshadowed_ = std::max(0.0f, unshadowed_ + luminance(candidates_[0].contribution));
}

Rgb ScatteredLight::trace_lights(const PathWorth& worth, Counters& counters) const {
    const float relevance = tracer_->relevance(Rgb(1), worth);
    Rgb sum;
    for (int i = 0; i < count_; ++i) {
        const auto& [light, contribution, draw] = candidates_[i];
        const uint64_t key = sampler_->key(draw);
        const float weight = shadow_ray_weight(luminance(contribution), relevance, key);
        if (weight > 0)
            sum += contribution * visible_share(tracer_->ray_scene(), position_, light, {key}, counters) * weight;
    }
    return sum;
}

Rgb ScatteredLight::trace_path(const PathWorth& worth, Counters& counters) const {
    const Vec3 wi = sample_scatter(*function_, sampler_->get_2d(Draw::streak_phase));
    const ScatterValue scatter = evaluate_scatter(*function_, wi);
    const PathResult path =
        tracer_->trace({position_, wi}, {scatter.pdf, {position_, Vec3()}}, *sampler_, 1, counters, worth);
    return path.radiance * (scatter.value / scatter.pdf);
}

}  // namespace pluvia
