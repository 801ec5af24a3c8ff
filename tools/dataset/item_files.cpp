#include "tools/dataset/item_files.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/image/color.h"
#include "renderer/image/exposure.h"
#include "renderer/image/pending_file.h"
#include "tools/display_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;
using Histogram = std::array<int64_t, record_bins>;

/// Colour as stored, alpha as a fourth channel where it is given.
template <class Word, class Encode>
std::vector<Word> words(const std::vector<Rgb>& pixels, const float* alpha, Encode&& encode) {
    std::vector<Word> values;
    values.reserve(pixels.size() * (alpha ? 4 : 3));
    for (size_t i = 0; i < pixels.size(); ++i) {
        for (const float c : {pixels[i].r, pixels[i].g, pixels[i].b}) values.push_back(encode(c));
        if (alpha) values.push_back(encode(alpha[i]));
    }
    return values;
}

/// A displayed picture of 8 or 16 bits.
class ColorFile {
public:
    ColorFile(const std::string& path, int width, int height, int channels, int bits, const PngText& text)
        : writer_(path, width, height, channels, bits, text), bits_(bits) {}

    void write(const FrameRows& rows, const std::vector<Rgb>& pixels, const float* alpha = nullptr) {
        if (bits_ == 16)
            writer_.write_rows(rows.band_begin, rows.band_count,
                               words<uint16_t>(pixels, alpha, word_from_display).data());
        else
            writer_.write_rows(rows.band_begin, rows.band_count,
                               words<uint8_t>(pixels, alpha, byte_from_display).data());
    }
    void finish() { writer_.finish(); }

private:
    PngWriter writer_;
    int bits_;
};

std::vector<uint16_t> depth_words(const float* z, size_t count, float depth_max) {
    std::vector<uint16_t> values(count);
    for (size_t i = 0; i < count; ++i) values[i] = encode_hri(z[i], depth_max);
    return values;
}

/// Files and numbers of one intensity.
struct RainyFiles {
    ColorFile rainy, layer;
    PngWriter mask, depth;
    std::unique_ptr<ColorFile> transmittance, inscatter;
    Histogram brightness = {};
    double coverage = 0;  // sum over pixels
    int64_t masked = 0;
};

struct Shared {
    const DatasetItem& item;
    const PictureFormat& format;
    const DisplaySettings& display;
    const DisplayView& view;
    float scale;
};

void write_rainy(RainyFiles& files, const FrameRows& rows, const IntensityPlanes& rain, const Shared& shared) {
    const size_t first = rows.first_pixel(), count = rows.band_pixels();
    const std::vector<Rgb> rainy = displayed(rows, rain.rainy, shared.view, shared.scale);
    files.rainy.write(rows, rainy);
    const float* const coverage = rain.coverage.data() + first;
    files.layer.write(rows, displayed(rows, rain.rain, shared.view, shared.scale), coverage);
    files.depth.write_rows(rows.band_begin, rows.band_count,
                           depth_words(rain.rainy_z.data() + first, count, shared.display.depth_max).data());
    std::vector<uint8_t> mask;
    if (shared.display.paper) {
        // From alpha as it is stored: who reads the file draws the same line.
        mask.resize(count);
        for (size_t i = 0; i < count; ++i) {
            const float alpha = shared.format.bits == 16 ? float(word_from_display(coverage[i])) / 65535
                                                         : float(byte_from_display(coverage[i])) / 255;
            mask[i] = alpha >= paper_mask_alpha ? 255 : 0;
        }
    } else {
        mask = rain_mask(rows, rain, shared.view, shared.scale, false);
    }
    files.mask.write_rows(rows.band_begin, rows.band_count, mask.data());
    files.masked += std::count(mask.begin(), mask.end(), 255);
    for (size_t i = 0; i < count; ++i) {
        files.coverage += coverage[i];
        ++files.brightness[size_t(brightness_bin(rainy[i]))];
    }
    if (!files.inscatter) return;
    files.inscatter->write(rows, displayed(rows, rain.inscatter, shared.view, shared.scale));
    std::vector<Rgb> transmittance(count);
    for (size_t i = 0; i < count; ++i)
        transmittance[i] = {rain.transmittance[0][first + i], rain.transmittance[1][first + i],
                            rain.transmittance[2][first + i]};
    files.transmittance->write(rows, transmittance);
}

/// Names files in the order in which they are asked for.
class FileList {
public:
    explicit FileList(std::string folder) : folder_(std::move(folder)) {}

    /// A temporary path for what will be the file at path; notes it in a record's object under key.
    std::string add(Json& json, const std::string& key, const std::string& path) {
        json[key] = path;
        const std::string extension = path.substr(path.rfind('.'));
        files.push_back({fmt::format("{}/{}{}", folder_, files.size(), extension), path});
        return files.back().temporary;
    }
    std::vector<StoredFile> files;

private:
    std::string folder_;
};

}  // namespace

bool has_veil(const RenderOptions& options) {
    return options.composition != "paper" || options.fog_beta > 0;
}

int depth_bin(float metres) {
    if (!std::isfinite(metres) || metres <= 0) return -1;
    return std::clamp(int(std::floor(3 * std::log2(metres / 0.5f))), 0, record_bins - 1);
}

int brightness_bin(Rgb color) {
    return std::clamp(int(luminance(color) * record_bins), 0, record_bins - 1);
}

ItemFiles write_item_files(const std::string& folder, const std::string& exr_path, const DatasetItem& item,
                           const PictureFormat& format, const RenderedFrame& frame, const DisplaySettings& display) {
    ExrReader exr(exr_path);
    const int width = exr.width(), height = exr.height();
    const DisplayView view(display.view);
    const Shared shared{item, format, display, view, exposure_scale(frame.ev100)};
    const std::vector<double>& intensities = frame.header.intensities;

    ItemFiles result;
    FileList list(folder);
    const bool is_jpeg = format.bits == 8;
    const std::string background_path =
        list.add(result.frame, "background", item.clean_path("background", is_jpeg ? "jpg" : "png"));
    Image<Rgba8> background_pixels(is_jpeg ? width : 0, is_jpeg ? height : 0);
    std::unique_ptr<ColorFile> background_file;
    if (!is_jpeg) background_file = std::make_unique<ColorFile>(background_path, width, height, 3, 16, display.text);
    PngWriter depth(list.add(result.frame, "depth", item.clean_path("depth", "png")), width, height, 1, 16,
                    display.text);
    ExrWriter metric(list.add(result.frame, "metric_depth", item.clean_path("metric_depth", "exr")), width, height,
                     {{"Z", false}}, exr_attributes(frame.header));
    std::vector<std::unique_ptr<RainyFiles>> rainy;
    for (const double intensity : intensities) {
        Json pair;
        pair["intensity"] = intensity;
        const auto path = [&](const char* key, const char* kind) {
            return list.add(pair, key, item.rainy_path(intensity, kind, "png"));
        };
        const auto color = [&](const char* kind, int channels, int bits) {
            return ColorFile(path(kind, kind), width, height, channels, bits, display.text);
        };
        rainy.push_back(std::unique_ptr<RainyFiles>(
            new RainyFiles{color("rainy_image", 3, format.bits),
                           color("rain_layer", 4, format.bits),
                           {path("rain_mask", "rain_mask"), width, height, 1, 8, display.text},
                           {path("rainy_depth", "depth"), width, height, 1, 16, display.text},
                           nullptr,
                           nullptr}));
        if (has_veil(item.options)) {
            rainy.back()->transmittance =
                std::make_unique<ColorFile>(path("transmittance", "transmittance"), width, height, 3, 16, display.text);
            rainy.back()->inscatter =
                std::make_unique<ColorFile>(path("inscatter", "inscatter"), width, height, 3, 16, display.text);
        }
        result.pairs.push_back(std::move(pair));
    }

    Histogram depths = {}, brightness = {};
    int64_t sky = 0, beyond = 0;
    for (int y = 0; y < height; y += display_band_rows) {
        const FrameRows rows = read_frame_rows(exr, y, intensities);
        parallel_for(int(intensities.size()) + 1, [&](int task) {
            if (task > 0) return write_rainy(*rainy[size_t(task) - 1], rows, rows.rain[size_t(task) - 1], shared);
            const size_t count = rows.band_pixels();
            const std::vector<Rgb> pixels = displayed(rows, rows.background, view, shared.scale);
            for (size_t i = 0; i < count; ++i) ++brightness[size_t(brightness_bin(pixels[i]))];
            if (background_file) background_file->write(rows, pixels);
            for (size_t i = 0; is_jpeg && i < count; ++i)
                background_pixels.pixels[size_t(y) * size_t(width) + i] = {
                    byte_from_display(pixels[i].r), byte_from_display(pixels[i].g), byte_from_display(pixels[i].b)};
            const float* const z = rows.z.data() + rows.first_pixel();
            for (size_t i = 0; i < count; ++i) {
                const int bin = depth_bin(z[i]);
                bin < 0 ? ++sky : ++depths[size_t(bin)];
            }
            beyond += count_beyond({z, count}, display.depth_max);
            depth.write_rows(y, rows.band_count, depth_words(z, count, display.depth_max).data());
            const ExrRows metres = z;
            metric.write_rows(y, rows.band_count, std::span(&metres, 1));
        });
    }
    if (background_file) background_file->finish();
    if (is_jpeg) {
        const std::vector<std::byte> bytes = encode_jpeg(background_pixels, format.jpeg_quality);
        PendingFile file(background_path);
        file.stream().write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        file.commit();
    }
    depth.finish(), metric.finish();
    const double pixels = double(width) * height;
    for (size_t i = 0; i < rainy.size(); ++i) {
        RainyFiles& files = *rainy[i];
        files.rainy.finish(), files.layer.finish(), files.mask.finish(), files.depth.finish();
        if (files.inscatter) files.inscatter->finish(), files.transmittance->finish();
        result.pairs[i]["coverage"] = files.coverage / pixels;
        result.pairs[i]["mask_share"] = double(files.masked) / pixels;
        result.pairs[i]["brightness_histogram"] = files.brightness;
    }
    result.frame["depths_beyond"] = beyond;
    result.frame["sky_share"] = double(sky) / pixels;
    result.frame["depth_histogram"] = depths;
    result.frame["brightness_histogram"] = brightness;
    if (format.exr) {
        list.add(result.frame, "exr", item.exr_path());
        list.files.back().temporary = exr_path;
    }
    result.files = std::move(list.files);
    return result;
}

}  // namespace pluvia
