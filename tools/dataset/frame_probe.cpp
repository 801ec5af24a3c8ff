#include "tools/dataset/frame_probe.h"

#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "tools/dataset/item_files.h"
#include "tools/sample_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

/// Runs of neighbours, which share what caches hold as those of a tile do; one from each of as many equal parts.
std::vector<int64_t> runs_of_pixels(int64_t picture_size, uint64_t seed) {
    constexpr int64_t length = 16, most = 512;
    const int64_t runs = std::clamp<int64_t>(picture_size / length, 1, most);
    std::vector<int64_t> pixels;
    for (int64_t i = 0; i < runs; ++i) {
        const int64_t begin = picture_size * i / runs, end = picture_size * (i + 1) / runs;
        const int64_t room = std::max<int64_t>(0, end - begin - length);
        const int64_t first = begin + int64_t(unit_double(hash_key(seed, uint64_t(i))) * double(room));
        for (int64_t p = first; p < std::min(first + length, end); ++p) pixels.push_back(p);
    }
    return pixels;
}

}  // namespace

TracingCost probe_tracing(const DatasetItem& item, const FrameScene& scene, const std::string& folder) {
    constexpr int few_samples = 4;
    RenderOptions options = item.options;
    options.layers.clear();
    options.target_error.reset();
    const SpentTime start = spent_time();
    FrameSettings settings(options);
    const double pixels = double(settings.camera.width) * settings.camera.height;
    TracingCost cost;
    settings.render.choose_samples = [&](const PixelRenderer& render_pixels) {
        cost.ready = spent_time() - start;
        const std::vector<int64_t> some = runs_of_pixels(int64_t(pixels), options.seed);
        const SpentTime before = spent_time();
        render_pixels(some, few_samples, options.seed);
        const SpentTime traced = spent_time() - before;
        cost.sample = traced * (pixels / double(some.size()) / few_samples);
        cost.samples = options.spp;
        if (item.options.target_error)
            cost.samples = samples_for_error(*item.options.target_error, render_pixels, options.rain, int64_t(pixels),
                                             options.seed);
        return 1;
    };
    try {
        render_frame(scene, options, settings, folder + "/probe.exr", [](double) { return false; });
    } catch (const Error& e) {
        if (e.code() != ExitCode::stopped_early) throw;  // it is told to stop when the pixels above are traced
    }
    return cost;
}

FilesCost probe_files(const DatasetItem& item, const PictureFormat& pictures, const FrameScene& scene,
                      const std::string& folder, const ProgressCallback& progress) {
    constexpr double most_pixels = 1 << 15;
    constexpr int most_samples = 4;  // with one, layers of rain are nothing in most pixels, and files too small
    DatasetItem small = item;
    small.options.spp = std::min(item.options.spp, most_samples);
    small.options.target_error.reset();
    const CameraSettings full = camera_settings(item.options);
    const double pixels = double(full.width) * full.height, shrink = std::min(1.0, std::sqrt(most_pixels / pixels));
    const int width = std::max(1, int(full.width * shrink)), height = std::max(1, int(full.height * shrink));
    small.options.size = fmt::format("{}x{}", width, height);
    const FrameSettings settings(small.options);
    const std::string exr = folder + "/layers.exr";
    std::optional<SpentTime> start;  // of the first pixel
    const RenderedFrame frame = render_frame(scene, small.options, settings, exr, [&](double share) {
        if (!start) start = spent_time();
        return progress(share);
    });
    DisplaySettings display = settings.display;
    display.ev100 = frame.ev100;
    display.text = display_text(frame);
    const ItemFiles files = write_item_files(folder, exr, small, pictures, frame, display);
    const double scale = pixels / (double(width) * height);
    FilesCost cost{(spent_time() - *start) * scale, small.options.spp, 0};
    for (const StoredFile& file : files.files) cost.bytes += scale * double(fs::file_size(file.temporary));
    for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
    return cost;
}

}  // namespace pluvia
