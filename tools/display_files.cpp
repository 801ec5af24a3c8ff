#include "tools/display_files.h"

#include "renderer/core/parallel.h"
#include "renderer/image/exposure.h"
#include "renderer/image/exr.h"
#include "renderer/transport/layers.h"
#include "tools/display_rows.h"

#include <algorithm>
#include <memory>

namespace pluvia {
namespace {

class DepthFile {
public:
    DepthFile(const std::string& path, int width, int height, const DisplaySettings& settings)
        : settings_(settings),
          rgb_(settings.depth_encoding == DepthEncoding::carla24),
          writer_(path, width, height, rgb_ ? 3 : 1, rgb_ ? 8 : 16, settings.text) {}

    void write(const FrameRows& rows, DisplayReport& report) {
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
    for (int y = 0; y < height; y += display_band_rows) {
        const FrameRows rows = read_frame_rows(exr, y, intensities);
        const std::vector<Rgb> background = displayed(rows, rows.background, view, scale);
        // One task per intensity; files are independent of each other.
        parallel_for(int(intensities.size()) + 1, [&](int task) {
            if (task == 0) {
                background_file.write_rows(y, rows.band_count, display_bytes(background).data());
                depth_file.write(rows, report);
                return;
            }
            const IntensityPlanes& rain = rows.rain[task - 1];
            IntensityFiles& file = *files[task - 1];
            file.rainy.write_rows(y, rows.band_count, display_bytes(displayed(rows, rain.rainy, view, scale)).data());
            file.layer.write_rows(y, rows.band_count, display_bytes(displayed(rows, rain.rain, view, scale)).data());
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
