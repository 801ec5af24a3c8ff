// The rain stage: what streaks do to the light of one camera segment, for all intensities at once.
// It acts on the segment only; light that arrives at surfaces and drops has not met rain.
#pragma once

#include "renderer/rain/streak_bins.h"
#include "renderer/transport/path.h"

#include <vector>

namespace pluvia {

enum class Composition { physical, paper };

/// Names of compositions on the command line and in files.
const char* composition_name(Composition composition);

struct StreakSettings {
    Composition composition = Composition::physical;
    /// Factor on the light of streaks with the paper's composition. 24.5 is what the paper's published code amounts to
    /// (exposure 1/60 s over its tau0 of 0.68 ms); 1 would be exact.
    double paper_gain = 24.5;
    /// A streak's light is computed with probability q = min(1, alpha L_streak / (c L_background)): this is c.
    double roulette = 0.1;
};

/// From the camera to the first surface.
struct CameraSegment {
    Vec2 pixel;                  // position on the picture
    Ray ray;                     // scene coordinates
    Ray view_ray;                // the same in view coordinates; t_max = distance to the first surface
    Rgb background;              // radiance that arrives along the ray without rain
    float background_luminance;  // its mean over the pixel as far as known, to decide what a streak is worth
};

/// What rain does to a segment at one intensity; the background's weight is 1 - coverage.
struct RainSample {
    float coverage = 0;
    Rgb light;
};

/// Buffers of a caller, so that no segment allocates.
struct RainScratch {
    std::vector<StreakHit> hits;
    std::vector<Rgb> light;  // per hit
};

class RainStage {
public:
    /// Keeps references to tracer and bins. intensities: in mm/h, any order.
    RainStage(const PathTracer& tracer, const StreakBins& bins, std::vector<double> intensities_mm_per_h,
              const StreakSettings& settings);

    /// samples: one per intensity, overwritten. False when no streak touches the segment: then samples are untouched.
    bool evaluate(const CameraSegment& segment, const Sampler& sampler, std::vector<RainSample>& samples,
                  RainScratch& scratch, Counters& counters) const;

private:
    void compose_physical(const RainScratch& scratch, std::vector<RainSample>& samples) const;
    void compose_paper(const RainScratch& scratch, const CameraSegment& segment,
                       std::vector<RainSample>& samples) const;
    Rgb streak_light(const StreakHit& hit, const CameraSegment& segment, const Sampler& sampler,
                     Counters& counters) const;

    const PathTracer* tracer_;
    const StreakBins* bins_;
    std::vector<double> intensities_;
    StreakSettings settings_;
};

}  // namespace pluvia
