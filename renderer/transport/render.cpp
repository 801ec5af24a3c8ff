#include "renderer/transport/render.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/core/sampling.h"
#include "renderer/transport/cryptomatte.h"
#include "renderer/transport/dry_parts.h"
#include "renderer/transport/frame_channels.h"
#include "renderer/transport/shelter.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>

namespace pluvia {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Ids of mattes by index of object and material.
struct Mattes {
    const Scene& scene;
    const SceneObjects& objects;
    std::vector<float> object_ids, material_ids;
    float rain_id = cryptomatte_id("rain");

    Mattes(const Scene& scene_, const SceneObjects& objects_) : scene(scene_), objects(objects_) {
        for (const LabelObject& object : objects.objects) object_ids.push_back(cryptomatte_id(object.name));
        for (const Material& material : scene.materials) material_ids.push_back(cryptomatte_id(material.name));
    }
};

/// All that the tiles of a frame share.
struct Frame {
    const View& view;
    const RenderSettings& settings;
    const PathTracer& tracer;
    const StreakBins* bins = nullptr;  // null where there is no rain
    std::optional<RainStage> rain;
    const RainShadow* shadow = nullptr;  // of the medium of fine rain; null where there is none
    const LabelTracer* labels = nullptr;
    const Mattes* mattes = nullptr;

    size_t first_label = 0, first_matte = 0;  // places among a pixel's values

    size_t intensity_count() const { return settings.rain.intensities_mm_per_h.size(); }
};

/// One camera ray in view coordinates: through a point of the lens and the point in focus behind a pixel position.
Ray view_ray(const View& view, Vec2 pixel, Vec2 lens) {
    const Vec3 through_centre = view.view_direction(pixel);
    if (view.lens_radius == 0) return {Vec3(), normalize(through_centre)};
    const Vec2 d = sample_disk(lens);
    const Vec3 origin(float(view.lens_radius) * d.x, float(view.lens_radius) * d.y, 0);
    // Both ends of the ray scaled by 1 / focus distance, so that focus at infinity is an ordinary case.
    return {origin, normalize(through_centre - origin / float(view.focus_distance))};
}

Ray scene_ray(const View& view, const Ray& ray) {
    return {Vec3(view.position + view.world_vector_from_view(Vec3d(ray.origin))),
            Vec3(view.world_vector_from_view(Vec3d(ray.direction)))};
}

void add(std::array<double, 3>& sum, Rgb value) {
    sum[0] += value.r, sum[1] += value.g, sum[2] += value.b;
}

/// Buffers that live as long as a tile, so that no pixel allocates.
struct Scratch {
    PixelSums sums;
    CentreDepth depth;
    std::vector<RainSample> rain;
    RainScratch streaks;
    DryPartsOfTile dry;
    std::vector<uint32_t> candidates;  // streaks near the pixel
    std::vector<float> values;
    std::vector<uint32_t> ids;
    MatteCounts objects, materials;
};

void add_sample(const Frame& frame, int x, int y, int index, Scratch& scratch, Counters& counters) {
    const Sampler sampler(frame.settings.seed, uint32_t(x), uint32_t(y), uint32_t(index));
    const Vec2 u = sampler.get_2d(Draw::pixel);
    const Vec2 pixel{float(x) + u.x, float(y) + u.y};
    if (frame.view.lens_radius > 0) counters.count(Feature::lens);
    Ray seen = view_ray(frame.view, pixel, frame.view.lens_radius > 0 ? sampler.get_2d(Draw::lens) : Vec2());
    const Ray ray = scene_ray(frame.view, seen);
    counters.count(Feature::camera_path);
    const PathResult path = frame.tracer.trace(ray, {}, sampler, 0, counters);
    if (!is_finite(path.radiance)) {
        ++counters.invalid_samples;
        return;
    }
    if (frame.mattes && path.first.instance >= 0) {
        const Instance& instance = frame.mattes->scene.instances[path.first.instance];
        counters.count(Feature::matte);
        scratch.objects.add(frame.mattes->objects.object_of_instance[path.first.instance]);
        scratch.materials.add(frame.mattes->scene.meshes[instance.mesh].material);
    }
    PixelSums& sums = scratch.sums;
    add(sums.background, path.radiance);
    if (!frame.rain) return;

    seen.t_max = path.distance;
    const Rgb mean(float(sums.background[0]), float(sums.background[1]), float(sums.background[2]));
    CameraSegment segment{pixel, scratch.candidates, ray, seen, path.radiance, luminance(mean) / float(index + 1)};
    if (frame.shadow)
        segment.dry =
            scratch.dry.up_to(*frame.shadow, frame.tracer.ray_scene(), frame.view, x, y, path.distance, counters);
    if (!frame.rain->evaluate(segment, sampler, scratch.rain, scratch.streaks, counters)) return;
    for (size_t i = 0; i < scratch.rain.size(); ++i) {
        const RainSample& rain = scratch.rain[i];
        if (!is_finite(rain.light + rain.inscatter)) {
            ++counters.invalid_samples;
            continue;
        }
        add(sums.rain[i].removed, path.radiance * (1 - rain.transmission));
        add(sums.rain[i].light, rain.light);
        add(sums.rain[i].inscatter, rain.inscatter);
        sums.rain[i].coverage += rain.coverage;
        sums.rain[i].wide_coverage += rain.wide_coverage;
        sums.rain[i].blocked += 1 - rain.transmission;
    }
}

/// Depth, and the labels that the same ray finds, the latter into the values behind the layers of light.
void find_centre(const Frame& frame, int x, int y, Scratch& scratch, Counters& counters) {
    const Vec2 centre{float(x) + 0.5f, float(y) + 0.5f};
    Ray seen{Vec3(), normalize(frame.view.view_direction(centre))};
    RayHit hit;
    CentreDepth& depth = scratch.depth;
    const Ray ray = scene_ray(frame.view, seen);
    const bool found = frame.tracer.ray_scene().closest_hit(ray, {.at_half = true}, hit, counters);
    if (frame.labels)
        frame.labels->write(ray.direction, found ? &hit : nullptr, scratch.values.data() + frame.first_label,
                            scratch.ids.data(), counters);
    depth.distance = found ? hit.distance : std::numeric_limits<float>::infinity();
    depth.z = depth.distance * seen.direction.z;
    depth.rainy_z.assign(frame.intensity_count(), depth.z);
    if (!frame.bins) return;
    seen.t_max = depth.distance;
    find_hits(*frame.bins, scratch.candidates, centre, seen, scratch.streaks.hits);
    for (const StreakHit& h : scratch.streaks.hits) {
        const Streak& streak = frame.bins->streaks()[h.streak];
        if (h.width < 1) continue;
        const float z = h.covered.distance * seen.direction.z;
        for (size_t i = 0; i < depth.rainy_z.size(); ++i)
            if (streak.threshold_mm_per_h <= frame.settings.rain.intensities_mm_per_h[i])
                depth.rainy_z[i] = std::min(depth.rainy_z[i], z);
    }
}

void write_mattes(const Frame& frame, Scratch& scratch) {
    const int samples = frame.settings.samples;
    float* values = scratch.values.data() + frame.first_matte;
    scratch.objects.write(frame.mattes->object_ids, samples, values);
    scratch.materials.write(frame.mattes->material_ids, samples, values += cryptomatte_channels);
    values += cryptomatte_channels;
    for (const RainSums& rain : scratch.sums.rain) {
        const auto coverage = float(rain.coverage / samples);
        for (const float value : {coverage > 0 ? frame.mattes->rain_id : 0.0f, coverage, 0.0f, 0.0f}) *values++ = value;
    }
}

/// Counts finished pixels and passes the news on. Whoever comes while another thread tells it goes on.
class PixelProgress {
public:
    PixelProgress(const View& view, const ProgressCallback& callback)
        : pixels_(double(view.width) * view.height), callback_(callback) {}

    void add_pixel() {
        const double done = double(++done_) / pixels_;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock && !callback_(done))
            throw Error(ExitCode::stopped_early, "render", "stopped before the end, nothing was written");
    }

private:
    double pixels_;
    const ProgressCallback& callback_;
    std::atomic<int64_t> done_ = 0;
    std::mutex mutex_;
};

void render_tile(const Frame& frame, int x_begin, int x_end, Band& band, PixelProgress& progress, Counters& counters) {
    Scratch scratch;
    scratch.rain.resize(frame.intensity_count());
    scratch.values.resize(band.planes.size());
    scratch.ids.resize(band.ids.size());
    for (int y = band.y; y < band.y + band.rows; ++y)
        for (int x = x_begin; x < x_end; ++x) {
            scratch.sums.background = {};
            scratch.sums.rain.assign(frame.intensity_count(), {});
            scratch.objects.clear(), scratch.materials.clear();
            if (frame.bins) frame.bins->find_candidates(x, y, scratch.candidates);
            for (int s = 0; s < frame.settings.samples; ++s) add_sample(frame, x, y, s, scratch, counters);
            find_centre(frame, x, y, scratch, counters);
            develop(scratch.sums, scratch.depth, frame.settings.samples, scratch.values.data());
            const size_t pixel = size_t(y - band.y) * band.width + x;
            if (frame.mattes) write_mattes(frame, scratch);
            for (size_t c = 0; c < band.planes.size(); ++c) band.planes[c][pixel] = scratch.values[c];
            for (size_t c = 0; c < band.ids.size(); ++c) band.ids[c][pixel] = scratch.ids[c];
            progress.add_pixel();
        }
}

/// Bands in work; each leaves for the sink when it and all before it are complete. One thread at a time writes, outside
/// the lock, while the others go on rendering; they wait before they get too far ahead of it.
class BandQueue {
public:
    BandQueue(const View& view, int tile_size, const FrameChannels& channels, const BandSink& sink)
        : view_(view),
          tile_size_(tile_size),
          columns_((view.width + tile_size - 1) / tile_size),
          channels_(channels),
          sink_(sink) {}

    int columns() const { return columns_; }

    /// The band of a row of tiles. Rows are asked for in rising order, so that those that others wait for are in work.
    Band& band(int row) {
        std::unique_lock lock(mutex_);
        // Counted in rows: a thread that comes late for the row that all wait for finds its place free.
        written_.wait(lock, [&] { return stopped_ || row < next_row_ + max_open_bands; });
        auto& entry = bands_[row];
        if (!entry.band) {
            const int y = row * tile_size_;
            entry.band = std::make_unique<Band>(y, std::min(tile_size_, view_.height - y), view_.width,
                                                channels_.values.size(), channels_.ids.size());
        }
        return *entry.band;
    }

    void complete_tile(int row) {
        std::unique_lock lock(mutex_);
        ++bands_[row].tiles_done;
        if (writing_) return;
        writing_ = true;
        while (!bands_.empty() && bands_.begin()->first == next_row_ && bands_.begin()->second.tiles_done == columns_) {
            const std::unique_ptr<Band> band = std::move(bands_.begin()->second.band);
            lock.unlock();
            sink_(*band);
            lock.lock();
            bands_.erase(bands_.begin());
            ++next_row_;
            written_.notify_all();
        }
        writing_ = false;
    }

    /// Lets waiting threads go after a failure.
    void stop() {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
        written_.notify_all();
    }

private:
    static constexpr int max_open_bands = 16;
    struct Entry {
        std::unique_ptr<Band> band;
        int tiles_done = 0;
    };
    const View& view_;
    int tile_size_, columns_;
    FrameChannels channels_;
    const BandSink& sink_;
    std::mutex mutex_;
    std::condition_variable written_;
    std::map<int, Entry> bands_;
    int next_row_ = 0;
    bool writing_ = false, stopped_ = false;
};

}  // namespace

RenderReport render(const Scene& scene, const Environment& environment, const View& view,
                    const RenderSettings& settings, const BandSink& sink, const ProgressCallback& progress) {
    RenderReport report;
    const auto start = Clock::now();
    const RayScene ray_scene(scene);
    const Lights lights(scene, environment);
    std::optional<RainShadow> shadow;
    const bool fine_rain =
        !settings.rain.intensities_mm_per_h.empty() && settings.streaks.composition == Composition::physical;
    if (fine_rain || settings.wet.any()) shadow.emplace(scene, ray_scene, settings.rain.wind);
    std::optional<RainShadow> wet_shadow;
    if (settings.wet.any() && settings.wet_wind) wet_shadow.emplace(scene, ray_scene, *settings.wet_wind);
    std::optional<WetGround> wet_ground;
    const double time = view.shutter_open + view.exposure_time / 2;
    if (settings.wet.any())
        wet_ground.emplace(scene, wet_shadow ? *wet_shadow : *shadow, settings.wet, time, settings.rain.seed);
    const PathTracer tracer(scene, ray_scene, lights, settings.path, wet_ground ? &*wet_ground : nullptr);

    std::optional<StreakBins> bins;
    std::optional<RainMedium> medium;
    Frame frame{view, settings, tracer, nullptr, std::nullopt, nullptr, nullptr, nullptr};
    if (!settings.rain.intensities_mm_per_h.empty()) {
        RainSettings rain = settings.rain;
        const Bounds box = bounds(scene);
        rain.lowest_ground = box.empty() ? view.position.y - 100 : box.lower.y;
        std::vector<Streak> streaks = find_streaks(view, rain);
        report.sheltered_streaks = streaks.size();
        remove_sheltered(streaks, view, ray_scene, report.counters);
        report.sheltered_streaks -= streaks.size();
        report.streaks = streaks.size();
        bins.emplace(std::move(streaks), view);
        frame.bins = &*bins;
        // The paper's pictures have streaks in clear air.
        if (fine_rain || rain.fog_extinction > 0) medium.emplace(view, rain, fine_rain);
        if (fine_rain) frame.shadow = &*shadow;
        frame.rain.emplace(tracer, *bins, medium ? &*medium : nullptr, rain.intensities_mm_per_h, settings.streaks);
    }
    const LabelLayers& layers = settings.labels.layers;
    std::optional<LabelTracer> labels;
    std::optional<Mattes> mattes;
    if (layers.any_of_ray()) frame.labels = &labels.emplace(scene, ray_scene, view, settings.labels);
    if (layers.cryptomatte) frame.mattes = &mattes.emplace(scene, *settings.labels.objects);
    frame.first_label = layer_channels(settings.rain.intensities_mm_per_h).size();
    frame.first_matte = frame.first_label + label_channels(layers).size();
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
