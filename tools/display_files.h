// The pictures beside frame.exr, made from it band by band: background, depth, and per intensity the rainy picture,
// the rain layer and the rain mask.
#pragma once

#include "renderer/image/color.h"
#include "renderer/image/depth_encoding.h"
#include "renderer/image/image_io.h"

#include <string>
#include <vector>

namespace pluvia {

struct DisplaySettings {
    std::string view = "srgb";
    double ev100 = 0;
    DepthEncoding depth_encoding = DepthEncoding::kitti16;
    float depth_max = 100;  // metres, of the encoding hri
    bool paper = false;     // the mask of the paper's composition: texture alpha of 0.01 or more
    PngText text;           // stored in every file
};

struct DisplayReport {
    int64_t depths_beyond = 0;        // finite depths that the encoding cannot hold
    std::vector<double> mask_shares;  // per intensity: share of pixels in the rain mask
};

/// Change of a displayed channel that the mask calls rain: 3 of 255 levels.
constexpr float mask_threshold = 3.0f / 255;

/// Writes background.png, depth.png, rainy_*.png, rain_layer_*.png and rain_mask_*.png into folder.
///
/// The mask asks what streaks change in the displayed picture. A streak's light is an estimate of few samples, so it is
/// averaged over the streak first: light per coverage over the pixels around, times the coverage of the pixel. Without
/// that single bright samples would speckle the mask.
DisplayReport write_display_files(const std::string& folder, const std::string& exr,
                                  const std::vector<double>& intensities, const DisplaySettings& settings);

}  // namespace pluvia
