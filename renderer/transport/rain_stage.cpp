#include "renderer/transport/rain_stage.h"

#include "renderer/core/sampling.h"
#include "shaders/raindrop.h"
#include "shaders/streak.h"

namespace pluvia {
namespace {

constexpr uint64_t rain_domain = 0x7261696e;  // keeps the random numbers of rain apart from those of paths

}  // namespace

const char* composition_name(Composition composition) {
    return composition == Composition::paper ? "paper" : "physical";
}

RainStage::RainStage(const PathTracer& tracer, const StreakBins& bins, std::vector<double> intensities,
                     const StreakSettings& settings)
    : tracer_(&tracer), bins_(&bins), intensities_(std::move(intensities)), settings_(settings) {}

bool RainStage::evaluate(const CameraSegment& segment, const Sampler& sampler, std::vector<RainSample>& samples,
                         RainScratch& scratch, Counters& counters) const {
    counters.count(Feature::streak_test);
    find_hits(*bins_, segment.pixel, segment.view_ray, scratch.hits);
    if (scratch.hits.empty()) return false;
    scratch.light.clear();
    for (const StreakHit& hit : scratch.hits) scratch.light.push_back(streak_light(hit, segment, sampler, counters));
    if (settings_.composition == Composition::paper) {
        counters.count(Feature::paper_streak);
        compose_paper(scratch, segment, samples);
    } else {
        compose_physical(scratch, samples);
    }
    return true;
}

/// Radiance of the drop towards the camera: light sources by a light sample and everything else by a ray that the
/// phase function continues, weighed against each other. Computed for a share q of the samples and divided by it.
Rgb RainStage::streak_light(const StreakHit& hit, const CameraSegment& segment, const Sampler& pixel_sampler,
                            Counters& counters) const {
    counters.count(Feature::streak_hit);
    // Numbers of a drop's own: its light does not depend on which other drops are there.
    const Sampler sampler = pixel_sampler.fork(hash_key(rain_domain, bins_->streaks()[hit.streak].key));
    const Vec3 position = segment.ray.at(hit.covered.distance), direction = segment.ray.direction;
    const Receiver receiver{position, Vec3()};
    const Lights& lights = tracer_->lights();

    struct Candidate {
        LightSample light;
        Rgb contribution;  // if the light is visible
        Draw draw;
    };
    std::array<Candidate, 2> candidates;
    int count = 0;
    float unshadowed = 0;
    const auto add = [&](const std::optional<LightSample>& light, Draw draw) {
        if (!light || is_black(light->radiance)) return;
        const float phase = drop_phase(dot(light->wi, direction));
        const float mis = light->delta ? 1.0f : power_heuristic(light->pdf, phase);
        candidates[count] = {*light, light->radiance * (phase * mis / light->pdf), draw};
        unshadowed += luminance(candidates[count++].contribution);
    };
    const Vec2 choice = sampler.get_2d(Draw::light_choice);
    if (lights.has_local())
        add(lights.sample_local(receiver, choice.x, sampler.get_2d(Draw::light_point)), Draw::light_point);
    if (lights.has_distant()) add(lights.sample_distant(choice.y, sampler.get_2d(Draw::sky_point)), Draw::sky_point);

    // What the drop could bring beside what it hides. It depends on the light sample but not on the number that
    // decides, so the division by q stays unbiased; a drop beside a lamp has q = 1 and is no firefly.
    const float expected = hit.covered.fraction() * std::max(segment.background_luminance, unshadowed);
    const float q = std::min(1.0f, expected / (float(settings_.roulette) * segment.background_luminance));
    if (!(q >= 1) && sampler.get_1d(Draw::streak_choice) >= q) return Rgb(0);

    counters.count(Feature::streak_path);
    Rgb sum;
    for (int i = 0; i < count; ++i)
        if (is_visible(tracer_->ray_scene(), position, candidates[i].light, {sampler.key(candidates[i].draw)},
                       counters))
            sum += candidates[i].contribution;
    const Vec3 wi = sample_drop_phase(direction, sampler.get_2d(Draw::streak_phase));
    const float pdf = drop_phase(dot(wi, direction));
    sum += tracer_->trace({position, wi}, {pdf, receiver}, sampler, 1, counters).radiance;
    return q >= 1 ? sum : sum / q;
}

void RainStage::compose_physical(const RainScratch& scratch, std::vector<RainSample>& samples) const {
    const auto& hits = scratch.hits;
    for (size_t i = 0; i < intensities_.size(); ++i) {
        ExposureUnion covered;
        RainSample sample;
        for (size_t k = 0; k < hits.size(); ++k) {
            if (bins_->streaks()[hits[k].streak].threshold_mm_per_h > intensities_[i]) continue;
            sample.light += scratch.light[k] * covered.add(hits[k].covered.begin, hits[k].covered.end);
        }
        sample.coverage = covered.total();
        samples[i] = sample;
    }
}

/// I' = (1 - S_a tau1/T) I + S tau1/tau0 with S = gain L tau0/T times the streak's texture, in linear light.
void RainStage::compose_paper(const RainScratch& scratch, const CameraSegment& segment,
                              std::vector<RainSample>& samples) const {
    const auto& hits = scratch.hits;
    for (size_t i = 0; i < intensities_.size(); ++i) {
        float transmittance = 1;
        RainSample sample;
        for (size_t k = 0; k < hits.size(); ++k) {
            const Streak& streak = bins_->streaks()[hits[k].streak];
            if (streak.threshold_mm_per_h > intensities_[i]) continue;
            const Vec3 d = segment.view_ray.direction;
            const Vec3 across = streak.velocity - d * dot(streak.velocity, d);
            const float path = length(across) * bins_->exposure_time();
            const float alpha = paper_alpha(hits[k].covered.fraction(), 2 * streak.radius, path);
            const float time = 0.5f * (hits[k].covered.begin + hits[k].covered.end) * bins_->exposure_time();
            const float texture = streak_texture(2 * streak.radius, time, streak.key);
            sample.light += scratch.light[k] * (transmittance * alpha * texture * float(settings_.paper_gain));
            transmittance *= 1 - alpha;
        }
        sample.coverage = 1 - transmittance;
        samples[i] = sample;
    }
}

}  // namespace pluvia
