#include "renderer/transport/render.h"

#include "renderer/transport/passes.h"
#include "renderer/transport/picture_drop_light.h"
#include "renderer/transport/scene_drop_light.h"
#include "renderer/transport/shelter.h"
#include "renderer/transport/sky_sights.h"
#include "renderer/transport/tiles.h"

#include <algorithm>
#include <chrono>
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

/// next_pass: null where all samples are taken at once.
RenderReport render_frame(const Scene& scene, const Environment& environment, const View& view,
                          const RenderSettings& given, const NextPass* next_pass, const BandSink& sink,
                          const ProgressCallback& progress, const PictureSource* picture) {
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
    const WetGround* const wet = wet_ground ? &*wet_ground : nullptr;
    std::optional<SkyGuide> sky_guide;
    if (!picture && is_worth_guiding(lights))
        sky_guide.emplace(environment,
                          find_sky_sights(ray_scene, environment, view, wet, settings.seed, report.counters));
    const PathTracer tracer(scene, ray_scene, lights, settings.path, wet, sky_guide ? &*sky_guide : nullptr);

    std::optional<StreakBins> bins;
    std::optional<RainMedium> medium;
    std::optional<DropLight> drop_light;
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
        // Fog has a phase function of its own.
        const bool tabled = settings.streaks.tabled_veil && (!picture || settings.streaks.far_light);
        if (tabled && !(rain.fog_extinction > 0)) {
            drop_light = picture ? picture_drop_light(tracer, *settings.streaks.far_light, *picture, view,
                                                      settings.seed, float(rain.near), report.counters)
                                 : scene_drop_light(tracer, view, frame.far_scene, frame.shadow, settings.seed,
                                                    float(rain.near), report.counters);
            frame.rain->set_drop_light(*drop_light);
        }
    }
    const LabelLayers& layers = settings.labels.layers;
    std::optional<LabelTracer> labels;
    std::optional<FrameMattes> mattes;
    if (layers.any_of_ray()) frame.labels = &labels.emplace(scene, ray_scene, view, settings.labels);
    if (layers.cryptomatte) frame.mattes = &mattes.emplace(scene, *settings.labels.objects);
    frame.first_label = layer_channels(settings.rain.intensities_mm_per_h).size();
    frame.first_matte = frame.first_label + label_channels(layers).size();
    if (settings.choose_samples && !next_pass)
        settings.samples = settings.choose_samples([&](std::span<const int64_t> pixels, int samples, uint64_t seed) {
            settings.samples = samples, settings.seed = seed;
            std::vector<float> values = render_pixels(frame, pixels);
            settings.seed = given.seed;
            return values;
        });
    report.build_seconds = seconds_since(start);

    const FrameChannels channels = frame_channels(settings.rain.intensities_mm_per_h, layers);
    std::optional<Film> film;
    if (next_pass) {
        film.emplace(view, settings.tile_size, frame.intensity_count());
        settings.samples = 0;
        const BandPreview preview = [&](int y, int rows) { return finished_rows(frame, *film, channels, y, rows); };
        while (const int more = (*next_pass)(settings.samples, preview)) {
            add_pass(frame, *film, settings.samples, settings.samples + more, progress, report.counters);
            settings.samples += more;
        }
    }
    report.samples = settings.samples;
    render_bands(frame, film ? &*film : nullptr, channels, sink, progress, report.counters);
    progress(1);
    report.render_seconds = seconds_since(start) - report.build_seconds;
    return report;
}

}  // namespace

RenderReport render(const Scene& scene, const Environment& environment, const View& view,
                    const RenderSettings& settings, const BandSink& sink, const ProgressCallback& progress,
                    const PictureSource* picture) {
    return render_frame(scene, environment, view, settings, nullptr, sink, progress, picture);
}

RenderReport render_in_passes(const Scene& scene, const Environment& environment, const View& view,
                              const RenderSettings& settings, const NextPass& next_pass, const BandSink& sink,
                              const ProgressCallback& progress) {
    return render_frame(scene, environment, view, settings, &next_pass, sink, progress, nullptr);
}

}  // namespace pluvia
