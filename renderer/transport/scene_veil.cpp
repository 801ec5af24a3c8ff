// The rain stage in scenes, with light of fine drops from a table: only drops that are looked into are traced, and what
// lamps bring straight, of which the table knows how much it may be: so much the more seldom are they asked.
#include "renderer/transport/rain_stage.h"
#include "renderer/transport/scattered_light.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

// In a cell there may be more light than its mean, and what is found seldom is bright then.
static constexpr float least_worth = 0.25f;

/// In-scattered light of the table's drops, and what lamps may add to it. scratch.transmissions are known.
void RainStage::find_veil(const CameraSegment& segment, const RainSegment& in_rain, RainScratch& scratch) const {
    const size_t hits = scratch.hits.size(), count = intensities_.size();
    scratch.veil.resize((hits + 1) * count);
    scratch.passed.assign(count, 1.0f);
    scratch.begin_depths.resize(count);
    scratch.depths.resize(count);
    medium_->axis_depths(in_rain.begin * in_rain.cosine, scratch.begin_depths.data());
    scratch.lamp_veil.assign(count, 0.0f);
    // Up to where a slice begins, whatever is hit in it: what one intensity gets does not depend on streaks of others.
    Rgb* const before = &scratch.veil[hits * count];
    std::fill_n(before, count, Rgb(0));
    int slice = DropLight::slice_of(in_rain.begin * in_rain.cosine);
    for (size_t k = 0; k <= hits; ++k) {
        const float end = k < hits ? scratch.hits[k].covered.distance : in_rain.end;
        const float distance = std::clamp(end, in_rain.begin, in_rain.end);
        for (; DropLight::end_of(slice) < distance * in_rain.cosine; ++slice) {
            const DropLight::Light& light = (*segment.drop_light)[size_t(slice)];
            find_depths(in_rain, slice, scratch);
            for (size_t i = 0; i < count; ++i) {
                const float transmission = std::exp(-scratch.depths[i]);
                before[i] += light.radiance * (scratch.passed[i] - transmission);
                scratch.lamp_veil[i] += light.lamps * (scratch.passed[i] - transmission);
                scratch.passed[i] = transmission;
            }
        }
        const Rgb light = (*segment.drop_light)[size_t(slice)].radiance;
        for (size_t i = 0; i < count; ++i)
            scratch.veil[k * count + i] =
                before[i] + light * (scratch.passed[i] - scratch.transmissions[k * count + i]);
    }
    for (size_t i = 0; i < count; ++i)
        scratch.lamp_veil[i] +=
            (*segment.drop_light)[size_t(slice)].lamps * (scratch.passed[i] - scratch.transmissions[hits * count + i]);
}

/// Optical depths up to the end of a slice: where no part is dry, those on the axis over the cosine.
void RainStage::find_depths(const RainSegment& in_rain, int slice, RainScratch& scratch) const {
    if (!in_rain.dry.empty()) {
        medium_->optical_depths(in_rain, DropLight::end_of(slice) / in_rain.cosine, scratch.depths.data());
        return;
    }
    const float* const on_axis = &slice_depths_[size_t(slice) * intensities_.size()];
    for (size_t i = 0; i < intensities_.size(); ++i)
        scratch.depths[i] = std::max(0.0f, (on_axis[i] - scratch.begin_depths[i]) / in_rain.cosine);
}

/// Light of a drop, from the table unless it is looked into.
Rgb RainStage::tabled_light(const StreakHit& hit, const CameraSegment& segment,
                            const std::optional<LightSample>& distant, const Sampler& sampler,
                            Counters& counters) const {
    const Sampler of_streak = streak_sampler(hit, sampler);
    if (settings_.composition == Composition::physical && shows_picture(hit, of_streak))
        return streak_light(hit, segment, distant, sampler, counters);
    counters.count(Feature::streak_hit);
    const int slice = DropLight::slice_of(hit.covered.distance * segment.view_ray.direction.z);
    const DropLight::Light& light = (*segment.drop_light)[size_t(slice)];
    Rgb result = fine_light(hit, segment, light.radiance, slice, of_streak);
    if (tracer_->lights().has_local()) result += lamp_light(hit, segment, light.lamps, of_streak, counters);
    return result;
}

/// Probability with which lamps are asked that are expected to bring this luminance.
float RainStage::lamp_worth(float expected, const CameraSegment& segment, double roulette) {
    return std::max(least_worth, worth(expected, segment, roulette));
}

/// What lamps bring straight to a drop that is not looked into; expected: as the table has it.
Rgb RainStage::lamp_light(const StreakHit& hit, const CameraSegment& segment, float expected,
                          const Sampler& streak_sampler, Counters& counters) const {
    const float weight = streak_weight(hit, segment), choice = streak_sampler.get_1d(Draw::streak_choice);
    const float hoped = lamp_worth(weight * expected, segment, settings_.streak_roulette);
    if (!(choice < hoped)) return Rgb(0);
    const ScatterFunction function = streak_scatter(hit, segment, streak_sampler);
    const ScatteredLight event(*tracer_, function, segment.ray.at(hit.covered.distance), streak_sampler);
    const float q = std::min(hoped, worth(weight * event.unshadowed(), segment, settings_.streak_roulette));
    if (!(choice < q)) return Rgb(0);
    return event.trace_lights({segment.background_luminance, weight / q}, counters) * (1 / q);
}

}  // namespace pluvia
