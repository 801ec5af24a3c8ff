#include "renderer/transport/rain_stage.h"

#include "renderer/core/sampling.h"
#include "renderer/transport/equiangular.h"
#include "shaders/streak.h"

#include <algorithm>
#include <limits>

namespace pluvia {
namespace {

// Keep the random numbers of streaks and medium apart from each other and from those of paths.
constexpr uint64_t rain_domain = 0x7261696e, medium_domain = 0x6d656469;

// Where neither lamps nor a sun can make it glint, light of a drop that is looked into is taken to be at most this many
// times that of its pixel when it is decided for how many samples it is found: what it shows is costly to find.
constexpr float most_brightness = 4;

constexpr float lamp_reach = 200;  // metres within which lamps are looked for; farther ones are found less often

}  // namespace

const char* composition_name(Composition composition) {
    return composition == Composition::paper ? "paper" : "physical";
}

RainStage::RainStage(const PathTracer& tracer, const StreakBins& bins, const RainMedium* medium,
                     std::vector<double> intensities, const StreakSettings& settings)
    : tracer_(&tracer), bins_(&bins), medium_(medium), intensities_(std::move(intensities)), settings_(settings) {}

bool RainStage::evaluate(const CameraSegment& segment, const Sampler& sampler, std::vector<RainSample>& samples,
                         RainScratch& scratch, Counters& counters) const {
    counters.count(Feature::streak_test);
    find_hits(*bins_, segment.candidates, segment.pixel, segment.view_ray, scratch.hits);
    scratch.scattered_count = 0;
    scratch.veil.clear();
    scratch.transmissions.assign((scratch.hits.size() + 1) * intensities_.size(), 1.0f);
    RainSegment in_rain;
    if (medium_) {
        Ray ray = segment.ray;
        ray.t_max = segment.view_ray.t_max;
        in_rain = medium_->segment(ray, segment.view_ray.direction.z);
        in_rain.dry = segment.dry;
    }
    if (scratch.hits.empty() && in_rain.empty()) return false;
    sample_distant(sampler, scratch);
    if (!in_rain.empty()) {
        find_transmissions(in_rain, scratch);
        scatter(Scatterer::drop, segment, in_rain, sampler, scratch, counters);
        if (medium_->has_fog()) scatter(Scatterer::fog, segment, in_rain, sampler, scratch, counters);
    }
    scratch.light.clear();
    for (const StreakHit& hit : scratch.hits)
        scratch.light.push_back(streak_light(hit, segment, scratch.distant, sampler, counters));
    const bool paper = settings_.composition == Composition::paper;
    if (paper && !scratch.hits.empty()) counters.count(Feature::paper_streak);
    for (size_t i = 0; i < intensities_.size(); ++i)
        paper ? compose_paper(scratch, segment, i, samples[i]) : compose_physical(scratch, i, samples[i]);
    return true;
}

/// One direction of sun or sky for all drops on the ray: from infinitely far it is the same light for all of them.
void RainStage::sample_distant(const Sampler& pixel_sampler, RainScratch& scratch) const {
    const Lights& lights = tracer_->lights();
    scratch.distant.reset();
    if (!lights.has_distant()) return;
    const VertexNumbers u = pixel_sampler.fork(rain_domain).vertex(0);
    scratch.distant = lights.sample_distant(u.get_1d(Draw::light_choice), u.get_2d(Draw::sky_point));
}

void RainStage::find_transmissions(const RainSegment& in_rain, RainScratch& scratch) const {
    const size_t count = scratch.hits.size();
    for (size_t k = 0; k <= count; ++k) {
        const float end = k < count ? scratch.hits[k].covered.distance : in_rain.end;
        float* const values = scratch.transmissions.data() + k * intensities_.size();
        const float distance = std::clamp(end, in_rain.begin, in_rain.end), fog = medium_->fog_depth(in_rain, distance);
        medium_->optical_depths(in_rain, distance, values);
        for (size_t i = 0; i < intensities_.size(); ++i) values[i] = std::exp(-values[i] - fog);
    }
}

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

/// Light from all around at a point of the medium. Of lamps it takes the share that scatter_near_lamp leaves.
void RainStage::scatter(Scatterer scatterer, const CameraSegment& segment, const RainSegment& in_rain,
                        const Sampler& pixel_sampler, RainScratch& scratch, Counters& counters) const {
    const Sampler sampler = pixel_sampler.fork(hash_key(medium_domain, uint64_t(scatterer)));
    medium_->sample(scatterer, in_rain, sampler.get_1d(Draw::medium_distance), scratch.scattering);
    const float distance = scratch.scattering.distance;
    if (distance == 0) return;
    counters.count(Feature::medium_point);
    const Vec3 position = segment.ray.at(distance);
    const ScatterFunction function = scatter_function(scatterer, segment.ray.direction);
    ScatteredLight event(*tracer_, function, position, scratch.distant, sampler);
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
    const float brightness = std::max(segment.background_luminance, event.unshadowed());
    append_scattered(
        scratch, sampler.get_1d(Draw::streak_choice),
        [&](float weight) { return worth(weight * brightness, segment, settings_.medium_roulette); },
        [&] {
            counters.count(Feature::medium_path);
            // The same for all intensities, so that what one gets does not depend on the others.
            const auto importance = float(settings_.medium_roulette);
            return event.trace({segment.background_luminance, importance}, counters);
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
    if (!light.delta) mis *= power_heuristic(light.pdf * probability / lamp->probability, phase);
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

Sampler RainStage::streak_sampler(const StreakHit& hit, const Sampler& sampler) const {
    return sampler.fork(hash_key(rain_domain, bins_->streaks()[hit.streak].key));
}

/// Whether the drop is looked into. From one to two pixels of width the picture in it takes over from its mean.
bool RainStage::shows_picture(const StreakHit& hit, const Sampler& sampler) const {
    return hit.width >= 2 || (hit.width > 1 && sampler.get_1d(Draw::medium_anchor) < hit.width - 1);
}

/// How the drop turns light at the place of its streak that the ray meets.
ScatterFunction RainStage::streak_scatter(const StreakHit& hit, const CameraSegment& segment,
                                          const Sampler& sampler) const {
    if (settings_.composition == Composition::physical) {
        if (shows_picture(hit, sampler)) return lens_scatter(hit, segment, sampler);
    }
    if (settings_.composition == Composition::physical || !settings_.textures)
        return DropScatter{segment.ray.direction};
    const Streak& streak = bins_->streaks()[hit.streak];
    const float time = 0.5f * (hit.covered.begin + hit.covered.end);
    return TexturedScatter{segment.ray.direction, settings_.textures.get(),
                           streak_place(segment.ray.direction, streak.key, 2 * streak.radius, bins_->exposure_time(),
                                        position_across(streak, segment.view_ray), time)};
}

/// What the drop shows while it passes the ray, at a few moments, one in each part of the time.
ScatterFunction RainStage::lens_scatter(const StreakHit& hit, const CameraSegment& segment,
                                        const Sampler& sampler) const {
    const Streak& streak = bins_->streaks()[hit.streak];
    const DropOscillation drop = drop_oscillation(streak.radius, streak.key);
    const Ray& ray = segment.view_ray;
    const float u = sampler.get_1d(Draw::medium_distance);
    LensScatter scatter{DropLens(hit.width)};
    // A pixel sees a wide drop at more of its places than a narrow one.
    const int moments = std::clamp(int(hit.width / 2), 1, DropLens::max_moments);
    for (int i = 0; i < moments; ++i) {
        const float part = (float(i) + u) / float(moments);
        const float time = (hit.covered.begin + part * hit.covered.fraction()) * bins_->exposure_time();
        const Vec3 to_centre = streak.start + streak.velocity * time - ray.origin;
        const Vec3 across = ray.direction * dot(to_centre, ray.direction) - to_centre;
        scatter.lens.add(drop.at(bins_->shutter_open() + double(time)), segment.ray.direction,
                         bins_->world_vector(across / streak.radius), moments);
    }
    return scatter;
}

/// S_a tau1/T of the paper's formula for the place of a streak that the ray meets.
float RainStage::paper_weight(const StreakHit& hit, const CameraSegment& segment) const {
    const Streak& streak = bins_->streaks()[hit.streak];
    const Vec3 d = segment.view_ray.direction;
    const Vec3 across = streak.velocity - d * dot(streak.velocity, d);
    return paper_alpha(hit.covered.fraction(), 2 * streak.radius, length(across) * bins_->exposure_time());
}

/// Factor on the light of a streak in the picture, if nothing is before it.
float RainStage::streak_weight(const StreakHit& hit, const CameraSegment& segment) const {
    const bool paper = settings_.composition == Composition::paper;
    return paper ? float(settings_.paper_gain) * paper_weight(hit, segment) : hit.covered.fraction();
}

/// Radiance of the drop towards the camera, computed for a share of the samples.
Rgb RainStage::streak_light(const StreakHit& hit, const CameraSegment& segment,
                            const std::optional<LightSample>& distant, const Sampler& pixel_sampler, Counters& counters,
                            float most) const {
    counters.count(Feature::streak_hit);
    const Sampler sampler = streak_sampler(hit, pixel_sampler);
    const float choice = sampler.get_1d(Draw::streak_choice);
    const Lights& lights = tracer_->lights();
    if (!lights.has_local() && !lights.has_sun() && settings_.composition == Composition::physical &&
        shows_picture(hit, sampler))
        most = std::min(most, worth(hit.covered.fraction() * most_brightness * segment.background_luminance, segment,
                                    settings_.streak_roulette));
    if (!(most >= 1) && choice >= most) return Rgb(0);
    const ScatterFunction function = streak_scatter(hit, segment, sampler);
    const ScatteredLight event(*tracer_, function, segment.ray.at(hit.covered.distance), distant, sampler);
    // What the light could bring beside the background. It depends on the light sample but not on the number that
    // decides, so the division by q stays unbiased; what is beside a lamp has q = 1 and is no firefly.
    const float brightness = std::max(segment.background_luminance, event.unshadowed());
    const float weight = streak_weight(hit, segment);
    const float q = std::min(most, worth(weight * brightness, segment, settings_.streak_roulette));
    if (!(q >= 1) && choice >= q) return Rgb(0);
    counters.count(Feature::streak_path);
    const float spared = 1 / std::min(q, 1.0f);
    return spared * event.trace({segment.background_luminance, spared * weight}, counters);
}

void RainStage::compose_physical(const RainScratch& scratch, size_t intensity, RainSample& result) const {
    const size_t count = scratch.hits.size();
    const float* const transmission = scratch.transmissions.data() + intensity;
    ExposureUnion covered;
    RainSample sample;
    int scattered = 0;
    const auto scatter_before = [&](float distance) {
        for (; scattered < scratch.scattered_count && scratch.scattered[scattered].distance <= distance; ++scattered)
            sample.inscatter += scratch.scattered[scattered].light[intensity] * covered.transmittance();
    };
    Rgb veil;
    const auto veil_before = [&](size_t k) {
        if (scratch.veil.empty()) return;
        const Rgb here = scratch.veil[k * intensities_.size() + intensity];
        sample.inscatter += (here - veil) * covered.transmittance();
        veil = here;
    };
    for (size_t k = 0; k < count; ++k) {
        const StreakHit& hit = scratch.hits[k];
        if (bins_->streaks()[hit.streak].threshold_mm_per_h > intensities_[intensity]) continue;
        scatter_before(hit.covered.distance);
        veil_before(k);
        const float weight = covered.add(hit.covered.begin, hit.covered.end);
        if (hit.width >= 1) sample.wide_coverage += weight;
        sample.light += scratch.light[k] * (weight * transmission[k * intensities_.size()]);
    }
    scatter_before(std::numeric_limits<float>::infinity());
    veil_before(count);
    sample.coverage = covered.total();
    sample.transmission = covered.transmittance() * transmission[count * intensities_.size()];
    result = sample;
}

/// I' = (1 - S_a tau1/T) I + S tau1/tau0 with S = gain S_a L tau0/T, in linear light; L holds the streak's texture.
void RainStage::compose_paper(const RainScratch& scratch, const CameraSegment& segment, size_t intensity,
                              RainSample& result) const {
    const size_t count = scratch.hits.size();
    const float* const transmission = scratch.transmissions.data() + intensity;
    float transmittance = 1;
    RainSample sample;
    int scattered = 0;
    const auto scatter_before = [&](float distance) {
        for (; scattered < scratch.scattered_count && scratch.scattered[scattered].distance <= distance; ++scattered)
            sample.inscatter += scratch.scattered[scattered].light[intensity] * transmittance;
    };
    Rgb veil;
    const auto veil_before = [&](size_t k) {
        if (scratch.veil.empty()) return;
        const Rgb here = scratch.veil[k * intensities_.size() + intensity];
        sample.inscatter += (here - veil) * transmittance;
        veil = here;
    };
    for (size_t k = 0; k < count; ++k) {
        const StreakHit& hit = scratch.hits[k];
        const Streak& streak = bins_->streaks()[hit.streak];
        if (streak.threshold_mm_per_h > intensities_[intensity]) continue;
        scatter_before(hit.covered.distance);
        veil_before(k);
        const float alpha = paper_weight(hit, segment);
        sample.light += scratch.light[k] *
                        (transmission[k * intensities_.size()] * transmittance * alpha * float(settings_.paper_gain));
        if (hit.width >= 1) sample.wide_coverage += transmittance * alpha;
        transmittance *= 1 - alpha;
    }
    scatter_before(std::numeric_limits<float>::infinity());
    veil_before(count);
    sample.coverage = 1 - transmittance;
    sample.transmission = transmittance * transmission[count * intensities_.size()];
    result = sample;
}

}  // namespace pluvia
