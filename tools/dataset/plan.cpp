#include "tools/dataset/plan.h"

#include "renderer/core/error.h"
#include "scenes/builders.h"
#include "tools/dataset/manifest.h"
#include "tools/dataset/plan_sample.h"
#include "tools/dataset/run_log.h"
#include "tools/dataset/scene_source.h"
#include "tools/dataset/work_folder.h"

#include <fmt/format.h>

#include <unistd.h>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr double night_hours = 10;

double mean(const std::vector<double>& values) {
    return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// A folder for one measurement.
class Scratch {
public:
    Scratch() : path_(fs::temp_directory_path() / fmt::format("pluvia_plan_{}", getpid())) {
        fs::create_directories(path_);
    }
    ~Scratch() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    std::string path() const { return path_.string(); }

private:
    fs::path path_;
};

/// Bytes of frames that are there, by scene.
std::map<std::string, std::vector<double>> recorded_bytes(const DatasetState& state) {
    std::map<std::string, std::vector<double>> bytes;
    for (size_t i = 0; i < state.items.size(); ++i) {
        if (!state.records[i]) continue;
        double sum = 0;
        for (const RecordedFile& file : state.records[i]->files()) sum += double(file.bytes);
        bytes[state.items[i].scene_name].push_back(sum);
    }
    return bytes;
}

bool exists(const DatasetConfig& config, size_t scene) {
    try {
        require_scene(config, scene);
        return true;
    } catch (const Error&) {
        return false;  // counts do not need it
    }
}

std::string hours_text(double seconds) {
    return seconds < 90     ? fmt::format("{:.0f} s", seconds)
           : seconds < 5400 ? fmt::format("{:.0f} min", seconds / 60)
                            : fmt::format("{:.1f} h", seconds / 3600);
}

std::string bytes_text(double bytes) {
    return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

}  // namespace

Json dataset_plan(const DatasetConfig& config, const std::string& dataset, Progress* progress) {
    const size_t intensities = config.intensity_count();
    Json plan{{"name", config.name}, {"scenes", Json::array()}};
    const auto recorded = recorded_bytes(read_dataset_state(config, dataset));
    const RunHistory history = read_run_history(dataset);
    std::map<size_t, FrameCost> costs;
    std::vector<size_t> to_measure;
    for (size_t s = 0; s < config.scenes.size(); ++s) {
        const std::string& name = config.scenes[s].name;
        const auto seconds = history.seconds.find(name);
        const auto bytes = recorded.find(name);
        if (seconds != history.seconds.end() && bytes != recorded.end())
            costs[s] = {{mean(seconds->second), 0}, mean(bytes->second)};
        else if (exists(config, s))
            to_measure.push_back(s);
    }
    if (progress) costs.merge(measure_frame_costs(config, to_measure, Scratch().path(), *progress));

    size_t frames = 0, train = 0, test = 0, known = 0;
    bool all_measured = true;  // now, with processor time
    SpentTime time;
    double bytes = 0;
    for (size_t s = 0; s < config.scenes.size(); ++s) {
        const DatasetScene& scene = config.scenes[s];
        const size_t per_camera = size_t(scene.frames),
                     of_scene = per_camera * (scene.train.size() + scene.test.size());
        Json j{{"scene", scene.name},
               {"frames", of_scene},
               {"train_pairs", per_camera * scene.train.size() * intensities},
               {"test_pairs", per_camera * scene.test.size() * intensities}};
        frames += of_scene, train += j["train_pairs"].get<size_t>(), test += j["test_pairs"].get<size_t>();
        if (progress) j["exists"] = exists(config, s);
        if (const auto found = costs.find(s); found != costs.end()) {
            const FrameCost& cost = found->second;
            j["seconds_per_frame"] = cost.time.wall;
            if (cost.time.processor > 0)
                j["processor_seconds_per_frame"] = cost.time.processor;
            else
                all_measured = false;
            j["bytes_per_frame"] = cost.bytes;
            time = time + cost.time * double(of_scene), bytes += cost.bytes * double(of_scene);
            known += of_scene;
        }
        plan["scenes"].push_back(j);
    }
    plan["frames"] = frames, plan["pairs"] = train + test;
    plan["train_pairs"] = train, plan["test_pairs"] = test;
    if (known > 0) {
        // Scenes that are not there are taken to cost what the others do.
        const double all = double(frames) / double(known), hours = time.wall * all / 3600;
        plan["hours"] = hours;
        if (all_measured) plan["processor_hours"] = time.processor * all / 3600;
        plan["machines_for_a_night"] = std::max(1, int(std::ceil(hours / night_hours)));
        plan["bytes"] = bytes * all;
    }
    return plan;
}

std::string plan_text(const Json& plan) {
    std::string text = fmt::format("{:<18}{:>8}{:>13}{:>12}{:>14}{:>12}\n", "scene", "frames", "train pairs",
                                   "test pairs", "a frame", "disk");
    for (const Json& j : plan["scenes"]) {
        const bool known = j.contains("seconds_per_frame");
        text += fmt::format("{:<18}{:>8}{:>13}{:>12}{:>14}{:>12}{}\n", j["scene"].get<std::string>(),
                            j["frames"].get<size_t>(), j["train_pairs"].get<size_t>(), j["test_pairs"].get<size_t>(),
                            known ? hours_text(j["seconds_per_frame"]) : "-",
                            known ? bytes_text(j["bytes_per_frame"].get<double>() * double(j["frames"])) : "-",
                            j.contains("exists") && !j["exists"].get<bool>() ? "  (no such scene here)" : "");
    }
    text += fmt::format("{:<18}{:>8}{:>13}{:>12}\n", "all", plan["frames"].get<size_t>(),
                        plan["train_pairs"].get<size_t>(), plan["test_pairs"].get<size_t>());
    if (plan.contains("processor_hours"))
        text += fmt::format("{} of one core; ", hours_text(plan["processor_hours"].get<double>() * 3600));
    if (plan.contains("hours"))
        text += fmt::format("{} on this machine alone; {} such machine{} for a night of {:g} h; up to {} of disk\n",
                            hours_text(plan["hours"].get<double>() * 3600), plan["machines_for_a_night"].get<int>(),
                            plan["machines_for_a_night"].get<int>() == 1 ? "" : "s", night_hours,
                            bytes_text(plan["bytes"]));
    return text;
}

Json dataset_status(const DatasetConfig& config, const std::string& dataset) {
    const DatasetState state = read_dataset_state(config, dataset);
    const RunHistory history = read_run_history(dataset);
    const int runs = count_work_folders(dataset);
    Json status{{"name", config.name}, {"runs_at_work", runs}, {"scenes", Json::array()}};
    size_t all = 0, all_done = 0;
    double all_left = 0;
    for (const DatasetScene& scene : config.scenes) {
        size_t frames = 0, done = 0, failed = 0;
        for (size_t i = 0; i < state.items.size(); ++i) {
            if (state.items[i].scene_name != scene.name) continue;
            ++frames;
            done += state.records[i].has_value();
            failed += !state.records[i] && history.failures.contains(state.items[i].id());
        }
        Json j{{"scene", scene.name}, {"frames", frames}, {"done", done}, {"failed", failed}};
        if (const auto found = history.seconds.find(scene.name); found != history.seconds.end()) {
            const double left = mean(found->second) * double(frames - done) / std::max(1, runs);
            j["seconds_per_frame"] = mean(found->second), j["left_s"] = left;
            all_left += left;
        }
        all += frames, all_done += done;
        status["scenes"].push_back(j);
    }
    status["frames"] = all, status["done"] = all_done;
    if (!history.seconds.empty()) status["left_s"] = all_left;
    return status;
}

std::string status_text(const Json& status) {
    std::string text =
        fmt::format("{:<18}{:>8}{:>8}{:>8}{:>12}{:>12}\n", "scene", "frames", "done", "failed", "a frame", "left");
    for (const Json& j : status["scenes"]) {
        const bool known = j.contains("left_s");
        text += fmt::format("{:<18}{:>8}{:>8}{:>8}{:>12}{:>12}\n", j["scene"].get<std::string>(),
                            j["frames"].get<size_t>(), j["done"].get<size_t>(), j["failed"].get<size_t>(),
                            known ? hours_text(j["seconds_per_frame"]) : "-", known ? hours_text(j["left_s"]) : "-");
    }
    const int runs = status["runs_at_work"];
    return text + fmt::format("{} of {} frames are done; {} run{} at work\n", status["done"].get<size_t>(),
                              status["frames"].get<size_t>(), runs, runs == 1 ? "" : "s");
}

}  // namespace pluvia
