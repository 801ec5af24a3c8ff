// The rain that is too fine or too far to be drawn as streaks, as a medium along a camera ray: at view depth z it is
// all drops narrower than min_width_pixels there, so that with the streaks of streaks.h nothing is missing and nothing
// is counted twice. A plain fog may be added. What the medium scatters is computed by renderer/transport/rain_stage.h.
#pragma once

#include "renderer/core/ray.h"
#include "renderer/core/view.h"
#include "renderer/rain/streaks.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace pluvia {

constexpr double longest_rain_path = 2000;  // metres along a ray, where neither ground nor the top of the rain ends it

/// A part of a ray that a roof keeps dry, metres along it.
struct DryPart {
    float begin, end;
};

/// The part of a ray along which there is rain; empty where end <= begin.
struct RainSegment {
    float begin = 0, end = 0;           // metres along the ray
    float cosine = 1;                   // of the ray with the view axis: view depth = distance * cosine
    std::span<const DryPart> dry = {};  // where there are no drops, in rising order; fog is there, too

    bool empty() const { return end <= begin; }
};

enum class Scatterer { drop, fog };

class RainMedium {
public:
    /// The view and settings that the streaks were found for. drops: false leaves the fog alone.
    RainMedium(const View& view, const RainSettings& settings, bool drops = true);

    /// ray: scene coordinates, from a point of the lens; its t_max is the distance to the first surface. cosine: with
    /// the view axis, above 0.
    RainSegment segment(const Ray& ray, float cosine) const;

    /// Optical depths of the drops of each intensity of the settings from the segment's begin to a distance within it.
    void optical_depths(const RainSegment& segment, float distance, float* depths) const;
    /// The same along the view axis from view depth 0 to z.
    void axis_depths(float z, float* depths) const;
    float fog_depth(const RainSegment& segment, float distance) const {
        return fog_extinction_ * (distance - segment.begin);
    }
    bool has_fog() const { return fog_extinction_ > 0; }

    /// A distance at which to look for scattered light, and per intensity extinction * transmittance from the segment's
    /// begin / pdf there, 0 in dry parts. Its mean over samples is the share of light that this scatterer takes away.
    struct Scattering {
        float distance = 0;  // 0: nothing scatters on the segment
        std::vector<float> weights;
    };
    /// Samples a distance. u: uniform in [0, 1). For drops the density is an even mixture of the truncated exponentials
    /// of three fixed intensities, so that one point serves all intensities asked for, what one intensity gets does not
    /// depend on the others, and no weight exceeds about 3 times the ratio of its extinction to the nearest of the
    /// three. For fog it is the truncated exponential of the fog alone.
    void sample(Scatterer scatterer, const RainSegment& segment, float u, Scattering& result) const;
    /// Density of sample() per metre of the ray.
    float pdf(Scatterer scatterer, const RainSegment& segment, float distance) const;
    /// The weights for a distance within the segment that was sampled with another density.
    void weigh(Scatterer scatterer, const RainSegment& segment, float distance, float pdf, Scattering& result) const;

private:
    static constexpr std::array<double, 3> proposal_intensities_mm_per_h = {5, 25, 125};
    static constexpr size_t proposals = proposal_intensities_mm_per_h.size();

    /// A view depth between two rows of the table: at offset `s` of a step from row `row`, which past the last row is
    /// above 1.
    struct Place {
        const float* row;
        float s;
    };
    Place place_at(float z) const;
    /// Of a profile: the proposals first, then the intensities.
    float extinction(size_t profile, Place place) const;
    float depth(size_t profile, Place place) const;

    void add_profile(size_t profile, double intensity, double step, double diameter_per_depth);
    static bool is_dry(const RainSegment& segment, float distance);
    /// View depth at which the optical depth of a proposal is reached; depth >= 0.
    float find_depth(size_t proposal, float depth) const;
    /// Of the proposals from a segment's begin to its end, above 0; false where there is nothing that scatters.
    bool total_depths(const RainSegment& segment, std::array<float, proposals>& totals) const;
    float drop_pdf(const RainSegment& segment, const std::array<float, proposals>& totals, float distance) const;

    /// Per step of the view depth, per profile: extinction (1/m) and its integral from view depth 0 along the view
    /// axis. Side by side, since a place is asked for all profiles. Extinction is linear between the rows, so that
    /// transmittance, pdf and samples agree to float rounding.
    std::vector<float> table_;
    std::array<std::vector<float>, proposals> proposal_depth_;  // the same, to be searched
    size_t intensities_, row_size_;
    float steps_per_metre_, step_;
    float near_, bottom_, top_;  // metres: view depth; world y
    float fog_extinction_;
};

}  // namespace pluvia
