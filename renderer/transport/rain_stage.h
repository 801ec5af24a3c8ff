// The rain stage: what streaks and the medium of finer rain do to the light of one camera segment, for all intensities
// at once. It acts on the segment only; light that arrives at surfaces and drops has not met rain. What is lost on the
// way is scattered and not absorbed: in a uniform world transmitted, streak and scattered light add up to what was
// there.
#pragma once

#include "renderer/rain/rain_medium.h"
#include "renderer/rain/streak_bins.h"
#include "renderer/transport/drop_light.h"
#include "renderer/transport/far_light.h"
#include "renderer/transport/path.h"
#include "renderer/transport/scattered_light.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
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
    /// What streaks look like with the paper's composition; null: even.
    std::shared_ptr<const StreakTextures> textures;
    /// Light of weight w is computed with probability q = min(1, w L / (c L_background)): this is c. At 0.25 time
    /// times error of the rainy picture is least on wet streets by day, and it has less noise than the clean one.
    double streak_roulette = 0.25, medium_roulette = 0.25;
    /// Light of drops too fine to show where they are comes from drop_light.h; else, and in fog, their paths are
    /// traced.
    bool tabled_veil = false;
    /// What is far around, for the table in front of a picture.
    std::shared_ptr<const FarLight> far_light = nullptr;
};

/// From the camera to the first surface.
struct CameraSegment {
    Vec2 pixel;                            // position on the picture
    std::span<const uint32_t> candidates;  // streaks that rays through it may meet, in the order of StreakBins
    Ray ray;                               // scene coordinates
    Ray view_ray;                          // the same in view coordinates; t_max = distance to the first surface
    Rgb background;                        // radiance that arrives along the ray without rain
    float background_luminance;            // its mean over the pixel as far as known, to decide what a streak is worth
    std::span<const DryPart> dry = {};     // of the ray, where no rain falls
    const DropLight::Slices* drop_light = nullptr;  // of the pixel, in scenes; null: paths find it
};

/// What rain does to a segment at one intensity.
struct RainSample {
    float coverage = 0;       // by streaks
    float wide_coverage = 0;  // by those at least a pixel wide
    float transmission = 1;   // of the background, through streaks and medium
    Rgb light;                // of streaks, through the medium before them
    Rgb inscatter;            // of the medium, between the streaks before it
};

/// Buffers of a caller, so that no segment allocates.
struct RainScratch {
    std::vector<StreakHit> hits;
    std::optional<LightSample> distant;  // of sun and sky, for all events on the segment
    std::vector<Rgb> light;              // per hit
    std::vector<float> transmissions;    // of the medium: per hit, then per intensity; and to the segment's end
    struct Scattered {
        float distance;          // metres
        std::vector<Rgb> light;  // per intensity, with its weight but for the streaks before it
    };
    std::array<Scattered, 4> scattered;  // the first scattered_count are valid, in order of distance
    int scattered_count = 0;
    RainMedium::Scattering scattering;
    std::vector<Rgb> veil;         // of a table: in-scattered light up to each hit and to the end, per intensity
    std::vector<float> lamp_veil;  // of a table: what lamps bring to the medium if nothing shadows them, cd/m2
    std::vector<float> passed, begin_depths, depths;  // buffers of find_veil
};

/// What the samples of a pixel share in front of pictures: light of drops along its ray, and the medium between the
/// slices of DropLight.
struct PixelVeil {
    int last = 0;  // slice of the surface
    RainSegment in_rain;
    DropLight::Slices light;            // of drops, up to the slice of the surface
    std::vector<float> transmissions;   // to where each slice begins, per intensity
    std::vector<Rgb> inscatter;         // the same
    std::vector<float> begin_depths;    // optical, along the view axis to where the rain begins, per intensity
    std::vector<float> depths;          // a buffer of as many
    std::vector<RainSample> untouched;  // per intensity: what a sample is that no streak touches
    std::span<const uint32_t> streaks;  // that samples may meet, rising; for each of them:
    std::vector<int> slices;            // where it is
    std::vector<float> passed;          // transmission of the medium up to it, per intensity
    std::vector<Rgb> before;            // in-scattered light up to it, per intensity
};

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
    void scatter(Scatterer scatterer, const CameraSegment& segment, const RainSegment& in_rain, const Sampler& sampler,
                 RainScratch& scratch, Counters& counters) const;
    void scatter_near_lamp(Scatterer scatterer, const CameraSegment& segment, const RainSegment& in_rain, Vec3 anchor,
                           const Sampler& sampler, RainScratch& scratch, Counters& counters) const;
    void compose_physical(const RainScratch& scratch, size_t intensity, RainSample& result) const;
    void compose_paper(const RainScratch& scratch, const CameraSegment& segment, size_t intensity,
                       RainSample& result) const;
    /// Numbers of a drop's own: its light does not depend on which other drops are there.
    Sampler streak_sampler(const StreakHit& hit, const Sampler& sampler) const;
    void find_medium(const CameraSegment& segment, PixelVeil& veil) const;
    void find_before_streaks(float cosine, PixelVeil& veil) const;
    bool shows_picture(const StreakHit& hit, const Sampler& sampler) const;
    Rgb fine_light(const StreakHit& hit, const CameraSegment& segment, Rgb light, int slice,
                   const Sampler& sampler) const;
    void find_veil(const CameraSegment& segment, const RainSegment& in_rain, RainScratch& scratch) const;
    void find_depths(const RainSegment& in_rain, int slice, RainScratch& scratch) const;
    Rgb tabled_light(const StreakHit& hit, const CameraSegment& segment, const std::optional<LightSample>& distant,
                     const Sampler& sampler, Counters& counters) const;
    Rgb lamp_light(const StreakHit& hit, const CameraSegment& segment, float expected, const Sampler& streak_sampler,
                   Counters& counters) const;
    static float lamp_worth(float expected, const CameraSegment& segment, double roulette);
    float streak_weight(const StreakHit& hit, const CameraSegment& segment) const;
    /// most: of the probability with which the light is computed.
    Rgb streak_light(const StreakHit& hit, const CameraSegment& segment, const std::optional<LightSample>& distant,
                     const Sampler& sampler, Counters& counters, float most = 1) const;
    ScatterFunction streak_scatter(const StreakHit& hit, const CameraSegment& segment, const Sampler& sampler) const;
    ScatterFunction lens_scatter(const StreakHit& hit, const CameraSegment& segment, const Sampler& sampler) const;
    float paper_weight(const StreakHit& hit, const CameraSegment& segment) const;
    /// Probability with which light is computed that may bring this luminance.
    static float worth(float expected, const CameraSegment& segment, double roulette) {
        return std::min(1.0f, expected / (float(roulette) * segment.background_luminance));
    }

    const PathTracer* tracer_;
    const StreakBins* bins_;
    const RainMedium* medium_;
    const DropLight* drop_light_ = nullptr;
    std::vector<float> slice_depths_;  // optical depth from view depth 0 to where each slice ends, per intensity
    std::vector<double> intensities_;
    StreakSettings settings_;
};

}  // namespace pluvia
