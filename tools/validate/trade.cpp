#include "tools/validate/trade.h"

#include "tools/clock.h"
#include "tools/dataset/file_hash.h"
#include "tools/sample_choice.h"
#include "tools/scene_light.h"
#include "tools/validate/color_metrics.h"
#include "tools/validate/flip.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace pluvia {
namespace {

double cpu_seconds() {
    return clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
}

double wall_seconds() {
    return clock_seconds(CLOCK_MONOTONIC);
}

void append_rows(Image<Rgb>& image, const Band& band, size_t first) {
    for (size_t i = 0; i < band.planes[first].size(); ++i)
        image.pixels[size_t(band.y) * band.width + i] = {band.planes[first][i], band.planes[first + 1][i],
                                                         band.planes[first + 2][i]};
}

}  // namespace

TradeScene::TradeScene(const RenderOptions& options) : settings_(options), frame_(load_frame_scene(options)) {
    prepare_scene(frame_.scene, options, settings_);
    view_ = make_view(find_camera(frame_.scene, options.camera), settings_.camera);
    RenderOptions frame = options;
    frame.spp = 0, frame.seed = 0, frame.rain_seed = options.rain_seed.value_or(options.seed);
    // A file of light may change under its name.
    const double light = settings_.environment.horizontal_illuminance();
    key_ = hash_key(frame_.hash, hash_text(json_text(to_json(frame))), std::bit_cast<uint64_t>(light),
                    hash_text(PLUVIA_VERSION));
}

JudgedLayers TradeScene::render(RenderSettings settings, const std::optional<double>& target_error, TradeResult& result,
                                const ProgressCallback& progress) const {
    const std::vector<double>& intensities = settings.rain.intensities_mm_per_h;
    double cpu_begin = cpu_seconds(), wall_begin = 0;
    settings.choose_samples = [&](const PixelRenderer& pilot) {
        const double now = cpu_seconds();
        result.build_cpu_s += now - cpu_begin;
        cpu_begin = now, wall_begin = wall_seconds();
        return target_error ? samples_for_error(*target_error, pilot, intensities, int64_t(view_.width) * view_.height,
                                                settings.seed)
                            : settings.samples;
    };
    JudgedLayers layers{Image<Rgb>(view_.width, view_.height), {}};
    size_t rainy = 0;
    if (!intensities.empty()) {
        const auto names = layer_channels(intensities);
        const double most = *std::max_element(intensities.begin(), intensities.end());
        rainy = size_t(std::find(names.begin(), names.end(), "rainy_" + intensity_label(most) + ".R") - names.begin());
        layers.rainy.emplace(view_.width, view_.height);
    }
    const RenderReport report = pluvia::render(
        frame_.scene, settings_.environment, view_, settings,
        [&](const Band& band) {
            append_rows(layers.background, band, 0);
            if (layers.rainy) append_rows(*layers.rainy, band, rainy);
        },
        progress);
    result.cpu_s += cpu_seconds() - cpu_begin, result.wall_s += wall_seconds() - wall_begin;
    result.samples += report.samples;
    return layers;
}

LayerError error_of_layer(const Image<Rgb>& got, const Image<Rgb>& reference) {
    LayerError result;
    result.error = std::sqrt(trimmed_mean(relative_squared_errors(got, reference)));
    const Image<float> flip = hdr_flip(got, reference);
    double sum = 0;
    for (const float v : flip.pixels) sum += v;
    result.flip = sum / double(flip.pixels.size());
    const Bias b = bias(got, reference);
    result.bias = b.value, result.bias_low = b.low, result.bias_high = b.high;
    return result;
}

std::vector<bool> pareto_front(const std::vector<TradeResult>& results, double (TradeResult::*value)() const) {
    std::vector<bool> front(results.size());
    for (size_t i = 0; i < results.size(); ++i)
        front[i] = std::none_of(results.begin(), results.end(), [&](const TradeResult& other) {
            const double t = results[i].cpu_s, e = (results[i].*value)();
            return other.cpu_s <= t && (other.*value)() <= e && (other.cpu_s < t || (other.*value)() < e);
        });
    return front;
}

}  // namespace pluvia
