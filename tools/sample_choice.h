// How many samples per pixel a picture needs for an error, or has time for: found by a pilot on some of its pixels,
// whose samples are none of the picture's. So the choice biases nothing, and the picture is that of --spp with the
// count.
#pragma once

#include "renderer/transport/render.h"

#include <optional>

namespace pluvia {

constexpr int most_samples = 1 << 24;

struct SampleGoal {
    /// Square root of the trimmed relMSE (tools/validate/color_metrics.h) against infinitely many samples: of the
    /// background and, where it rains, of the rainy picture of the highest intensity, whichever is larger.
    std::optional<double> error;
    std::optional<double> seconds;  // for the whole, from the start

    bool any() const { return error || seconds; }
};

/// intensities: of the layers; picture_size: pixels of the picture; seed: of the picture; seconds_gone: since the
/// start. The smaller count where both goals are given; 1 at least.
int choose_samples(const SampleGoal& goal, const PixelRenderer& render_pixels, const std::vector<double>& intensities,
                   int64_t picture_size, uint64_t seed, double seconds_gone);

}  // namespace pluvia
