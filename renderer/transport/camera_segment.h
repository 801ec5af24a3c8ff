// A camera segment in the rain: what the rain stage (rain_stage.h) takes and gives, and its buffers.
#pragma once

#include "renderer/rain/rain_medium.h"
#include "renderer/rain/streak_bins.h"
#include "renderer/scene/lights.h"
#include "renderer/transport/drop_light.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace pluvia {

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

}  // namespace pluvia
