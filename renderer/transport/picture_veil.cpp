// The rain stage in front of pictures, with light of fine drops from a table: what the samples of a pixel share is
// found once, and only drops that are looked into are traced.
#include "renderer/transport/rain_stage.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

void RainStage::begin_pixel(int x, int y, const CameraSegment& segment, PixelVeil& veil) const {
    const float cosine = segment.view_ray.direction.z;
    const size_t count = intensities_.size();
    veil.last = DropLight::slice_of(segment.view_ray.t_max * cosine);
    drop_light_->find(x, y, veil.last, veil.light);
    veil.untouched.assign(count, {});
    veil.streaks = segment.candidates;
    if (medium_) find_medium(segment, veil);
    find_before_streaks(cosine, veil);
}

/// The medium along the ray through the pixel's centre.
void RainStage::find_medium(const CameraSegment& segment, PixelVeil& veil) const {
    const float cosine = segment.view_ray.direction.z;
    const size_t count = intensities_.size();
    Ray ray = segment.ray;
    ray.t_max = segment.view_ray.t_max;
    veil.in_rain = medium_->segment(ray, cosine);
    const size_t size = size_t(veil.last + 1) * count;
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
        for (int k = 0; k <= veil.last; ++k) {
            veil.transmissions[size_t(k) * count + i] = here;
            veil.inscatter[size_t(k) * count + i] = sum;
            float next = end;
            if (k < veil.last) {
                const float depth = (slice_depths_[size_t(k) * count + i] - depths[i]) / cosine;
                next = std::clamp(std::exp(-depth), end, here);
            }
            sum += veil.light[size_t(k)].radiance * (here - next);
            here = next;
        }
        veil.untouched[i].inscatter = sum;
    }
}

/// Fills what the veil says of its streaks. cosine: of the ray through the pixel's centre to the view axis.
void RainStage::find_before_streaks(float cosine, PixelVeil& veil) const {
    const size_t count = intensities_.size();
    veil.slices.clear();
    veil.passed.assign(veil.streaks.size() * count, 1.0f);
    veil.before.assign(veil.streaks.size() * count, Rgb(0));
    const float half = 0.5f * bins_->exposure_time();
    for (size_t k = 0; k < veil.streaks.size(); ++k) {
        const Streak& streak = bins_->streaks()[veil.streaks[k]];
        const float z = streak.start.z + half * streak.velocity.z;
        const int slice = std::min(veil.last, DropLight::slice_of(z));
        veil.slices.push_back(slice);
        if (!medium_ || veil.in_rain.empty()) continue;
        medium_->axis_depths(std::clamp(z, veil.in_rain.begin * cosine, veil.in_rain.end * cosine), veil.depths.data());
        for (size_t i = 0; i < count; ++i) {
            const float depth = (veil.depths[i] - veil.begin_depths[i]) / cosine;
            const float passed = std::clamp(std::exp(-depth), veil.untouched[i].transmission, 1.0f);
            const size_t begin = size_t(slice) * count + i;
            veil.passed[k * count + i] = passed;
            veil.before[k * count + i] =
                veil.inscatter[begin] + veil.light[size_t(slice)].radiance * (veil.transmissions[begin] - passed);
        }
    }
}

bool RainStage::needs_ray(std::span<const StreakHit> hits) const {
    return settings_.textures || std::ranges::any_of(hits, [](const StreakHit& hit) { return hit.width > 1; });
}

void RainStage::evaluate(const CameraSegment& segment, PixelVeil& veil, const Sampler& sampler,
                         std::vector<RainSample>& samples, RainScratch& scratch, Counters& counters) const {
    const size_t hits = scratch.hits.size(), count = intensities_.size();
    const bool paper = settings_.composition == Composition::paper;
    scratch.scattered_count = 0;
    scratch.transmissions.resize((hits + 1) * count);
    scratch.veil.resize(medium_ ? (hits + 1) * count : 0);
    scratch.light.clear();
    bool distant_known = false;
    for (size_t k = 0; k < hits; ++k) {
        const StreakHit& hit = scratch.hits[k];
        const auto place = size_t(std::ranges::lower_bound(veil.streaks, hit.streak) - veil.streaks.begin());
        const int slice = veil.slices[place];
        std::copy_n(&veil.passed[place * count], count, &scratch.transmissions[k * count]);
        if (medium_) std::copy_n(&veil.before[place * count], count, &scratch.veil[k * count]);
        if (!paper && hit.width <= 1) {
            counters.count(Feature::streak_hit);
            scratch.light.push_back(veil.light[size_t(slice)].radiance);
            continue;
        }
        const Sampler of_streak = streak_sampler(hit, sampler);
        if (!paper && shows_picture(hit, of_streak)) {
            // What the light may be worth is known here before it is sampled, but not which lamp the drop shows.
            // Lamps expected to bring more than that cost more time than the noise they save is worth.
            const float brightness =
                std::max(segment.background_luminance, luminance(veil.light[size_t(slice)].radiance));
            const float most = worth(hit.covered.fraction() * brightness, segment, settings_.streak_roulette);
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
            scratch.light.push_back(fine_light(hit, segment, veil.light[size_t(slice)].radiance, slice, of_streak));
        }
    }
    for (size_t i = 0; i < count; ++i) {
        scratch.transmissions[hits * count + i] = veil.untouched[i].transmission;
        if (medium_) scratch.veil[hits * count + i] = veil.untouched[i].inscatter;
    }
    compose(scratch, segment, samples, counters);
}

}  // namespace pluvia
