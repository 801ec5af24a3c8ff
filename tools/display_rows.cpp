#include "tools/display_rows.h"

#include "renderer/image/color.h"
#include "renderer/transport/layers.h"
#include "tools/display_files.h"

#include <algorithm>

namespace pluvia {
namespace {

constexpr int mask_radius = 4;  // pixels around over which a streak's light is averaged

/// Sums over the square around each pixel, clipped at the borders of the rows at hand.
Plane box_sums(const Plane& plane, int width, int height) {
    Plane across(plane.size()), sums(plane.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int k = std::max(0, x - mask_radius); k <= std::min(width - 1, x + mask_radius); ++k)
                across[size_t(y) * width + x] += plane[size_t(y) * width + k];
    for (int y = 0; y < height; ++y)
        for (int k = std::max(0, y - mask_radius); k <= std::min(height - 1, y + mask_radius); ++k)
            for (int x = 0; x < width; ++x) sums[size_t(y) * width + x] += across[size_t(k) * width + x];
    return sums;
}

}  // namespace

FrameRows read_frame_rows(int width, int height, const RowReader& read, int y, const std::vector<double>& intensities) {
    FrameRows rows;
    rows.width = width;
    rows.band_begin = y;
    rows.band_count = std::min(display_band_rows, height - y);
    rows.begin = std::max(0, y - mask_radius);
    rows.count = std::min(height, y + rows.band_count + mask_radius) - rows.begin;
    rows.rain.resize(intensities.size());
    std::vector<ExrRequest> requests;
    const auto ask = [&](Plane& plane, const std::string& channel) {
        plane.resize(size_t(rows.count) * rows.width);
        requests.push_back({channel, plane.data()});
    };
    const auto ask_color = [&](ColorPlanes& color, const std::string& layer) {
        for (int c = 0; c < 3; ++c) ask(color[c], layer + "." + "RGB"[c]);
    };
    ask_color(rows.background, "background");
    ask(rows.z, "Z");
    for (size_t i = 0; i < intensities.size(); ++i) {
        const std::string label = intensity_label(intensities[i]);
        ask_color(rows.rain[i].transmittance, "transmittance_" + label);
        ask_color(rows.rain[i].rain, "rain_" + label);
        ask_color(rows.rain[i].inscatter, "inscatter_" + label);
        ask_color(rows.rain[i].rainy, "rainy_" + label);
        ask(rows.rain[i].coverage, "rain_" + label + ".A");
        ask(rows.rain[i].wide_coverage, "rain_wide_" + label + ".A");
        ask(rows.rain[i].rainy_z, "rainy_Z_" + label);
    }
    read(rows.begin, rows.count, requests);
    return rows;
}

std::vector<Rgb> displayed(const FrameRows& rows, const ColorPlanes& color, const DisplayView& view, float scale) {
    std::vector<Rgb> pixels(rows.band_pixels());
    const size_t first = rows.first_pixel();
    for (size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = Rgb(color[0][first + i], color[1][first + i], color[2][first + i]) * scale;
    view.apply(pixels);
    return pixels;
}

std::vector<uint8_t> display_bytes(const std::vector<Rgb>& pixels) {
    std::vector<uint8_t> result;
    result.reserve(3 * pixels.size());
    for (const Rgb p : pixels)
        for (const float c : {p.r, p.g, p.b}) result.push_back(byte_from_display(c));
    return result;
}

std::vector<uint8_t> rain_mask(const FrameRows& rows, const IntensityPlanes& rain, const DisplayView& view, float scale,
                               bool paper) {
    std::vector<uint8_t> mask(rows.band_pixels(), 0);
    const size_t first = rows.first_pixel();
    if (paper) {
        for (size_t i = 0; i < mask.size(); ++i) mask[i] = rain.coverage[first + i] >= 0.01f ? 255 : 0;
        return mask;
    }
    const Plane coverage_around = box_sums(rain.coverage, rows.width, rows.count);
    std::array<Plane, 3> light_around;
    for (int c = 0; c < 3; ++c) light_around[c] = box_sums(rain.rain[c], rows.width, rows.count);
    std::vector<Rgb> with(mask.size()), without(mask.size());
    for (size_t i = 0; i < mask.size(); ++i) {
        const size_t k = first + i;
        const float coverage = rain.wide_coverage[k], per_coverage = 1 / std::max(coverage_around[k], 1e-30f);
        const float share = coverage * per_coverage, fine_share = (rain.coverage[k] - coverage) * per_coverage;
        // What finer rain leaves and adds, if no wide streak hid it, is the picture that these change.
        const float uncovered = 1 / std::max(1 - coverage, 1e-3f);
        float value[3], bare[3];
        for (int c = 0; c < 3; ++c) {
            const float rest = rows.background[c][k] * rain.transmittance[c][k] + rain.inscatter[c][k] +
                               light_around[c][k] * fine_share;
            value[c] = rest + light_around[c][k] * share;
            bare[c] = rest * uncovered;
        }
        with[i] = Rgb(value[0], value[1], value[2]) * scale;
        without[i] = Rgb(bare[0], bare[1], bare[2]) * scale;
    }
    view.apply(with);
    view.apply(without);
    for (size_t i = 0; i < mask.size(); ++i) {
        const Rgb d = with[i] - without[i];
        mask[i] = std::max({std::abs(d.r), std::abs(d.g), std::abs(d.b)}) >= mask_threshold ? 255 : 0;
    }
    return mask;
}

}  // namespace pluvia
