// The rain stage: light of a drop that a camera ray meets on its streak.
#include "renderer/transport/rain_stage.h"
#include "renderer/transport/scattered_light.h"
#include "shaders/streak.h"

#include <algorithm>

namespace pluvia {

// Where neither lamps nor a sun can make it glint, light of a drop that is looked into is taken to be at most this many
// times that of its pixel when it is decided for how many samples it is found: what it shows is costly to find.
static constexpr float most_brightness = 4;

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

/// Light of a drop that is not looked into, from the table's for its slice.
Rgb RainStage::fine_light(const StreakHit& hit, const CameraSegment& segment, Rgb light, int slice,
                          const Sampler& sampler) const {
    if (settings_.composition == Composition::physical || !settings_.textures) return light;
    const Streak& streak = bins_->streaks()[hit.streak];
    const float time = 0.5f * (hit.covered.begin + hit.covered.end);
    const StreakPlace place = streak_place(segment.ray.direction, streak.key, 2 * streak.radius, bins_->exposure_time(),
                                           position_across(streak, segment.view_ray), time);
    const Vec3 from =
        drop_light_->direction(int(segment.pixel.x), int(segment.pixel.y), slice, sampler.get_1d(Draw::streak_phase));
    return light * settings_.textures->brightness(place, from);
}

}  // namespace pluvia
