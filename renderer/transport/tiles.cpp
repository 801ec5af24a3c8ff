#include "renderer/transport/tiles.h"

#include "renderer/core/parallel.h"
#include "renderer/transport/band_queue.h"

#include <algorithm>
#include <mutex>

namespace pluvia {
namespace {

/// The part of a band from x_begin to x_end. film: of samples that are taken already; null: they are taken here.
void render_tile(const Frame& frame, Film* film, int x_begin, int x_end, Band& band, Counters& counters,
                 PixelProgress* progress) {
    PixelScratch scratch;
    scratch.rain.resize(frame.intensity_count());
    scratch.values.resize(band.planes.size());
    scratch.ids.resize(band.ids.size());
    for (int y = band.y; y < band.y + band.rows; ++y)
        for (int x = x_begin; x < x_end; ++x) {
            begin_pixel(frame, x, y, scratch);
            if (film)
                film->exchange(x, y, scratch);
            else
                add_samples(frame, x, y, 0, frame.settings.samples, scratch, counters);
            find_centre(frame, x, y, scratch, counters);
            develop(scratch.film.sums, scratch.depth, frame.settings.samples, scratch.values.data());
            const size_t pixel = size_t(y - band.y) * band.width + x;
            if (frame.mattes) write_mattes(frame, scratch);
            if (film) film->exchange(x, y, scratch);
            for (size_t c = 0; c < band.planes.size(); ++c) band.planes[c][pixel] = scratch.values[c];
            for (size_t c = 0; c < band.ids.size(); ++c) band.ids[c][pixel] = scratch.ids[c];
            if (progress) progress->add_pixel();
        }
}

/// Samples begin <= i < end of every pixel of a tile.
void add_to_tile(const Frame& frame, Film& film, int column, int row, int begin, int end, PixelProgress& progress,
                 Counters& counters) {
    PixelScratch scratch;
    scratch.rain.resize(frame.intensity_count());
    const int size = frame.settings.tile_size;
    for (int y = row * size; y < std::min((row + 1) * size, frame.view.height); ++y)
        for (int x = column * size; x < std::min((column + 1) * size, frame.view.width); ++x) {
            begin_pixel(frame, x, y, scratch);
            film.exchange(x, y, scratch);
            add_samples(frame, x, y, begin, end, scratch, counters);
            film.exchange(x, y, scratch);
            progress.add_pixel();
        }
}

}  // namespace

std::vector<float> render_pixels(const Frame& frame, std::span<const int64_t> pixels) {
    const size_t channels = layer_channels(frame.settings.rain.intensities_mm_per_h).size();
    std::vector<float> values(pixels.size() * channels);
    constexpr int block = 16;
    parallel_for(int((pixels.size() + block - 1) / block), [&](int b) {
        PixelScratch scratch;
        Counters counters;
        scratch.rain.resize(frame.intensity_count());
        scratch.depth = {0, 0, std::vector<float>(frame.intensity_count(), 0.0f)};
        for (size_t i = size_t(b) * block; i < std::min(pixels.size(), size_t(b + 1) * block); ++i) {
            const int x = int(pixels[i] % frame.view.width), y = int(pixels[i] / frame.view.width);
            begin_pixel(frame, x, y, scratch);
            add_samples(frame, x, y, 0, frame.settings.samples, scratch, counters);
            develop(scratch.film.sums, scratch.depth, frame.settings.samples, &values[i * channels]);
        }
    });
    return values;
}

void add_pass(const Frame& frame, Film& film, int begin, int end, const ProgressCallback& progress,
              Counters& counters) {
    const int size = frame.settings.tile_size;
    const int columns = (frame.view.width + size - 1) / size, rows = (frame.view.height + size - 1) / size;
    PixelProgress pixel_progress(frame.view, progress);
    std::mutex mutex;
    parallel_in_order(rows * columns, [&](int tile) {
        Counters of_tile;
        add_to_tile(frame, film, tile % columns, tile / columns, begin, end, pixel_progress, of_tile);
        const std::lock_guard lock(mutex);
        counters += of_tile;
    });
}

Band finished_rows(const Frame& frame, Film& film, const FrameChannels& channels, int y, int rows) {
    Band band(y, rows, frame.view.width, channels.values.size(), channels.ids.size());
    const int size = frame.settings.tile_size;
    parallel_for((band.width + size - 1) / size, [&](int column) {
        Counters uncounted;
        render_tile(frame, &film, column * size, std::min((column + 1) * size, band.width), band, uncounted, nullptr);
    });
    return band;
}

void render_bands(const Frame& frame, Film* film, const FrameChannels& channels, const BandSink& sink,
                  const ProgressCallback& progress, Counters& counters) {
    const View& view = frame.view;
    const int size = frame.settings.tile_size;
    BandQueue queue(view, size, channels, sink);
    const int rows = (view.height + size - 1) / size;
    PixelProgress pixel_progress(view, progress);
    std::mutex mutex;
    parallel_in_order(rows * queue.columns(), [&](int tile) {
        try {
            const int row = tile / queue.columns(), x = tile % queue.columns() * size;
            Counters of_tile;
            render_tile(frame, film, x, std::min(x + size, view.width), queue.band(row), of_tile, &pixel_progress);
            queue.complete_tile(row);
            const std::lock_guard lock(mutex);
            counters += of_tile;
        } catch (...) {
            queue.stop();
            throw;
        }
    });
}

}  // namespace pluvia
