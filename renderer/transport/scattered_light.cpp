#include "renderer/transport/scattered_light.h"

#include "renderer/core/sampling.h"
#include "shaders/fog.h"
#include "shaders/raindrop.h"

namespace pluvia {
namespace {

// Roulette lets scattered light be computed for few samples, and for those it is this part of their pixel's light or
// so.
constexpr float path_importance = 0.4f;

}  // namespace

float scatter_phase(Scatterer scatterer, float cos_theta) {
    return scatterer == Scatterer::drop ? drop_phase(cos_theta) : fog_phase(cos_theta);
}

ScatteredLight::ScatteredLight(const PathTracer& tracer, Scatterer scatterer, Vec3 position, Vec3 direction,
                               const std::optional<LightSample>& distant, const Sampler& sampler)
    : tracer_(&tracer), sampler_(&sampler), scatterer_(scatterer), position_(position), direction_(direction) {
    const Lights& lights = tracer.lights();
    if (lights.has_local()) {
        lamp_ = lights.choose_local({position, Vec3()}, sampler.get_1d(Draw::light_choice),
                                    sampler.get_2d(Draw::light_point));
        if (lamp_) add(lights.illuminate(position, *lamp_), Draw::light_point);
        if (count_ == 0) lamp_.reset();
    }
    if (distant) add(*distant, Draw::sky_point);
}

void ScatteredLight::add(const LightSample& light, Draw draw) {
    if (is_black(light.radiance)) return;
    const float p = phase(dot(light.wi, direction_));
    const float mis = light.delta ? 1.0f : power_heuristic(light.pdf, p);
    candidates_[count_] = {light, light.radiance * (p * mis / light.pdf), draw};
    unshadowed_ += luminance(candidates_[count_++].contribution);
}

void ScatteredLight::weigh_lamp(float weight) {
    unshadowed_ -= luminance(candidates_[0].contribution);
    candidates_[0].contribution *= weight;
    unshadowed_ = std::max(0.0f, unshadowed_ + luminance(candidates_[0].contribution));
}

Rgb ScatteredLight::trace(Counters& counters) const {
    Rgb sum;
    for (int i = 0; i < count_; ++i)
        sum += candidates_[i].contribution * visible_share(tracer_->ray_scene(), position_, candidates_[i].light,
                                                           {sampler_->key(candidates_[i].draw)}, counters);
    const Vec2 u = sampler_->get_2d(Draw::streak_phase);
    const Vec3 wi = scatterer_ == Scatterer::drop ? sample_drop_phase(direction_, u) : sample_fog_phase(direction_, u);
    const PathResult path = tracer_->trace({position_, wi}, {phase(dot(wi, direction_)), {position_, Vec3()}},
                                           *sampler_, 1, counters, path_importance);
    return sum + path.radiance;
}

}  // namespace pluvia
