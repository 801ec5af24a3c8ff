#include "tools/augment/augment_files.h"

#include "renderer/core/parallel.h"
#include "renderer/image/color.h"
#include "renderer/image/exposure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>

namespace pluvia {
namespace {

/// One picture that is written band by band; tasks of a band run side by side.
struct OpenFile {
    std::unique_ptr<PngWriter> writer;
    std::function<void(PngWriter&, const FrameRows&)> write;
};

std::vector<uint16_t> display_words(const std::vector<Rgb>& pixels) {
    std::vector<uint16_t> words;
    words.reserve(3 * pixels.size());
    for (const Rgb p : pixels)
        for (const float c : {p.r, p.g, p.b}) words.push_back(word_from_display(c));
    return words;
}

/// One value for the three: a picture passes its colours alike, since it is the same in all samples of a pixel.
std::vector<uint16_t> transmittance_words(const FrameRows& rows, const IntensityPlanes& rain) {
    std::vector<uint16_t> words(rows.band_pixels());
    const size_t first = rows.first_pixel();
    for (size_t i = 0; i < words.size(); ++i) {
        const size_t k = first + i;
        words[i] =
            word_from_display((rain.transmittance[0][k] + rain.transmittance[1][k] + rain.transmittance[2][k]) / 3);
    }
    return words;
}

bool shows_input(const std::string& channel) {
    for (const char* layer : {"background.", "Z", "distance.", "rainy_"})
        if (channel.starts_with(layer)) return true;
    return false;
}

void write_layers(const std::string& path, const LayerPlanes& layers, const FrameHeader& header, double ev100,
                  bool all) {
    std::vector<ExrChannel> channels;
    for (const std::string& name : layer_channels(header.intensities))
        if (all || !shows_input(name)) channels.push_back({name, false});
    ExrWriter exr(path, layers.width(), layers.height(), channels, exr_attributes(header));
    std::vector<ExrRows> rows;
    for (const ExrChannel& channel : channels) rows.push_back(layers.plane(channel.name).data());
    exr.write_rows(0, layers.height(), rows);
    exr.set_attribute("pluvia:exposure_ev100", float(ev100));
    exr.finish();
}

}  // namespace

LayerPlanes::LayerPlanes(int width, int height, const std::vector<double>& intensities)
    : width_(width), height_(height), channels_(layer_channels(intensities)) {
    std::vector<std::vector<float>*> planes;
    for (const std::string& channel : channels_) planes.push_back(&planes_[channel]);
    parallel_for(int(planes.size()), [&](int i) { planes[size_t(i)]->resize(size_t(width) * size_t(height)); });
}

void LayerPlanes::add(const Band& band) {
    for (size_t c = 0; c < channels_.size(); ++c)
        std::ranges::copy(band.planes[c], planes_.at(channels_[c]).begin() + long(band.y) * width_);
}

void LayerPlanes::read(int y, int count, std::span<const ExrRequest> requests) const {
    for (const ExrRequest& request : requests)
        std::memcpy(std::get<float*>(request.rows), planes_.at(request.channel).data() + size_t(y) * size_t(width_),
                    size_t(count) * size_t(width_) * sizeof(float));
}

AugmentedFiles write_augmented_files(const std::string& folder, const std::string& name, const LayerPlanes& layers,
                                     const FrameHeader& header, double ev100, const AugmentedFormat& format) {
    const int width = layers.width(), height = layers.height();
    const DisplayView view(format.view);
    const float scale = exposure_scale(ev100);
    AugmentedFiles result;
    std::vector<OpenFile> open;
    const size_t count = header.intensities.size();
    std::vector<int64_t> masked(count, 0);
    const auto add_file = [&](const std::string& kind, size_t i, int channels, int bits, auto write) {
        const std::string label = intensity_label(header.intensities[i]);
        const std::string temporary = fmt::format("{}/{}_{}.png", folder, kind, label);
        result.files.emplace_back(temporary, fmt::format("{}_{}/{}.png", kind, label, name));
        open.push_back({std::make_unique<PngWriter>(temporary, width, height, channels, bits, format.text), write});
    };
    for (size_t i = 0; i < count; ++i) {
        if (format.pictures)
            add_file("rainy", i, 3, 8, [&, i](PngWriter& file, const FrameRows& rows) {
                file.write_rows(rows.band_begin, rows.band_count,
                                display_bytes(displayed(rows, rows.rain[i].rainy, view, scale)).data());
            });
        add_file("rain_layer", i, 3, 8, [&, i](PngWriter& file, const FrameRows& rows) {
            file.write_rows(rows.band_begin, rows.band_count,
                            display_bytes(displayed(rows, rows.rain[i].rain, view, scale)).data());
        });
        add_file("rain_mask", i, 1, 8, [&, i](PngWriter& file, const FrameRows& rows) {
            const std::vector<uint8_t> mask = rain_mask(rows, rows.rain[i], view, scale, format.paper);
            masked[i] += std::ranges::count(mask, 255);
            file.write_rows(rows.band_begin, rows.band_count, mask.data());
        });
        add_file("transmittance", i, 1, 16, [i](PngWriter& file, const FrameRows& rows) {
            file.write_rows(rows.band_begin, rows.band_count, transmittance_words(rows, rows.rain[i]).data());
        });
        add_file("inscatter", i, 3, 16, [&, i](PngWriter& file, const FrameRows& rows) {
            file.write_rows(rows.band_begin, rows.band_count,
                            display_words(displayed(rows, rows.rain[i].inscatter, view, scale)).data());
        });
    }
    const RowReader read = [&](int y, int n, std::span<const ExrRequest> requests) { layers.read(y, n, requests); };
    for (int y = 0; y < height; y += display_band_rows) {
        const FrameRows rows = read_frame_rows(width, height, read, y, header.intensities);
        parallel_for(int(open.size()), [&](int i) { open[size_t(i)].write(*open[size_t(i)].writer, rows); });
    }
    for (OpenFile& file : open) file.writer->finish();
    for (size_t i = 0; i < count; ++i) {
        const std::vector<float>& coverage = layers.plane("rain_" + intensity_label(header.intensities[i]) + ".A");
        double sum = 0;
        for (const float a : coverage) sum += a;
        result.coverages.push_back(sum / double(coverage.size()));
        result.mask_shares.push_back(double(masked[i]) / double(coverage.size()));
    }
    if (format.exr) {
        const std::string temporary = folder + "/layers.exr";
        write_layers(temporary, layers, header, ev100, format.all_layers);
        result.files.emplace_back(temporary, fmt::format("layers/{}.exr", name));
    }
    return result;
}

}  // namespace pluvia
