#include "tools/validate/trade_reference.h"

#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "renderer/image/table_file.h"
#include "tools/sample_choice.h"
#include "tools/validate/color_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

constexpr uint64_t reference_domain = 0x7265666572;  // "refer": its random numbers are none of a setting's

/// Layers one after the other, three floats a pixel.
std::vector<float> values_of(const JudgedLayers& layers) {
    std::vector<float> values;
    const auto append = [&](const Image<Rgb>& image) {
        for (const Rgb c : image.pixels) values.insert(values.end(), {c.r, c.g, c.b});
    };
    append(layers.background);
    if (layers.rainy) append(*layers.rainy);
    return values;
}

Image<Rgb> image_of(const std::vector<double>& sums, double scale, int width, int height, size_t layer) {
    Image<Rgb> image(width, height);
    const double* v = &sums[layer * image.pixels.size() * 3];
    for (Rgb& pixel : image.pixels) {
        pixel = Rgb(float(v[0] * scale), float(v[1] * scale), float(v[2] * scale));
        v += 3;
    }
    return image;
}

/// Of the mean of two halves: it is off by half of what the halves differ by, in the square.
double error_of_mean(const Image<Rgb>& a, const Image<Rgb>& b) {
    Image<Rgb> truth = a, apart = a;
    for (size_t i = 0; i < truth.pixels.size(); ++i) {
        truth.pixels[i] = truth_of_halves(a.pixels[i], b.pixels[i]);
        apart.pixels[i] = truth.pixels[i] + (a.pixels[i] - b.pixels[i]) * 0.5f;
    }
    return std::sqrt(trimmed_mean(relative_squared_errors(apart, truth)));
}

}  // namespace

TradeReference find_reference(const TradeScene& scene, const RenderSettings& settings, int samples,
                              const std::string& folder, const ProgressCallback& progress) {
    const int batches = 2 * std::max(1, (samples + 2 * reference_batch - 1) / (2 * reference_batch));
    const int width = scene.view().width, height = scene.view().height;
    const size_t layers = settings.rain.intensities_mm_per_h.empty() ? 1 : 2;
    const size_t count = size_t(width) * height * 3 * layers;
    std::vector<double> halves[2] = {std::vector<double>(count), std::vector<double>(count)};
    for (int b = 0; b < batches; ++b) {
        const uint64_t key = hash_key(scene.key(), reference_domain, reference_batch, b);
        const std::string path = fmt::format("{}/reference-{:016x}/batch-{:03}.bin", folder, scene.key(), b);
        auto values = read_table(path, key, count);
        if (!values) {
            RenderSettings batch = settings;
            batch.samples = reference_batch;
            batch.seed = key;
            TradeResult times;
            values =
                values_of(scene.render(batch, {}, times, [&](double done) { return progress((b + done) / batches); }));
            if (!write_table(path, key, *values))
                throw Error(ExitCode::render_failed, path, "cannot be written (the disk may be full)");
        }
        for (size_t i = 0; i < count; ++i) halves[b % 2][i] += (*values)[i];
    }
    progress(1);
    std::vector<double> all = halves[0];
    for (size_t i = 0; i < count; ++i) all[i] += halves[1][i];

    TradeReference reference;
    reference.samples = batches * reference_batch;
    for (size_t layer = 0; layer < layers; ++layer) {
        const Image<Rgb> mean = image_of(all, 1.0 / batches, width, height, layer);
        const Image<Rgb> a = image_of(halves[0], 2.0 / batches, width, height, layer);
        const Image<Rgb> b = image_of(halves[1], 2.0 / batches, width, height, layer);
        reference.error = std::max(reference.error, error_of_mean(a, b));
        (layer == 0 ? reference.layers.background : reference.layers.rainy.emplace()) = mean;
    }
    return reference;
}

}  // namespace pluvia
