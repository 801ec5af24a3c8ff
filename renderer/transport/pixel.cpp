#include "renderer/transport/pixel.h"

#include "renderer/core/sampling.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pluvia {
namespace {

void add(std::array<double, 3>& sum, Rgb value) {
    sum[0] += value.r, sum[1] += value.g, sum[2] += value.b;
}

/// count: of samples that are alike.
void add_rain(Rgb background, double count, const std::vector<RainSample>& samples, PixelSums& sums,
              Counters& counters) {
    const auto add = [count](std::array<double, 3>& sum, Rgb value) {
        sum[0] += count * value.r, sum[1] += count * value.g, sum[2] += count * value.b;
    };
    for (size_t i = 0; i < samples.size(); ++i) {
        const RainSample& rain = samples[i];
        if (!is_finite(rain.light + rain.inscatter)) {
            counters.invalid_samples += uint64_t(count);
            continue;
        }
        add(sums.rain[i].removed, background * (1 - rain.transmission));
        add(sums.rain[i].light, rain.light);
        add(sums.rain[i].inscatter, rain.inscatter);
        sums.rain[i].coverage += count * rain.coverage;
        sums.rain[i].wide_coverage += count * rain.wide_coverage;
        sums.rain[i].blocked += count * (1 - rain.transmission);
    }
}

/// Takes the samples begin <= i < end some at a time: visit(first, their positions on the picture). Of the candidates
/// the ray of sample first + i may meet those in touched[i].
template <class Visit>
void for_some_samples(const Frame& frame, int x, int y, int begin, int end, std::span<const uint32_t> candidates,
                      StreakBins::Touched& touched, const Visit& visit) {
    std::array<Vec2, std::tuple_size_v<StreakBins::Touched>> positions;
    for (int first = begin; first < end; first += int(positions.size())) {
        const std::span<Vec2> some(positions.data(), std::min(positions.size(), size_t(end - first)));
        Sampler(frame.settings.seed, uint32_t(x), uint32_t(y), uint32_t(first)).get_2d(Draw::pixel, some);
        for (Vec2& position : some) position = {float(x) + position.x, float(y) + position.y};
        if (frame.bins) frame.bins->find_touched(candidates, some, touched);
        visit(first, std::span<const Vec2>(some));
    }
}

/// Adds the light along a sample's path; where there is rain, the sample then waits in scratch.rainy.
/// pixel: the sample's position on the picture. touched: streaks that rays through it may meet.
void add_path(const Frame& frame, int x, int y, int index, Vec2 pixel, std::span<const uint32_t> touched,
              PixelScratch& scratch, Counters& counters) {
    const Sampler sampler(frame.settings.seed, uint32_t(x), uint32_t(y), uint32_t(index));
    if (frame.view.lens_radius > 0) counters.count(Feature::lens);
    Ray seen = view_ray(frame.view, pixel, frame.view.lens_radius > 0 ? sampler.get_2d(Draw::lens) : Vec2());
    const SceneRay ray = scene_ray(frame.view, frame.far_scene, seen);
    counters.count(Feature::camera_path);
    PixelSums& sums = scratch.film.sums;
    const auto mean_luminance = [&](int samples) {
        const auto& sum = sums.background;
        return luminance(Rgb(float(sum[0]), float(sum[1]), float(sum[2]))) / float(samples);
    };
    const PathResult path = frame.picture ? frame.picture->along(x, y, seen)
                                          : frame.tracer.trace(ray.near, {}, sampler, 0, counters,
                                                               {index > 0 ? mean_luminance(index) : 0.0f});
    if (!is_finite(path.radiance)) {
        ++counters.invalid_samples;
        return;
    }
    if (frame.mattes && path.first.instance >= 0) {
        const Instance& instance = frame.mattes->scene.instances[path.first.instance];
        counters.count(Feature::matte);
        scratch.film.objects.add(frame.mattes->objects.object_of_instance[path.first.instance]);
        scratch.film.materials.add(frame.mattes->scene.meshes[instance.mesh].material);
    }
    add(sums.background, path.radiance);
    if (!frame.rain) return;
    seen.t_max = float(ray.before + path.distance);
    scratch.rainy.push_back(
        {index, {pixel, touched, ray.ray, seen, path.radiance, std::max(frame.dark, mean_luminance(index + 1))}});
}

/// Adds the rain of a sample whose path is done.
void add_rain_on_path(const Frame& frame, int x, int y, int index, CameraSegment& segment, PixelScratch& scratch,
                      Counters& counters) {
    if (frame.rain->drop_light()) segment.drop_light = &scratch.drop_light;
    if (frame.shadow)
        segment.dry = scratch.dry.up_to(*frame.shadow, frame.tracer.ray_scene(), frame.view, x, y,
                                        segment.view_ray.t_max, counters);
    const Sampler sampler(frame.settings.seed, uint32_t(x), uint32_t(y), uint32_t(index));
    if (!frame.rain->evaluate(segment, sampler, scratch.rain, scratch.streaks, counters)) return;
    add_rain(segment.background, 1, scratch.rain, scratch.film.sums, counters);
}

}  // namespace

void begin_pixel(const Frame& frame, int x, int y, PixelScratch& scratch) {
    scratch.film.sums.background = {};
    scratch.film.sums.rain.assign(frame.intensity_count(), {});
    scratch.film.objects.clear(), scratch.film.materials.clear();
    if (frame.bins) frame.bins->find_candidates(x, y, scratch.candidates);
    const DropLight* const drop_light = frame.rain && !frame.picture ? frame.rain->drop_light() : nullptr;
    if (drop_light) drop_light->find(x, y, DropLight::slices - 1, scratch.drop_light);
}

/// Samples of a picture's pixel, which is the same for all of them but for the streaks that they meet.
static void add_picture_samples(const Frame& frame, int x, int y, int begin, int end, PixelScratch& scratch,
                                Counters& counters) {
    const PictureSource& picture = *frame.picture;
    const Rgb background = picture.radiance.at(x, y);
    PixelSums& sums = scratch.film.sums;
    add(sums.background, background * float(end - begin));
    if (scratch.candidates.empty() && !frame.has_medium) return;
    const Vec2 centre{float(x) + 0.5f, float(y) + 0.5f};
    CameraSegment segment{centre, scratch.candidates, {}, {}, background, std::max(frame.dark, luminance(background))};
    Ray& seen = segment.view_ray;
    seen = {Vec3(), normalize(frame.view.view_direction(centre))};
    seen.t_max = picture.along(x, y, seen).distance;
    segment.ray = scene_ray(frame.view, frame.far_scene, seen).ray;
    segment.candidates = frame.bins->before_end(scratch.candidates, seen);
    frame.rain->begin_pixel(x, y, segment, scratch.veil);
    const auto samples = uint64_t(end - begin);
    counters.count(Feature::camera_path, samples);
    counters.count(Feature::streak_test, samples);
    if (frame.view.lens_radius > 0) counters.count(Feature::lens, samples);

    int untouched = end - begin;
    const auto add_sample = [&](int index, Vec2 position, std::span<const uint32_t> touched) {
        if (touched.empty()) return;
        const Sampler sampler(frame.settings.seed, uint32_t(x), uint32_t(y), uint32_t(index));
        seen = view_ray(frame.view, position, frame.view.lens_radius > 0 ? sampler.get_2d(Draw::lens) : Vec2());
        seen.t_max = picture.along(x, y, seen).distance;
        find_hits(*frame.bins, touched, seen, scratch.streaks.hits);
        if (scratch.streaks.hits.empty()) return;
        --untouched;
        segment.pixel = position;
        if (frame.rain->needs_ray(scratch.streaks.hits)) segment.ray = scene_ray(frame.view, frame.far_scene, seen).ray;
        frame.rain->evaluate(segment, scratch.veil, sampler, scratch.rain, scratch.streaks, counters);
        add_rain(background, 1, scratch.rain, sums, counters);
    };
    for_some_samples(frame, x, y, begin, end, segment.candidates, scratch.touched,
                     [&](int first, std::span<const Vec2> positions) {
                         for (size_t i = 0; i < positions.size(); ++i)
                             add_sample(first + int(i), positions[i], scratch.touched[i]);
                     });
    add_rain(background, untouched, scratch.veil.untouched, sums, counters);
}

void add_samples(const Frame& frame, int x, int y, int begin, int end, PixelScratch& scratch, Counters& counters) {
    if (frame.rain && frame.picture && frame.rain->drop_light())
        add_picture_samples(frame, x, y, begin, end, scratch, counters);
    else if (frame.picture && scratch.candidates.empty() && !frame.has_medium)
        add(scratch.film.sums.background, frame.picture->radiance.at(x, y) * float(end - begin));
    else
        for_some_samples(frame, x, y, begin, end, scratch.candidates, scratch.touched,
                         [&](int first, std::span<const Vec2> positions) {
                             for (size_t i = 0; i < positions.size(); ++i)
                                 add_path(frame, x, y, first + int(i), positions[i], scratch.touched[i], scratch,
                                          counters);
                             for (auto& [index, segment] : scratch.rainy)
                                 add_rain_on_path(frame, x, y, index, segment, scratch, counters);
                             scratch.rainy.clear();
                         });
}

void find_centre(const Frame& frame, int x, int y, PixelScratch& scratch, Counters& counters) {
    const Vec2 centre{float(x) + 0.5f, float(y) + 0.5f};
    Ray seen{Vec3(), normalize(frame.view.view_direction(centre))};
    CentreDepth& depth = scratch.depth;
    const SceneRay ray = scene_ray(frame.view, frame.far_scene, seen);
    RayHit hit;
    const bool found =
        !frame.picture && frame.tracer.ray_scene().closest_hit(ray.near, {.at_half = true}, hit, counters);
    if (frame.labels)
        frame.labels->write(ray.ray.direction, found ? &hit : nullptr, scratch.values.data() + frame.first_label,
                            scratch.ids.data(), counters);
    depth.distance = found           ? float(ray.before + hit.distance)
                     : frame.picture ? frame.picture->along(x, y, seen).distance
                                     : std::numeric_limits<float>::infinity();
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

void write_mattes(const Frame& frame, PixelScratch& scratch) {
    const int samples = frame.settings.samples;
    float* values = scratch.values.data() + frame.first_matte;
    scratch.film.objects.write(frame.mattes->object_ids, samples, values);
    scratch.film.materials.write(frame.mattes->material_ids, samples, values += cryptomatte_channels);
    values += cryptomatte_channels;
    for (const RainSums& rain : scratch.film.sums.rain) {
        const auto coverage = float(rain.coverage / samples);
        for (const float value : {coverage > 0 ? frame.mattes->rain_id : 0.0f, coverage, 0.0f, 0.0f}) *values++ = value;
    }
}

}  // namespace pluvia
