// Rows of a frame's EXR file on their way to pictures: read in bands, displayed, and where streaks are seen.
// Which files are made of them is decided in display_files.h and dataset/item_files.h.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/exr.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace pluvia {

class DisplayView;

constexpr int display_band_rows = 64;

using Plane = std::vector<float>;
using ColorPlanes = std::array<Plane, 3>;

struct IntensityPlanes {
    ColorPlanes transmittance, rain, inscatter, rainy;
    Plane coverage, wide_coverage, rainy_z;
};

/// Rows of the EXR file that one band of pictures needs: its own and those that the mask's averages reach.
struct FrameRows {
    int begin, count;  // of the planes
    int band_begin, band_count;
    int width;
    ColorPlanes background;
    Plane z;
    std::vector<IntensityPlanes> rain;  // one per intensity

    size_t first_pixel() const { return size_t(band_begin - begin) * width; }
    size_t band_pixels() const { return size_t(band_count) * width; }
};

/// Gives rows y to y + count - 1 of the channels asked for.
using RowReader = std::function<void(int y, int count, std::span<const ExrRequest> requests)>;

/// Those of the band of at most display_band_rows that begins at row y, of a picture of this size.
FrameRows read_frame_rows(int width, int height, const RowReader& read, int y, const std::vector<double>& intensities);
inline FrameRows read_frame_rows(ExrReader& exr, int y, const std::vector<double>& intensities) {
    const auto read = [&](int first, int count, std::span<const ExrRequest> r) { exr.read_rows(first, count, r); };
    return read_frame_rows(exr.width(), exr.height(), read, y, intensities);
}

/// The band's pixels as a view shows them, scale being exposure_scale() of the frame.
std::vector<Rgb> displayed(const FrameRows& rows, const ColorPlanes& color, const DisplayView& view, float scale);
/// Display values as R, G and B of 8 bits.
std::vector<uint8_t> display_bytes(const std::vector<Rgb>& pixels);

/// For the band's pixels: 255 where streaks at least a pixel wide change the displayed picture visibly, else 0.
std::vector<uint8_t> rain_mask(const FrameRows& rows, const IntensityPlanes& rain, const DisplayView& view, float scale,
                               bool paper);

}  // namespace pluvia
