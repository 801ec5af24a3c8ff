#include "tools/dataset/item.h"

#include "renderer/transport/layers.h"
#include "tools/dataset/file_hash.h"
#include "tools/option_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pluvia {

std::string DatasetItem::id() const {
    return fmt::format("{}/{}/frame_{:04}", scene_name, camera, frame);
}

std::string DatasetItem::clean_path(const std::string& kind, const std::string& extension) const {
    return fmt::format("clean/{}/{}/{}/frame_{:04}.{}", scene_name, camera, kind, frame, extension);
}

std::string DatasetItem::rainy_path(double intensity, const std::string& kind, const std::string& extension) const {
    if (is_sequence)
        return fmt::format("rainy/{}/{}/over_time/{}/frame_{:04}.{}", scene_name, camera, kind, frame, extension);
    return fmt::format("rainy/{}/{}/{}/{}/{}/frame_{:04}.{}", scene_name, camera, intensity_folder(intensity),
                       wind_name(options.wind), kind, frame, extension);
}

namespace {

std::vector<double> numbers(Vec3d v) {
    return {v.x, v.y, v.z};
}

/// The rain of one sequence is the same rain in all its frames.
void set_rain_over_time(const DatasetScene& scene, DatasetItem& item) {
    item.is_sequence = true;
    // In steps of 0.01 mm/h, so that names of channels are short.
    item.options.rain = {std::round(100 * value_at(scene.course.rain, item.frame).x) / 100};
    const uint64_t seed = scene.options.seed;
    item.options.rain_seed = hash_text(fmt::format("{}/{}/{}", seed, item.scene_name, item.camera)) >> 32;
    const std::vector<FrameKey>& wind = scene.course.wind;
    if (wind.empty()) return;
    item.options.wind = numbers(value_at(wind, item.frame));
    item.options.wind_travel = numbers(integral_to(wind, item.frame) * (1 / item.options.fps));
    if (item.options.wetness == 0 && item.options.puddles == 0) return;
    // Water does not leave the ground as soon as the wind turns: what is wet is so by the mean wind.
    const double frames = std::max(1.0, wind.back().frame);
    item.options.wet_wind = numbers(integral_to(wind, frames) * (1 / frames));
}

}  // namespace

LabelSource DatasetItem::labels(const std::string& dataset) const {
    std::string name = id();
    std::replace(name.begin(), name.end(), '/', '_');
    return {dataset + "/" + exr_path(), dataset + "/" + record_path(), name};
}

std::string wind_name(const std::vector<double>& wind) {
    std::string name = fmt::format("wind_{:g}", wind[0]);
    if (wind[1] != 0 || wind[2] != 0) name += fmt::format("_{:g}_{:g}", wind[1], wind[2]);
    return name;
}

std::string intensity_folder(double intensity) {
    std::string text = fmt::format("{}", intensity);
    if (const size_t point = text.find('.'); point != std::string::npos) text[point] = 'p';
    return text + "mm";
}

std::vector<DatasetItem> dataset_items(const DatasetConfig& config) {
    std::vector<DatasetItem> items;
    for (size_t s = 0; s < config.scenes.size(); ++s) {
        const DatasetScene& scene = config.scenes[s];
        for (const bool is_test : {false, true})
            for (const std::string& camera : is_test ? scene.test : scene.train)
                for (int frame = 0; frame < scene.frames; ++frame) {
                    DatasetItem item{s, scene.name, camera, is_test, frame, scene.options};
                    item.options.camera = camera;
                    item.options.frame = frame;
                    item.options.light.hour = config.hours.empty() ? 24.0 * frame / scene.frames
                                                                   : config.hours[size_t(frame) % config.hours.size()];
                    if (scene.hour) item.options.light.hour = *scene.hour;
                    const Vec3d wind = config.winds[size_t(frame) % config.winds.size()];
                    item.options.wind = {wind.x, wind.y, wind.z};
                    // Noise of its own: the same in every frame would be learnt as a part of pictures.
                    item.options.seed = hash_text(fmt::format("{}/{}", scene.options.seed, item.id())) >> 32;
                    item.options.depth_encoding = "hri";
                    if (scene.is_sequence()) set_rain_over_time(scene, item);
                    items.push_back(std::move(item));
                }
    }
    return items;
}

std::string Shard::label() const {
    return fmt::format("{}-of-{}", number, count);
}

Shard Shard::parse(const std::string& text) {
    Shard shard;
    const size_t slash = text.find('/');
    if (slash == std::string::npos || !parse_number(std::string_view(text).substr(0, slash), shard.number) ||
        !parse_number(std::string_view(text).substr(slash + 1), shard.count) || shard.number < 1 ||
        shard.number > shard.count)
        fail_option("shard", '"' + text + '"', "I/N with I from 1 to N");
    return shard;
}

std::vector<DatasetItem> shard_items(const std::vector<DatasetItem>& items, Shard shard) {
    const auto [begin, end] = shard.range(items.size());
    return {items.begin() + long(begin), items.begin() + long(end)};
}

}  // namespace pluvia
