// The rain stage in scenes, with light of fine drops from a table: only drops that are looked into are traced, and what
// lamps bring straight.
#include "renderer/transport/rain_stage.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

/// In-scattered light of the table's drops. scratch.transmissions are known.
void RainStage::find_veil(const CameraSegment& segment, const RainSegment& in_rain, RainScratch& scratch) const {
    const size_t hits = scratch.hits.size(), count = intensities_.size();
    scratch.veil.resize((hits + 1) * count);
    scratch.passed.assign(count, 1.0f);
    scratch.depths.resize(count);
    // Up to where a slice begins, whatever is hit in it: what one intensity gets does not depend on streaks of others.
    Rgb* const before = &scratch.veil[hits * count];
    std::fill_n(before, count, Rgb(0));
    int slice = DropLight::slice_of(in_rain.begin * in_rain.cosine);
    for (size_t k = 0; k <= hits; ++k) {
        const float end = k < hits ? scratch.hits[k].covered.distance : in_rain.end;
        const float distance = std::clamp(end, in_rain.begin, in_rain.end);
        for (; DropLight::end_of(slice) < distance * in_rain.cosine; ++slice) {
            medium_->optical_depths(in_rain, DropLight::end_of(slice) / in_rain.cosine, scratch.depths.data());
            for (size_t i = 0; i < count; ++i) {
                const float transmission = std::exp(-scratch.depths[i]);
                before[i] += (*segment.drop_light)[size_t(slice)] * (scratch.passed[i] - transmission);
                scratch.passed[i] = transmission;
            }
        }
        const Rgb light = (*segment.drop_light)[size_t(slice)];
        for (size_t i = 0; i < count; ++i)
            scratch.veil[k * count + i] =
                before[i] + light * (scratch.passed[i] - scratch.transmissions[k * count + i]);
    }
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
    const Rgb light = fine_light(hit, segment, (*segment.drop_light)[size_t(slice)], slice, of_streak);
    return tracer_->lights().has_local() ? light + lamp_light(hit, segment, of_streak, counters) : light;
}

/// What lamps bring straight to a drop that is not looked into.
Rgb RainStage::lamp_light(const StreakHit& hit, const CameraSegment& segment, const Sampler& streak_sampler,
                          Counters& counters) const {
    const ScatterFunction function = streak_scatter(hit, segment, streak_sampler);
    const ScatteredLight event(*tracer_, function, segment.ray.at(hit.covered.distance), streak_sampler);
    const float weight = streak_weight(hit, segment);
    const float q = worth(weight * event.unshadowed(), segment, settings_.streak_roulette);
    if (!(streak_sampler.get_1d(Draw::streak_choice) < q)) return Rgb(0);
    return event.trace_lights({segment.background_luminance, weight / q}, counters) * (1 / q);
}

}  // namespace pluvia
