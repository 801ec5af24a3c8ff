#include "tools/dataset/plan_sample.h"

#include "renderer/core/error.h"
#include "tools/dataset/frame_probe.h"
#include "tools/dataset/scene_source.h"
#include "tools/dataset/sequence_exposure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace pluvia {
namespace {

/// Scenes that are read from one file, so that it is built and read once for all of them.
std::vector<std::vector<size_t>> by_file(const DatasetConfig& config, const std::vector<size_t>& scenes) {
    std::map<std::pair<std::string, bool>, std::vector<size_t>> groups;
    for (const size_t s : scenes) groups[{config.scenes[s].source, config.scenes[s].traffic}].push_back(s);
    std::vector<std::vector<size_t>> lists;
    for (auto& [file, group] : groups) lists.push_back(std::move(group));
    return lists;
}

/// The n-th of a scene's frames to measure: cameras in turn, and frames by the golden ratio, which spreads any number
/// of them evenly. items: of the scene, camera by camera.
const DatasetItem& chosen_frame(const DatasetScene& scene, const std::vector<const DatasetItem*>& items, size_t n) {
    const double golden = 0.6180339887498949, place = (double(n) + 0.5) * golden;
    const size_t frames = size_t(scene.frames), cameras = items.size() / frames;
    return *items[n % cameras * frames + size_t((place - std::floor(place)) * double(frames))];
}

}  // namespace

std::map<size_t, FrameCost> measure_frame_costs(const DatasetConfig& config, const std::vector<size_t>& scenes,
                                                const std::string& scratch, Progress& progress) {
    constexpr size_t all_frames = 48, least_frames = 2, most_frames = 8;
    std::map<size_t, FrameCost> costs;
    if (scenes.empty()) return costs;
    const size_t of_scene = std::clamp(all_frames / scenes.size(), least_frames, most_frames);
    const std::vector<DatasetItem> all = dataset_items(config);
    std::vector<std::vector<const DatasetItem*>> items(config.scenes.size());
    for (const DatasetItem& item : all) items[item.scene].push_back(&item);
    double done = 0;
    const double steps = double(scenes.size() * of_scene);
    const auto go_on = [&](double share) {
        if (!progress.update((done + 0.99 * share) / steps))
            throw Error(ExitCode::stopped_early, config.path, "stopped before all scenes were measured");
        return true;
    };
    SceneSource source(config, scratch);
    const std::string folder = scratch + "/frame";
    std::filesystem::create_directories(folder);
    for (const std::vector<size_t>& group : by_file(config, scenes))
        for (size_t n = 0; n < of_scene; ++n)
            for (const size_t s : group) {
                go_on(0);
                DatasetItem item = chosen_frame(config.scenes[s], items[s], n);
                FrameCost& cost = costs[s];
                streak_textures(item.options);           // made once on a machine
                if (n > 0) item.options.layers.clear();  // what they take is known from the first one
                const FrameScene& scene = source.at(s, item.options);
                const TracingCost tracing = probe_tracing(item, scene, folder);
                cost.time = cost.time + (tracing.ready + tracing.sample * tracing.samples) * (1 / double(of_scene));
                if (n == 0) {
                    const FilesCost files = probe_files(item, config.pictures, scene, folder, go_on);
                    const SpentTime load = scene.is_animated ? source.load_time() : SpentTime();
                    cost.time = cost.time + files.time - tracing.sample * files.samples + load;
                    cost.bytes = files.bytes;
                    if (item.is_sequence && item.options.exposure == "auto") {
                        const double frames = config.scenes[s].frames;
                        cost.time =
                            cost.time + (load + tracing.ready) * (std::min(double(metered_frames), frames) / frames);
                    }
                }
                ++done;
            }
    go_on(0);
    return costs;
}

}  // namespace pluvia
