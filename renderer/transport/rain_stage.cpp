#include "renderer/transport/rain_stage.h"

#include <algorithm>
#include <limits>

namespace pluvia {
namespace {

/// What hides the background by the paper's formula: streaks that know nothing of each other's times.
class PaperCover {
public:
    /// Returns what nothing nearer hides.
    float add(float alpha) {
        const float share = transmittance_ * alpha;
        transmittance_ *= 1 - alpha;
        return share;
    }
    float total() const { return 1 - transmittance_; }
    float transmittance() const { return transmittance_; }

private:
    float transmittance_ = 1;
};

/// The sample of one intensity, put together from near to far. covered: hides nothing yet. cover(hit): lets it hide
/// what is behind a streak and returns the share that was not hidden before. gain: on the light of streaks.
template <class Cover, class CoverHit>
RainSample composed(const RainScratch& scratch, const StreakBins& bins, const std::vector<double>& intensities,
                    size_t intensity, const Cover& covered, float gain, const CoverHit& cover) {
    const size_t count = scratch.hits.size();
    const float* const transmission = scratch.transmissions.data() + intensity;
    RainSample sample;
    int scattered = 0;
    const auto scatter_before = [&](float distance) {
        for (; scattered < scratch.scattered_count && scratch.scattered[scattered].distance <= distance; ++scattered)
            sample.inscatter += scratch.scattered[scattered].light[intensity] * covered.transmittance();
    };
    Rgb veil;
    const auto veil_before = [&](size_t k) {
        if (scratch.veil.empty()) return;
        const Rgb here = scratch.veil[k * intensities.size() + intensity];
        sample.inscatter += (here - veil) * covered.transmittance();
        veil = here;
    };
    for (size_t k = 0; k < count; ++k) {
        const StreakHit& hit = scratch.hits[k];
        if (bins.streaks()[hit.streak].threshold_mm_per_h > intensities[intensity]) continue;
        scatter_before(hit.covered.distance);
        veil_before(k);
        const float weight = cover(hit);
        if (hit.width >= 1) sample.wide_coverage += weight;
        sample.light += scratch.light[k] * (weight * transmission[k * intensities.size()] * gain);
    }
    scatter_before(std::numeric_limits<float>::infinity());
    veil_before(count);
    sample.coverage = covered.total();
    sample.transmission = covered.transmittance() * transmission[count * intensities.size()];
    return sample;
}

}  // namespace

RainStage::RainStage(const PathTracer& tracer, const StreakBins& bins, const RainMedium* medium,
                     std::vector<double> intensities, const StreakSettings& settings)
    : tracer_(&tracer), bins_(&bins), medium_(medium), intensities_(std::move(intensities)), settings_(settings) {}

void RainStage::set_drop_light(const DropLight& light) {
    drop_light_ = &light;
    if (!medium_) return;
    slice_depths_.resize(DropLight::slices * intensities_.size());
    for (int k = 0; k + 1 < DropLight::slices; ++k)
        medium_->axis_depths(DropLight::end_of(k), &slice_depths_[size_t(k) * intensities_.size()]);
}

bool RainStage::evaluate(const CameraSegment& segment, const Sampler& sampler, std::vector<RainSample>& samples,
                         RainScratch& scratch, Counters& counters) const {
    counters.count(Feature::streak_test);
    find_hits(*bins_, segment.candidates, segment.view_ray, scratch.hits);
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
    const bool tabled = segment.drop_light != nullptr;
    const auto is_wide = [](const StreakHit& hit) { return hit.width > 1; };
    if (!tabled || std::ranges::any_of(scratch.hits, is_wide)) sample_distant(sampler, scratch);
    if (!in_rain.empty()) {
        find_transmissions(in_rain, scratch);
        if (tabled) find_veil(segment, in_rain, scratch);
        if (!tabled || tracer_->lights().has_local())
            scatter(Scatterer::drop, segment, in_rain, sampler, scratch, counters);
        if (medium_->has_fog()) scatter(Scatterer::fog, segment, in_rain, sampler, scratch, counters);
    }
    scratch.light.clear();
    for (const StreakHit& hit : scratch.hits)
        scratch.light.push_back(tabled ? tabled_light(hit, segment, scratch.distant, sampler, counters)
                                       : streak_light(hit, segment, scratch.distant, sampler, counters));
    compose(scratch, segment, samples, counters);
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

/// Physical: streaks hide each other where their times overlap. The paper's: I' = (1 - S_a tau1/T) I + S tau1/tau0
/// with S = gain S_a L tau0/T, in linear light, where L holds the streak's texture.
void RainStage::compose(const RainScratch& scratch, const CameraSegment& segment, std::vector<RainSample>& samples,
                        Counters& counters) const {
    const bool paper = settings_.composition == Composition::paper;
    if (paper && !scratch.hits.empty()) counters.count(Feature::paper_streak);
    for (size_t i = 0; i < intensities_.size(); ++i) {
        if (paper) {
            PaperCover covered;
            const auto cover = [&](const StreakHit& hit) { return covered.add(paper_weight(hit, segment)); };
            samples[i] = composed(scratch, *bins_, intensities_, i, covered, float(settings_.paper_gain), cover);
        } else {
            ExposureUnion covered;
            const auto cover = [&](const StreakHit& hit) { return covered.add(hit.covered.begin, hit.covered.end); };
            samples[i] = composed(scratch, *bins_, intensities_, i, covered, 1, cover);
        }
    }
}

}  // namespace pluvia
