#include "tools/dataset/run.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "tools/dataset/item_render.h"
#include "tools/dataset/run_log.h"
#include "tools/dataset/scene_source.h"
#include "tools/dataset/sequence_exposure.h"
#include "tools/dataset/work_folder.h"

#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

namespace pluvia {
namespace {

std::vector<DatasetItem> only_listed(const std::vector<DatasetItem>& items, const std::string& path) {
    std::ifstream file(path);
    if (!file) throw input_error(path, fmt::format("cannot be opened ({})", std::strerror(errno)));
    std::set<std::string> ids;
    int number = 0;
    for (std::string line; std::getline(file, line);) {
        ++number;
        if (line.empty()) continue;
        const auto j = nlohmann::json::parse(line, nullptr, false);
        if (!j.is_object() || !j.contains("id") || !j["id"].is_string())
            throw input_error(fmt::format("{}:{}", path, number), "is no JSON object with an \"id\"");
        ids.insert(j["id"].get<std::string>());
    }
    std::vector<DatasetItem> listed;
    for (const DatasetItem& item : items)
        if (ids.erase(item.id()) > 0) listed.push_back(item);
    if (!ids.empty())
        throw input_error(path, fmt::format("names \"{}\", which the dataset does not have", *ids.begin()));
    return listed;
}

}  // namespace

RunResult run_dataset(const DatasetConfig& config, const std::string& dataset, const RunSettings& settings) {
    std::vector<DatasetItem> items = dataset_items(config);
    if (!settings.only.empty()) items = only_listed(items, settings.only);
    items = shard_items(items, settings.shard);
    RunResult result;
    result.wanted = items.size();

    // What is wrong with a scene is said before hours of work on others.
    std::set<size_t> scenes;
    for (const DatasetItem& item : items) scenes.insert(item.scene);
    for (const size_t scene : scenes) require_scene(config, scene);
    const WorkFolder work(dataset, settings.shard);
    SceneSource source(config, work.path());
    std::map<size_t, std::string> hashes;
    for (const size_t scene : scenes) hashes[scene] = source.hash(scene);

    std::vector<char> done(items.size(), 0);
    parallel_for(int(items.size()), [&](int i) {
        const DatasetItem& item = items[size_t(i)];
        done[size_t(i)] = is_done(dataset, item, settings_hash(item, config.pictures, hashes.at(item.scene)));
    });
    result.already_done = size_t(std::count(done.begin(), done.end(), 1));
    const size_t to_make = items.size() - result.already_done;
    std::cerr << fmt::format("pluvia: {} of {} frames are done, {} to make\n", result.already_done, items.size(),
                             to_make);

    SequenceExposure exposure(dataset_items(config), work.path());
    RunLog log(dataset, settings.shard);
    Progress progress(settings.progress, config.name);
    size_t handled = 0;
    for (size_t i = 0; i < items.size(); ++i) {
        if (done[i]) continue;
        const DatasetItem& item = items[i];
        const std::string scratch = work.path() + "/frame";
        std::filesystem::create_directory(scratch);
        const auto start = std::chrono::steady_clock::now();
        try {
            const std::optional<double> ev100 = exposure.of(item, source);
            make_item(dataset, scratch, item, config.pictures, source.at(item.scene, item.options),
                      hashes.at(item.scene), ev100,
                      [&](double share) { return progress.update((double(handled) + share) / double(to_make)); });
            ++result.made;
            log.add_done(item.id(), item.scene_name,
                         std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        } catch (const Error& e) {
            if (e.code() == ExitCode::stopped_early)
                throw Error(ExitCode::stopped_early, dataset,
                            fmt::format("stopped; {} of {} frames are done, run again to go on",
                                        result.already_done + result.made, items.size()));
            // Of a scene's file at another time, or of the frame's own values; the next one may be well.
            if (e.code() != ExitCode::some_failed && e.code() != ExitCode::input) throw;
            ++result.failed;
            log.add_failed(item.id(), item.scene_name, e.what());
            std::cerr << "pluvia: error: " << item.id() << ": " << e.what() << "\n";
        }
        std::filesystem::remove_all(scratch);
        ++handled;
    }
    return result;
}

}  // namespace pluvia
