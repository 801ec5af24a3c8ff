// A network's picture laid over the clean one where there is rain, and its colours held to what is known beside it.
// All pictures are display-coded.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/image.h"

namespace pluvia {

/// From this alpha on, of 255, a pixel is rain: alpha / 255 >= 0.01, as published.
constexpr int rain_alpha = 3;
/// From this alpha on the network's pixel stands alone; between the two it fades in. Simulated layers reach 5 of 255 at
/// 10 mm/h and 11 at 100 mm/h, so a longer ramp would take most of their rain away.
constexpr int full_alpha = 6;

struct BlendSettings {
    bool soft = true;           // fade at the rims of streaks; else the published hard mask
    bool lighten = false;       // per channel the brighter of network and clean picture
    bool anchor_colors = true;  // see anchor_colors()
};

/// Streak coverage of a rain layer or mask: its alpha where any pixel has one below 255, else its red channel.
Image<uint8_t> rain_coverage(const Image<Rgba8>& mask);

/// Where there is no rain the truth is known, so the difference between it and the prediction is: it is carried into
/// the rain as a mean over known pixels around, weighed by a Gaussian of sigma pixels (its width rises to 4 sigma where
/// none are near). prediction: 0..1, changed in place.
void anchor_colors(Image<Rgb>& prediction, const Image<Rgba8>& background, const Image<uint8_t>& coverage,
                   int sigma = 16);

/// The rainy picture. Pixels without rain keep the bytes of the background, all pixels its alpha.
Image<Rgba8> blend(Image<Rgb> prediction, const Image<Rgba8>& background, const Image<uint8_t>& coverage,
                   const BlendSettings& settings);

}  // namespace pluvia
