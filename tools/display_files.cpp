#include "tools/display_files.h"

#include "renderer/core/parallel.h"
#include "renderer/image/exposure.h"
#include "renderer/image/exr.h"
#include "renderer/transport/layers.h"

#include <algorithm>
#include <memory>

namespace pluvia {
namespace {

constexpr int band_rows = 64;
constexpr int mask_radius = 4;  // pixels around over which a streak's light is averaged

using Plane = std::vector<float>;
using Color = std::array<Plane, 3>;

struct IntensityPlanes {
    Color transmittance, rain, inscatter, rainy;
    Plane coverage, wide_coverage;
};

/// Rows of the EXR file that one band of pictures needs: its own and those that the mask's averages reach.
struct Rows {
    int begin, count;  // of the planes
    int band_begin, band_count;
    int width;
    Color background;
    Plane z;
    std::vector<IntensityPlanes> rain;

    size_t first_pixel() const { return size_t(band_begin - begin) * width; }
    size_t band_pixels() const { return size_t(band_count) * width; }
};

Rows read(ExrReader& exr, int y, const std::vector<double>& intensities) {
    Rows rows;
    rows.width = exr.width();
    rows.band_begin = y;
    rows.band_count = std::min(band_rows, exr.height() - y);
    rows.begin = std::max(0, y - mask_radius);
    rows.count = std::min(exr.height(), y + rows.band_count + mask_radius) - rows.begin;
    rows.rain.resize(intensities.size());
    std::vector<ExrRequest> requests;
    const auto ask = [&](Plane& plane, const std::string& channel) {
        plane.resize(size_t(rows.count) * rows.width);
        requests.push_back({channel, plane.data()});
    };
    const auto ask_color = [&](Color& color, const std::string& layer) {
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
    }
    exr.read_rows(rows.begin, rows.count, requests);
    return rows;
}

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

std::vector<Rgb> displayed(const Rows& rows, const Color& color, const DisplayView& view, float scale) {
    std::vector<Rgb> pixels(rows.band_pixels());
    const size_t first = rows.first_pixel();
    for (size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = Rgb(color[0][first + i], color[1][first + i], color[2][first + i]) * scale;
    view.apply(pixels);
    return pixels;
}

std::vector<uint8_t> bytes(const std::vector<Rgb>& pixels) {
    std::vector<uint8_t> result;
    result.reserve(3 * pixels.size());
    for (const Rgb p : pixels)
        for (const float c : {p.r, p.g, p.b}) result.push_back(byte_from_display(c));
    return result;
}

/// 255 where streaks at least a pixel wide change the displayed picture visibly.
std::vector<uint8_t> rain_mask(const Rows& rows, const IntensityPlanes& rain, const DisplayView& view, float scale,
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

class DepthFile {
public:
    DepthFile(const std::string& path, int width, int height, const DisplaySettings& settings)
        : settings_(settings),
          rgb_(settings.depth_encoding == DepthEncoding::carla24),
          writer_(path, width, height, rgb_ ? 3 : 1, rgb_ ? 8 : 16, settings.text) {}

    void write(const Rows& rows, DisplayReport& report) {
        const std::span<const float> z(rows.z.data() + rows.first_pixel(), rows.band_pixels());
        report.depths_beyond += count_beyond(z, limit());
        if (rgb_) {
            std::vector<uint8_t> values;
            for (const float metres : z) {
                const Rgba8 v = encode_carla24(metres);
                values.insert(values.end(), {v.r, v.g, v.b});
            }
            writer_.write_rows(rows.band_begin, rows.band_count, values.data());
            return;
        }
        std::vector<uint16_t> values;
        for (const float metres : z) values.push_back(encode(metres));
        writer_.write_rows(rows.band_begin, rows.band_count, values.data());
    }
    void finish() { writer_.finish(); }

private:
    float limit() const {
        switch (settings_.depth_encoding) {
            case DepthEncoding::mm16:
                return mm16_limit;
            case DepthEncoding::carla24:
                return carla24_limit;
            case DepthEncoding::hri:
                return settings_.depth_max;
            default:
                return kitti16_limit;
        }
    }
    uint16_t encode(float metres) const {
        switch (settings_.depth_encoding) {
            case DepthEncoding::mm16:
                return encode_mm16(metres);
            case DepthEncoding::hri:
                return encode_hri(metres, settings_.depth_max);
            default:
                return encode_kitti16(metres);
        }
    }

    const DisplaySettings& settings_;
    bool rgb_;
    PngWriter writer_;
};

struct IntensityFiles {
    PngWriter rainy, layer, mask;
};

}  // namespace

DisplayReport write_display_files(const std::string& folder, const std::string& exr_path,
                                  const std::vector<double>& intensities, const DisplaySettings& settings) {
    ExrReader exr(exr_path);
    const int width = exr.width(), height = exr.height();
    const DisplayView view(settings.view);
    const float scale = exposure_scale(settings.ev100);
    PngWriter background_file(folder + "/background.png", width, height, 3, 8, settings.text);
    DepthFile depth_file(folder + "/depth.png", width, height, settings);
    std::vector<std::unique_ptr<IntensityFiles>> files;
    for (const double intensity : intensities) {
        const std::string name = intensity_label(intensity) + ".png";
        files.push_back(std::unique_ptr<IntensityFiles>(
            new IntensityFiles{{folder + "/rainy_" + name, width, height, 3, 8, settings.text},
                               {folder + "/rain_layer_" + name, width, height, 3, 8, settings.text},
                               {folder + "/rain_mask_" + name, width, height, 1, 8, settings.text}}));
    }

    DisplayReport report;
    std::vector<int64_t> masked(intensities.size(), 0);
    for (int y = 0; y < height; y += band_rows) {
        const Rows rows = read(exr, y, intensities);
        const std::vector<Rgb> background = displayed(rows, rows.background, view, scale);
        // One task per intensity; files are independent of each other.
        parallel_for(int(intensities.size()) + 1, [&](int task) {
            if (task == 0) {
                background_file.write_rows(y, rows.band_count, bytes(background).data());
                depth_file.write(rows, report);
                return;
            }
            const IntensityPlanes& rain = rows.rain[task - 1];
            IntensityFiles& file = *files[task - 1];
            file.rainy.write_rows(y, rows.band_count, bytes(displayed(rows, rain.rainy, view, scale)).data());
            file.layer.write_rows(y, rows.band_count, bytes(displayed(rows, rain.rain, view, scale)).data());
            const auto mask = rain_mask(rows, rain, view, scale, settings.paper);
            file.mask.write_rows(y, rows.band_count, mask.data());
            masked[task - 1] += std::count(mask.begin(), mask.end(), 255);
        });
    }
    background_file.finish();
    depth_file.finish();
    for (auto& file : files) file->rainy.finish(), file->layer.finish(), file->mask.finish();
    for (const int64_t count : masked) report.mask_shares.push_back(double(count) / (double(width) * height));
    return report;
}

}  // namespace pluvia
