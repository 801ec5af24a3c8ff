// The rain stage in front of pictures, with light of fine drops from a table: what the samples of a pixel share is
// found once, and only drops that are looked into are traced.
#include "renderer/transport/rain_stage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pluvia {

void RainStage::set_drop_light(const DropLight& light) {
    drop_light_ = &light;
    if (!medium_) return;
    slice_depths_.resize(DropLight::slices * intensities_.size());
    for (int k = 0; k + 1 < DropLight::slices; ++k)
        medium_->axis_depths(DropLight::end_of(k), &slice_depths_[size_t(k) * intensities_.size()]);
}

void RainStage::begin_pixel(int x, int y, const CameraSegment& segment, PixelVeil& veil) const {
    const float cosine = segment.view_ray.direction.z;
    const size_t count = intensities_.size();
    veil.x = x, veil.y = y;
    const int last = veil.last = DropLight::slice_of(segment.view_ray.t_max * cosine);
    drop_light_->find(x, y, last, veil.light);
    veil.untouched.assign(count, {});
    if (!medium_) return;
    Ray ray = segment.ray;
    ray.t_max = segment.view_ray.t_max;
    veil.in_rain = medium_->segment(ray, cosine);
    const size_t size = size_t(last + 1) * count;
    veil.transmissions.assign(size, 1.0f);
    veil.inscatter.assign(size, Rgb(0));
    if (veil.in_rain.empty()) return;

    // To where the rain begins and ends; between them depths to a plane are those on the axis over the cosine.
    veil.begin_depths.resize(count);
    veil.depths.resize(count);
    float* const depths = veil.begin_depths.data();
    medium_->optical_depths(veil.in_rain, veil.in_rain.end, depths);
    for (size_t i = 0; i < count; ++i) veil.untouched[i].transmission = std::exp(-depths[i]);
    medium_->axis_depths(veil.in_rain.begin * cosine, depths);
    for (size_t i = 0; i < count; ++i) {
        const float end = veil.untouched[i].transmission;
        float here = 1;
        Rgb sum;
        for (int k = 0; k <= last; ++k) {
            veil.transmissions[size_t(k) * count + i] = here;
            veil.inscatter[size_t(k) * count + i] = sum;
            float next = end;
            if (k < last) {
                const float depth = (slice_depths_[size_t(k) * count + i] - depths[i]) / cosine;
                next = std::clamp(std::exp(-depth), end, here);
            }
            sum += veil.light[size_t(k)] * (here - next);
            here = next;
        }
        veil.untouched[i].inscatter = sum;
    }
}

/// In-scattered light up to where the medium lets pass this much, in a slice.
Rgb RainStage::find_veil(const PixelVeil& veil, int slice, size_t intensity, float transmission) const {
    const size_t k = size_t(slice) * intensities_.size() + intensity;
    return veil.inscatter[k] + veil.light[size_t(slice)] * (veil.transmissions[k] - transmission);
}

/// Light of a drop that is not looked into.
Rgb RainStage::fine_light(const StreakHit& hit, const CameraSegment& segment, const PixelVeil& veil, int slice,
                          const Sampler& sampler) const {
    const Rgb light = veil.light[size_t(slice)];
    if (settings_.composition == Composition::physical || !settings_.textures) return light;
    const Streak& streak = bins_->streaks()[hit.streak];
    const float time = 0.5f * (hit.covered.begin + hit.covered.end);
    const StreakPlace place = streak_place(segment.ray.direction, streak.key, 2 * streak.radius, bins_->exposure_time(),
                                           position_across(streak, segment.view_ray), time);
    const Vec3 from = drop_light_->direction(veil.x, veil.y, slice, sampler.get_1d(Draw::streak_phase));
    return light * settings_.textures->brightness(place, from);
}

void RainStage::evaluate(const CameraSegment& segment, PixelVeil& veil, const Sampler& sampler,
                         std::vector<RainSample>& samples, RainScratch& scratch, Counters& counters) const {
    const size_t hits = scratch.hits.size(), count = intensities_.size();
    const bool paper = settings_.composition == Composition::paper;
    scratch.scattered_count = 0;
    scratch.transmissions.assign((hits + 1) * count, 1.0f);
    scratch.veil.assign(medium_ ? (hits + 1) * count : 0, Rgb(0));
    scratch.light.clear();
    bool distant_known = false;
    for (size_t k = 0; k < hits; ++k) {
        const StreakHit& hit = scratch.hits[k];
        const float distance = hit.covered.distance;
        const int slice = std::min(veil.last, DropLight::slice_of(distance * segment.view_ray.direction.z));
        if (medium_ && !veil.in_rain.empty()) {
            const float along = std::clamp(distance, veil.in_rain.begin, veil.in_rain.end);
            medium_->axis_depths(along * veil.in_rain.cosine, veil.depths.data());
            for (size_t i = 0; i < count; ++i) {
                const float depth = (veil.depths[i] - veil.begin_depths[i]) / veil.in_rain.cosine;
                const float passed = std::clamp(std::exp(-depth), veil.untouched[i].transmission, 1.0f);
                scratch.transmissions[k * count + i] = passed;
                scratch.veil[k * count + i] = find_veil(veil, slice, i, passed);
            }
        }
        const Sampler of_streak = streak_sampler(hit, sampler);
        if (!paper && shows_picture(hit, of_streak)) {
            // What the light may be worth is known here before it is sampled, but not which lamp the drop shows.
            const float brightness = std::max(segment.background_luminance, luminance(veil.light[size_t(slice)]));
            const float margin = tracer_->lights().has_local() ? 4 : 1;
            const float most = worth(margin * hit.covered.fraction() * brightness, segment, settings_.streak_roulette);
            if (!(most >= 1) && of_streak.get_1d(Draw::streak_choice) >= most) {
                counters.count(Feature::streak_hit);
                scratch.light.push_back(Rgb(0));
                continue;
            }
            if (!distant_known) sample_distant(sampler, scratch);
            distant_known = true;
            scratch.light.push_back(streak_light(hit, segment, scratch.distant, sampler, counters, most));
        } else {
            counters.count(Feature::streak_hit);
            scratch.light.push_back(fine_light(hit, segment, veil, slice, of_streak));
        }
    }
    for (size_t i = 0; i < count; ++i) {
        scratch.transmissions[hits * count + i] = veil.untouched[i].transmission;
        if (medium_) scratch.veil[hits * count + i] = veil.untouched[i].inscatter;
    }
    if (paper) counters.count(Feature::paper_streak);
    for (size_t i = 0; i < count; ++i)
        samples[i] = paper ? compose_paper(scratch, segment, i) : compose_physical(scratch, i);
}

}  // namespace pluvia
