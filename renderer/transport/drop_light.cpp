#include "renderer/transport/drop_light.h"

#include "renderer/core/parallel.h"
#include "renderer/core/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

namespace pluvia {
namespace {

constexpr int most_columns = 64;

constexpr std::array<float, DropLight::slices> make_ends() {
    std::array<float, DropLight::slices> ends = {};
    float end = 0.5f;
    for (int k = 0; k + 1 < DropLight::slices; ++k, end *= 1.5f) ends[size_t(k)] = end;
    ends.back() = std::numeric_limits<float>::infinity();
    return ends;
}
constexpr std::array<float, DropLight::slices> ends = make_ends();

}  // namespace

DropLight::DropLight(const View& view, int least_size, bool smooth, const Estimate& estimate, Counters& counters)
    : size_(std::max(least_size, (view.width + most_columns - 1) / most_columns)),
      columns_((view.width + size_ - 1) / size_),
      rows_((view.height + size_ - 1) / size_) {
    std::vector<DropLightSamples> found(size_t(columns_) * size_t(rows_), DropLightSamples(Rgb(), Vec3()));
    std::mutex mutex;
    parallel_for(int(found.size()), [&](int i) {
        const int column = i % columns_, row = i / columns_, x = column * size_, y = row * size_;
        Counters of_cell;
        found[size_t(i)] =
            estimate({column, row, x, y, std::min(size_, view.width - x), std::min(size_, view.height - y)}, of_cell);
        const std::lock_guard lock(mutex);
        counters += of_cell;
    });
    if (smooth) DropLightSamples::smooth(found, columns_);
    for (const DropLightSamples& samples : found) cells_.push_back(mean(samples));
}

DropLight::Cell DropLight::mean(const DropLightSamples& samples) {
    Cell result;
    Light mean;
    std::array<Vec3, directions> from;
    from.fill(samples.ahead_);
    const double most = std::ranges::max(samples.sums_, {}, &DropLightSamples::Sum::count).count();
    for (size_t k = 0; k < slices; ++k) {
        const auto& [r, g, b, lamps, count] = samples.sums_[k].light_and_count;
        // A slice without samples has what is before it.
        if (count > 0) {
            mean = {Rgb(float(r / count), float(g / count), float(b / count)), float(lamps / count)};
            for (size_t i = 0; i < from.size(); ++i) {
                const Vec3 chosen = samples.from_[k].chosen[i];
                from[i] = length_squared(chosen) > 0 ? chosen : samples.ahead_;
            }
        }
        const Rgb light = samples.base_ + mean.radiance;
        result.light[k] = {Rgb(std::max(0.0f, light.r), std::max(0.0f, light.g), std::max(0.0f, light.b)), mean.lamps};
        result.known[k] = most > 0 ? float(count / most) : 0;
        result.from[k] = from;
    }
    return result;
}

int DropLight::slice_of(float z) {
    int slice = 0;
    while (slice + 1 < slices && z >= ends[size_t(slice)]) ++slice;
    return slice;
}

float DropLight::end_of(int slice) {
    return ends[size_t(slice)];
}

float DropLight::depth_in(int slice, float near, float deepest, float u) {
    const float begin = slice > 0 ? std::max(near, ends[size_t(slice) - 1]) : near;
    if (slice + 1 == slices) return begin;
    return begin + u * std::max(0.0f, std::min(ends[size_t(slice)], deepest) - begin);
}

void DropLight::find(int x, int y, int last, Slices& light) const {
    const float across = (float(x) + 0.5f) / float(size_) - 0.5f, down = (float(y) + 0.5f) / float(size_) - 0.5f;
    const int x0 = std::clamp(int(std::floor(across)), 0, columns_ - 1), x1 = std::min(x0 + 1, columns_ - 1);
    const int y0 = std::clamp(int(std::floor(down)), 0, rows_ - 1), y1 = std::min(y0 + 1, rows_ - 1);
    const float s = std::clamp(across - float(x0), 0.0f, 1.0f), t = std::clamp(down - float(y0), 0.0f, 1.0f);
    const std::array<const Cell*, 4> cells = {&cell(x0, y0), &cell(x1, y0), &cell(x0, y1), &cell(x1, y1)};
    const std::array<float, 4> weights = {(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t};
    for (size_t k = 0; k <= size_t(last); ++k) {
        Light sum;
        float known = 0;
        for (size_t i = 0; i < cells.size(); ++i) {
            const float weight = weights[i] * cells[i]->known[k];
            sum.radiance += cells[i]->light[k].radiance * weight;
            sum.lamps += cells[i]->light[k].lamps * weight;
            known += weight;
        }
        light[k] = known > 0 ? Light{sum.radiance * (1 / known), sum.lamps / known} : cells[0]->light[k];
    }
}

Vec3 DropLight::direction(int x, int y, int slice, float u) const {
    const Cell& here = cell(std::min(x / size_, columns_ - 1), std::min(y / size_, rows_ - 1));
    return here.from[size_t(slice)][std::min(size_t(u * directions), size_t(directions - 1))];
}

void DropLightSamples::add(int slice, const DropLight::Light& light, Counters& counters) {
    if (!is_finite(light.radiance) || !std::isfinite(light.lamps)) {
        ++counters.invalid_samples;
        return;
    }
    auto& [r, g, b, lamps, count] = sums_[size_t(slice)].light_and_count;
    r += light.radiance.r, g += light.radiance.g, b += light.radiance.b, lamps += light.lamps, ++count;
}

void DropLightSamples::offer(int slice, Vec3 direction, float weight, uint64_t key) {
    if (!(weight > 0)) return;
    Directions& from = from_[size_t(slice)];
    from.offered += weight;
    // Each place is taken with the share that the direction has of all light offered.
    for (size_t i = 0; i < from.chosen.size(); ++i)
        if (unit_float(hash_key(key, i)) * from.offered < weight) from.chosen[i] = direction;
}

DropLightSamples::Sum DropLightSamples::Sum::smoothed(const Sum& before, const Sum& after) const {
    Sum result;
    for (size_t i = 0; i < light_and_count.size(); ++i)
        result.light_and_count[i] =
            0.25 * before.light_and_count[i] + 0.5 * light_and_count[i] + 0.25 * after.light_and_count[i];
    return result;
}

void DropLightSamples::smooth(std::vector<DropLightSamples>& cells, int columns) {
    const int rows = int(cells.size()) / columns;
    const auto at = [&](int column, int row, int slice) -> Sum& {
        return cells[size_t(row) * size_t(columns) + size_t(column)].sums_[size_t(slice)];
    };
    std::vector<Sum> line;
    // sum(i): of `count` in a line; the first and the last stand for what is beyond them.
    const auto smooth_line = [&](int count, const auto& sum) {
        line.clear();
        for (int i = 0; i < count; ++i)
            line.push_back(sum(i).smoothed(sum(std::max(i - 1, 0)), sum(std::min(i + 1, count - 1))));
        for (int i = 0; i < count; ++i) sum(i) = line[size_t(i)];
    };
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            smooth_line(DropLight::slices, [&](int i) -> Sum& { return at(column, row, i); });
    for (int slice = 0; slice < DropLight::slices; ++slice) {
        for (int row = 0; row < rows; ++row) smooth_line(columns, [&](int i) -> Sum& { return at(i, row, slice); });
        for (int column = 0; column < columns; ++column)
            smooth_line(rows, [&](int i) -> Sum& { return at(column, i, slice); });
    }
}

}  // namespace pluvia
