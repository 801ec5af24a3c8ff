#include "renderer/transport/drop_light.h"

#include "renderer/core/parallel.h"
#include "renderer/core/sampling.h"
#include "renderer/transport/camera_ray.h"
#include "renderer/transport/scatter_function.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pluvia {
namespace {

constexpr int columns_wanted = 64;
constexpr int samples = 16;  // of a cell, for each slice that its pixels reach

constexpr uint64_t drop_light_domain = 0x6472706c;

constexpr std::array<float, DropLight::slices> make_ends() {
    std::array<float, DropLight::slices> ends = {};
    float end = 0.5f;
    for (int k = 0; k + 1 < DropLight::slices; ++k, end *= 1.5f) ends[size_t(k)] = end;
    ends.back() = std::numeric_limits<float>::infinity();
    return ends;
}
constexpr std::array<float, DropLight::slices> ends = make_ends();

/// Directions drawn with the share that they have of the light offered.
class Reservoir {
public:
    /// key: of random numbers.
    void offer(Vec3 direction, float weight, uint64_t key, std::array<Vec3, DropLight::directions>& chosen) {
        if (!(weight > 0)) return;
        total_ += weight;
        for (size_t i = 0; i < chosen.size(); ++i)
            if (unit_float(hash_key(key, i)) * total_ < weight) chosen[i] = direction;
    }

private:
    float total_ = 0;
};

/// Light of one lamp at a drop, chosen by what it may bring.
LightSample lamp_light(const PathTracer& tracer, Vec3 position, const ScatterFunction& function, const Sampler& sampler,
                       Rgb& contribution, Counters& counters) {
    const Lights& lights = tracer.lights();
    contribution = Rgb(0);
    const auto lamp =
        lights.choose_local({position, Vec3()}, sampler.get_1d(Draw::light_choice), sampler.get_2d(Draw::light_point));
    if (!lamp) return {};
    const LightSample light = lights.illuminate(position, *lamp);
    if (is_black(light.radiance)) return light;
    const ScatterValue scatter = evaluate_scatter(function, light.wi);
    const float mis = light.delta ? 1.0f : power_heuristic(light.pdf, scatter.pdf);
    contribution = light.radiance * (scatter.value * mis / light.pdf);
    contribution *= visible_share(tracer.ray_scene(), position, light, {sampler.key(Draw::light_point)}, counters);
    return light;
}

}  // namespace

int DropLight::slice_of(float z) {
    int slice = 0;
    while (slice + 1 < slices && z >= ends[size_t(slice)]) ++slice;
    return slice;
}

float DropLight::end_of(int slice) {
    return ends[size_t(slice)];
}

DropLight::DropLight(const PathTracer& tracer, const FarLight& far, const PictureSource& picture, const View& view,
                     uint64_t seed, float near)
    : size_(std::max(1, (view.width + columns_wanted - 1) / columns_wanted)),
      columns_((view.width + size_ - 1) / size_),
      rows_((view.height + size_ - 1) / size_),
      cells_(size_t(columns_) * size_t(rows_)) {
    parallel_for(int(cells_.size()), [&](int i) {
        cells_[size_t(i)] = estimate(tracer, far, picture, view, seed, near, i % columns_, i / columns_);
    });
}

DropLight::Cell DropLight::estimate(const PathTracer& tracer, const FarLight& far, const PictureSource& picture,
                                    const View& view, uint64_t seed, float near, int column, int row) const {
    Cell result;
    std::array<std::array<double, 3>, slices> sums = {};
    std::array<int, slices> counts = {};
    std::array<Reservoir, slices> reservoirs;
    Counters uncounted;
    const int width = std::min(size_, view.width - column * size_);
    const int height = std::min(size_, view.height - row * size_);
    for (int n = 0; n < samples; ++n) {
        const Sampler of_ray = Sampler(seed, uint32_t(column), uint32_t(row), uint32_t(n)).fork(drop_light_domain);
        const Vec2 u = of_ray.get_2d(Draw::pixel);
        const Vec2 pixel{float(column * size_) + u.x * float(width), float(row * size_) + u.y * float(height)};
        const Ray seen = view_ray(view, pixel, {});
        const Ray ray = scene_ray(view, {}, seen).ray;
        const float deepest =
            picture.z.at(std::min(int(pixel.x), view.width - 1), std::min(int(pixel.y), view.height - 1));
        const ScatterFunction function = DropScatter{ray.direction};
        float begin = near;
        for (size_t k = 0; k < slices && begin < deepest; begin = std::max(near, ends[k++])) {
            const float end = std::min(ends[k], deepest);
            // Of a drop farther than the last of them all is far away.
            const Sampler sampler = of_ray.fork(k);
            const float depth =
                k + 1 < slices ? begin + sampler.get_1d(Draw::medium_distance) * std::max(0.0f, end - begin) : begin;
            const Vec3 position = ray.at(depth / seen.direction.z);
            const Vec3 wi = sample_scatter(function, sampler.get_2d(Draw::streak_phase));
            const ScatterValue scatter = evaluate_scatter(function, wi);
            // Against what the far light has for the same direction: they differ where something is near.
            const PathResult path =
                tracer.trace({position, wi}, {scatter.pdf, {position, Vec3()}}, sampler, 1, uncounted, {});
            const Rgb around = std::isinf(path.distance) ? far.open(wi) : path.radiance;
            const Rgb nearby = (around - far.radiance(wi)) * (scatter.value / scatter.pdf);
            Rgb of_lamp;
            LightSample lamp = {};
            if (tracer.lights().has_local()) lamp = lamp_light(tracer, position, function, sampler, of_lamp, uncounted);
            const Rgb sum = nearby + of_lamp;
            if (!is_finite(sum)) continue;
            sums[k][0] += sum.r, sums[k][1] += sum.g, sums[k][2] += sum.b;
            ++counts[k];
            reservoirs[k].offer(wi, luminance(around), sampler.key(Draw::light_pick), result.from[k]);
            reservoirs[k].offer(lamp.wi, luminance(of_lamp), sampler.key(Draw::roulette), result.from[k]);
        }
    }
    const Vec2 middle{float(column * size_) + 0.5f * float(width), float(row * size_) + 0.5f * float(height)};
    const Vec3 ahead = scene_ray(view, {}, view_ray(view, middle, {})).ray.direction;
    Rgb correction;
    for (size_t k = 0; k < slices; ++k) {
        // A slice that no ray has reached has what is before it.
        if (counts[k] > 0)
            correction =
                Rgb(float(sums[k][0] / counts[k]), float(sums[k][1] / counts[k]), float(sums[k][2] / counts[k]));
        else if (k > 0)
            result.from[k] = result.from[k - 1];
        for (Vec3& from : result.from[k])
            if (length_squared(from) == 0) from = ahead;
        const Rgb light = far.of_drop(ahead) + correction;
        result.light[k] = Rgb(std::max(0.0f, light.r), std::max(0.0f, light.g), std::max(0.0f, light.b));
    }
    return result;
}

void DropLight::find(int x, int y, int last, std::array<Rgb, slices>& light) const {
    const float across = (float(x) + 0.5f) / float(size_) - 0.5f, down = (float(y) + 0.5f) / float(size_) - 0.5f;
    const int x0 = std::clamp(int(std::floor(across)), 0, columns_ - 1), x1 = std::min(x0 + 1, columns_ - 1);
    const int y0 = std::clamp(int(std::floor(down)), 0, rows_ - 1), y1 = std::min(y0 + 1, rows_ - 1);
    const float s = std::clamp(across - float(x0), 0.0f, 1.0f), t = std::clamp(down - float(y0), 0.0f, 1.0f);
    const Cell &a = cell(x0, y0), &b = cell(x1, y0), &c = cell(x0, y1), &d = cell(x1, y1);
    for (size_t k = 0; k <= size_t(last); ++k)
        light[k] = mix(mix(a.light[k], b.light[k], s), mix(c.light[k], d.light[k], s), t);
}

Vec3 DropLight::direction(int x, int y, int slice, float u) const {
    const Cell& here = cell(std::min(x / size_, columns_ - 1), std::min(y / size_, rows_ - 1));
    return here.from[size_t(slice)][std::min(size_t(u * directions), size_t(directions - 1))];
}

}  // namespace pluvia
