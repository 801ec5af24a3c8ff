#include "renderer/transport/render.h"

#include "renderer/core/parallel.h"
#include "renderer/transport/band_queue.h"
#include "renderer/transport/pixel.h"
#include "renderer/transport/shelter.h"

#include <chrono>
#include <mutex>
#include <optional>

namespace pluvia {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A quarter of the picture's mean: light that is computed for the samples that it is worth leaves noise below a level
/// of 8 bits there.
float dark_luminance(const PictureSource& picture) {
    double sum = 0;
    for (const Rgb c : picture.radiance.pixels) sum += luminance(c);
    return float(sum / double(picture.radiance.pixels.size()) / 4);
}

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
            add_samples(frame, int(pixels[i] % frame.view.width), int(pixels[i] / frame.view.width), scratch, counters);
            develop(scratch.sums, scratch.depth, frame.settings.samples, &values[i * channels]);
        }
    });
    return values;
}

void render_tile(const Frame& frame, int x_begin, int x_end, Band& band, PixelProgress& progress, Counters& counters) {
    PixelScratch scratch;
    scratch.rain.resize(frame.intensity_count());
    scratch.values.resize(band.planes.size());
    scratch.ids.resize(band.ids.size());
    for (int y = band.y; y < band.y + band.rows; ++y)
        for (int x = x_begin; x < x_end; ++x) {
            add_samples(frame, x, y, scratch, counters);
            find_centre(frame, x, y, scratch, counters);
            develop(scratch.sums, scratch.depth, frame.settings.samples, scratch.values.data());
            const size_t pixel = size_t(y - band.y) * band.width + x;
            if (frame.mattes) write_mattes(frame, scratch);
            for (size_t c = 0; c < band.planes.size(); ++c) band.planes[c][pixel] = scratch.values[c];
            for (size_t c = 0; c < band.ids.size(); ++c) band.ids[c][pixel] = scratch.ids[c];
            progress.add_pixel();
        }
}

}  // namespace

RenderReport render(const Scene& scene, const Environment& environment, const View& view, const RenderSettings& given,
                    const BandSink& sink, const ProgressCallback& progress, const PictureSource* picture) {
    RenderReport report;
    RenderSettings settings = given;  // but for the number of samples
    const auto start = Clock::now();
    const RayScene ray_scene(scene);
    const Lights lights(scene, environment);
    std::optional<RainShadow> shadow;
    const bool fine_rain =
        !settings.rain.intensities_mm_per_h.empty() && settings.streaks.composition == Composition::physical;
    if (!picture && (fine_rain || settings.wet.any())) shadow.emplace(scene, ray_scene, settings.rain.wind);
    std::optional<RainShadow> wet_shadow;
    if (settings.wet.any() && settings.wet_wind) wet_shadow.emplace(scene, ray_scene, *settings.wet_wind);
    std::optional<WetGround> wet_ground;
    const double time = view.shutter_open + view.exposure_time / 2;
    if (settings.wet.any())
        wet_ground.emplace(scene, wet_shadow ? *wet_shadow : *shadow, settings.wet, time, settings.rain.seed);
    const PathTracer tracer(scene, ray_scene, lights, settings.path, wet_ground ? &*wet_ground : nullptr);

    std::optional<StreakBins> bins;
    std::optional<RainMedium> medium;
    Frame frame{view, settings, tracer, picture, picture ? dark_luminance(*picture) : 0};
    if (!picture) frame.far_scene = far_bounds(scene, view);
    if (!settings.rain.intensities_mm_per_h.empty()) {
        RainSettings rain = settings.rain;
        const Bounds box = bounds(scene);
        rain.lowest_ground = box.empty() ? view.position.y - 100 : box.lower.y;
        // A picture may show no ground; there is none at the height of its camera.
        if (picture) rain.lowest_ground = std::min(rain.lowest_ground, view.position.y - 2);
        std::vector<Streak> streaks = find_streaks(view, rain);
        report.sheltered_streaks = streaks.size();
        if (!picture) remove_sheltered(streaks, view, ray_scene, report.counters);
        report.sheltered_streaks -= streaks.size();
        report.streaks = streaks.size();
        bins.emplace(std::move(streaks), view);
        frame.bins = &*bins;
        // The paper's pictures have streaks in clear air.
        if (fine_rain || rain.fog_extinction > 0) medium.emplace(view, rain, fine_rain);
        frame.has_medium = medium.has_value();
        if (shadow && fine_rain) frame.shadow = &*shadow;
        frame.rain.emplace(tracer, *bins, medium ? &*medium : nullptr, rain.intensities_mm_per_h, settings.streaks);
    }
    const LabelLayers& layers = settings.labels.layers;
    std::optional<LabelTracer> labels;
    std::optional<FrameMattes> mattes;
    if (layers.any_of_ray()) frame.labels = &labels.emplace(scene, ray_scene, view, settings.labels);
    if (layers.cryptomatte) frame.mattes = &mattes.emplace(scene, *settings.labels.objects);
    frame.first_label = layer_channels(settings.rain.intensities_mm_per_h).size();
    frame.first_matte = frame.first_label + label_channels(layers).size();
    if (settings.choose_samples)
        settings.samples = settings.choose_samples([&](std::span<const int64_t> pixels, int samples, uint64_t seed) {
            settings.samples = samples, settings.seed = seed;
            std::vector<float> values = render_pixels(frame, pixels);
            settings.seed = given.seed;
            return values;
        });
    report.samples = settings.samples;
    report.build_seconds = seconds_since(start);

    const FrameChannels channels = frame_channels(settings.rain.intensities_mm_per_h, layers);
    BandQueue queue(view, settings.tile_size, channels, sink);
    const int rows = (view.height + settings.tile_size - 1) / settings.tile_size;
    const int tiles = rows * queue.columns();
    PixelProgress pixel_progress(view, progress);
    std::mutex report_mutex;
    parallel_in_order(tiles, [&](int tile) {
        try {
            const int row = tile / queue.columns(), x = tile % queue.columns() * settings.tile_size;
            Counters counters;
            render_tile(frame, x, std::min(x + settings.tile_size, view.width), queue.band(row), pixel_progress,
                        counters);
            queue.complete_tile(row);
            const std::lock_guard lock(report_mutex);
            report.counters += counters;
        } catch (...) {
            queue.stop();
            throw;
        }
    });
    progress(1);
    report.render_seconds = seconds_since(start) - report.build_seconds;
    return report;
}

}  // namespace pluvia
