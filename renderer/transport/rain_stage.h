// The rain stage: what streaks and the medium of finer rain do to the light of one camera segment, for all intensities
// at once. It acts on the segment only; light that arrives at surfaces and drops has not met rain. What is lost on the
// way is scattered and not absorbed: in a uniform world transmitted, streak and scattered light add up to what was
// there.
#pragma once

#include "renderer/transport/camera_segment.h"
#include "renderer/transport/path.h"
#include "renderer/transport/scatter_function.h"
#include "renderer/transport/streak_settings.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace pluvia {

class RainStage {
public:
    /// Keeps references. intensities: in mm/h, any order, those of the medium. medium: null where all rain is streaks.
    RainStage(const PathTracer& tracer, const StreakBins& bins, const RainMedium* medium,
              std::vector<double> intensities_mm_per_h, const StreakSettings& settings);

    /// The same with light of fine drops from a table. Keeps a reference.
    void set_drop_light(const DropLight& light);
    const DropLight* drop_light() const { return drop_light_; }
    /// For all samples of a picture's pixel, where there is a drop_light; segment: of its centre, with candidates that
    /// live as long as the veil is used. A streak is as far as its drop in the middle of the exposure for all of them.
    void begin_pixel(int x, int y, const CameraSegment& segment, PixelVeil& veil) const;
    /// Whether light of a streak depends on CameraSegment::ray; where it does not, evaluate does not look at it.
    bool needs_ray(std::span<const StreakHit> hits) const;
    /// A sample with the streaks of scratch.hits, of which there is at least one.
    void evaluate(const CameraSegment& segment, PixelVeil& veil, const Sampler& sampler,
                  std::vector<RainSample>& samples, RainScratch& scratch, Counters& counters) const;

    /// samples: one per intensity, overwritten. False when no rain touches the segment: then samples are untouched.
    bool evaluate(const CameraSegment& segment, const Sampler& sampler, std::vector<RainSample>& samples,
                  RainScratch& scratch, Counters& counters) const;

private:
    // Keep the random numbers of streaks and medium apart from each other and from those of paths.
    static constexpr uint64_t rain_domain = 0x7261696e, medium_domain = 0x6d656469;

    void sample_distant(const Sampler& sampler, RainScratch& scratch) const;
    void find_transmissions(const RainSegment& in_rain, RainScratch& scratch) const;
    void compose(const RainScratch& scratch, const CameraSegment& segment, std::vector<RainSample>& samples,
                 Counters& counters) const;
    /// Probability with which light is computed that may bring this luminance.
    static float worth(float expected, const CameraSegment& segment, double roulette) {
        return std::min(1.0f, expected / (float(roulette) * segment.background_luminance));
    }

    // streak_light.cpp
    /// Numbers of a drop's own: its light does not depend on which other drops are there.
    Sampler streak_sampler(const StreakHit& hit, const Sampler& sampler) const;
    bool shows_picture(const StreakHit& hit, const Sampler& sampler) const;
    ScatterFunction streak_scatter(const StreakHit& hit, const CameraSegment& segment, const Sampler& sampler) const;
    ScatterFunction lens_scatter(const StreakHit& hit, const CameraSegment& segment, const Sampler& sampler) const;
    float paper_weight(const StreakHit& hit, const CameraSegment& segment) const;
    float streak_weight(const StreakHit& hit, const CameraSegment& segment) const;
    /// most: of the probability with which the light is computed.
    Rgb streak_light(const StreakHit& hit, const CameraSegment& segment, const std::optional<LightSample>& distant,
                     const Sampler& sampler, Counters& counters, float most = 1) const;
    Rgb fine_light(const StreakHit& hit, const CameraSegment& segment, Rgb light, int slice,
                   const Sampler& sampler) const;

    // medium_light.cpp
    void scatter(Scatterer scatterer, const CameraSegment& segment, const RainSegment& in_rain, const Sampler& sampler,
                 RainScratch& scratch, Counters& counters) const;
    void scatter_near_lamp(Scatterer scatterer, const CameraSegment& segment, const RainSegment& in_rain, Vec3 anchor,
                           const Sampler& sampler, RainScratch& scratch, Counters& counters) const;

    // scene_veil.cpp
    void find_veil(const CameraSegment& segment, const RainSegment& in_rain, RainScratch& scratch) const;
    void find_depths(const RainSegment& in_rain, int slice, RainScratch& scratch) const;
    Rgb tabled_light(const StreakHit& hit, const CameraSegment& segment, const std::optional<LightSample>& distant,
                     const Sampler& sampler, Counters& counters) const;
    Rgb lamp_light(const StreakHit& hit, const CameraSegment& segment, float expected, const Sampler& streak_sampler,
                   Counters& counters) const;
    static float lamp_worth(float expected, const CameraSegment& segment, double roulette);

    // picture_veil.cpp
    void find_medium(const CameraSegment& segment, PixelVeil& veil) const;
    void find_before_streaks(float cosine, PixelVeil& veil) const;

    const PathTracer* tracer_;
    const StreakBins* bins_;
    const RainMedium* medium_;
    const DropLight* drop_light_ = nullptr;
    std::vector<float> slice_depths_;  // optical depth from view depth 0 to where each slice ends, per intensity
    std::vector<double> intensities_;
    StreakSettings settings_;
};

}  // namespace pluvia
