#include "tools/dataset/plan_sample.h"

#include "tools/dataset/item_files.h"
#include "tools/dataset/scene_source.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>

namespace pluvia {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

FrameCost measure_frame_cost(const DatasetConfig& config, size_t scene, const std::string& scratch) {
    constexpr double most_pixels = 1 << 21;
    std::vector<DatasetItem> items;
    for (DatasetItem& item : dataset_items(config))
        if (item.scene == scene) items.push_back(std::move(item));
    const size_t frames = size_t(config.scenes[scene].frames);
    SceneSource source(config, scratch);
    FrameCost cost;
    // The first camera's first frame and the one half a sequence later: night and day where hours are equal steps.
    for (const size_t index : {size_t(0), frames / 2}) {
        DatasetItem item = items[index];
        const int samples = item.options.spp;
        item.options.spp = 1;
        const CameraSettings full = camera_settings(item.options);
        const double pixels = double(full.width) * full.height, shrink = std::min(1.0, std::sqrt(most_pixels / pixels));
        item.options.size =
            fmt::format("{}x{}", std::max(1, int(full.width * shrink)), std::max(1, int(full.height * shrink)));
        const auto before = Clock::now();
        const FrameScene& loaded = source.at(scene, item.options);
        // A scene that moves is read anew for every frame. The first time it is built, too, which happens once a run.
        if (index > 0 && loaded.is_animated) cost.seconds += seconds_since(before);
        const std::string folder = scratch + "/sample";
        fs::create_directories(folder);
        const auto start = Clock::now();
        const FrameSettings settings(item.options);
        const std::string exr = folder + "/layers.exr";
        const RenderedFrame frame = render_frame(loaded, item.options, settings, exr, [](double) { return true; });
        DisplaySettings display = settings.display;
        display.ev100 = frame.ev100;
        display.text = display_text(frame);
        const ItemFiles files = write_item_files(folder, exr, item, config.pictures, frame, display);
        const double traced = frame.report.render_seconds, other = seconds_since(start) - traced;
        const double scale = 1 / (shrink * shrink);
        cost.seconds += 0.5 * (other * scale + traced * scale * samples);
        for (const StoredFile& file : files.files) cost.bytes += 0.5 * scale * double(fs::file_size(file.temporary));
        fs::remove_all(folder);
    }
    return cost;
}

}  // namespace pluvia
