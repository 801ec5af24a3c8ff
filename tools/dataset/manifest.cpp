#include "tools/dataset/manifest.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "tools/dataset/card.h"
#include "tools/dataset/file_hash.h"
#include "tools/dataset/run_log.h"
#include "tools/dataset/work_folder.h"
#include "tools/frame_file.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// 10 and not 10.0: readers format it into names of folders.
Json plain_number(double value) {
    return value == std::floor(value) ? Json(int64_t(value)) : Json(value);
}

std::string json_lines(const std::vector<Json>& objects) {
    std::string text;
    for (const Json& object : objects) text += json_text(object) + "\n";
    return text;
}

/// One object per line.
std::string json_array(const std::vector<Json>& objects) {
    std::string text = "[";
    for (size_t i = 0; i < objects.size(); ++i) text += (i == 0 ? "\n" : ",\n") + json_text(objects[i]);
    return text + "\n]\n";
}

std::string file_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

Json camera_object(const DatasetItem& item, const Record& record) {
    Json j{{"id", item.id()}, {"scene", item.scene_name}, {"sequence", item.camera}, {"frame", item.frame}};
    j["width"] = record.json.at("width"), j["height"] = record.json.at("height");
    j.update(record.json.at("camera"));
    return j;
}

Json provenance(const DatasetConfig& config, const DatasetState& state, const std::string& config_text) {
    Json j;
    j["name"] = config.name, j["license"] = config.license;
    j["program"] = std::string("Pluvia ") + PLUVIA_VERSION;
    j["config_xxh3"] = fmt::format("{:016x}", hash_text(config_text));
    j["frames"] = state.count(), j["pairs"] = state.count() * config.intensity_count();
    for (const auto& [build, frames] : state.builds) j["builds"][build] = frames;
    for (size_t i = 0; i < state.items.size(); ++i)
        if (state.records[i]) j["scenes"][state.items[i].scene_name] = state.records[i]->text("scene_hash");
    return j;
}

/// Copies what another folder has and this one lacks.
void copy_frames(const DatasetConfig& config, const std::string& dataset, const std::string& from) {
    const DatasetState here = read_dataset_state(config, dataset), there = read_dataset_state(config, from);
    const WorkFolder work(dataset, {});
    for (size_t i = 0; i < here.items.size(); ++i) {
        if (here.records[i] || !there.records[i]) continue;
        const auto copy = [&](const std::string& path) {
            const std::string temporary = work.path() + "/copy";
            std::error_code error;
            fs::copy_file(from + "/" + path, temporary, fs::copy_options::overwrite_existing, error);
            if (error)
                throw Error(ExitCode::render_failed, dataset + "/" + path,
                            fmt::format("cannot be copied from {} ({})", from, error.message()));
            move_into_place(temporary, dataset + "/" + path);
        };
        for (const RecordedFile& file : there.records[i]->files()) {
            if (const std::string fault = file_fault(from, file); !fault.empty())
                throw input_error(from + "/" + file.path, fault);
            copy(file.path);
        }
        copy(here.items[i].record_path());
    }
}

}  // namespace

size_t DatasetState::count() const {
    size_t count = 0;
    for (const auto& record : records) count += record.has_value();
    return count;
}

DatasetState read_dataset_state(const DatasetConfig& config, const std::string& dataset) {
    DatasetState state;
    state.items = dataset_items(config);
    state.records.resize(state.items.size());
    parallel_for(int(state.items.size()), [&](int i) {
        const DatasetItem& item = state.items[size_t(i)];
        auto record = read_record(dataset, item);
        if (record && record->text("settings_hash") == settings_hash(item, config.pictures, record->text("scene_hash")))
            state.records[size_t(i)] = std::move(record);
    });
    for (const auto& record : state.records)
        if (record) ++state.builds[record->text("build")];
    return state;
}

std::vector<Json> pair_objects(const Record& record) {
    std::vector<Json> objects;
    const Json& j = record.json;
    for (const Json& pair : j.at("pairs")) {
        Json o;
        o["scene"] = j.at("scene"), o["sequence"] = j.at("sequence");
        o["intensity"] = plain_number(pair.at("intensity"));
        o["wind"] = j.at("wind");
        for (const char* key : {"background", "depth"}) o[key] = j.at(key);
        for (const char* key : {"rain_layer", "rainy_depth", "rainy_image"}) o[key] = pair.at(key);
        o["rain_mask"] = pair.at("rain_mask");
        o["metric_depth"] = j.at("metric_depth");
        for (const char* key : {"transmittance", "inscatter"})
            if (pair.contains(key)) o[key] = pair.at(key);
        if (j.contains("exr")) o["exr"] = j.at("exr");
        o["depth_max_m"] = j.at("depth_max_m");
        o["frame"] = j.at("frame"), o["hour"] = j.at("hour");
        const char* const components[] = {"wind_x", "wind_y", "wind_z"};
        for (size_t c = 0; c < 3; ++c) o[components[c]] = j.at("wind_m_per_s").at(c);
        o["exposure_ev100"] = j.at("exposure_ev100");
        objects.push_back(std::move(o));
    }
    return objects;
}

std::map<std::string, std::string> manifest_files(const DatasetConfig& config, const std::string& dataset,
                                                  const DatasetState& state) {
    std::vector<Json> train, test, cameras, failed;
    const RunHistory history = read_run_history(dataset);
    for (size_t i = 0; i < state.items.size(); ++i) {
        const DatasetItem& item = state.items[i];
        if (!state.records[i]) {
            const auto reason = history.failures.find(item.id());
            failed.push_back(
                {{"id", item.id()}, {"reason", reason == history.failures.end() ? "not made yet" : reason->second}});
            continue;
        }
        for (Json& pair : pair_objects(*state.records[i])) (item.is_test ? test : train).push_back(std::move(pair));
        cameras.push_back(camera_object(item, *state.records[i]));
    }
    const std::string config_text = file_text(config.path);
    std::map<std::string, std::string> files;
    files["trainset.json"] = json_array(train);
    files["testset.json"] = json_array(test);
    files["cameras.jsonl"] = json_lines(cameras);
    files["config.yaml"] = config_text;
    files["provenance.json"] = json_text(provenance(config, state, config_text), 1) + "\n";
    files["README.md"] = dataset_card(config, train.size(), test.size(),
                                      "`trainset.json` and `testset.json` are arrays of flat objects, one per pair; "
                                      "paths begin at this folder.");
    files["croissant.json"] = croissant_metadata(config, files);
    if (!failed.empty()) files["failed.jsonl"] = json_lines(failed);
    return files;
}

size_t merge_dataset(const DatasetConfig& config, const std::string& dataset, bool all_ended,
                     const std::vector<std::string>& from) {
    for (const std::string& folder : from) copy_frames(config, dataset, folder);
    remove_abandoned_work(dataset, all_ended);
    const DatasetState state = read_dataset_state(config, dataset);
    if (state.builds.size() > 1) {
        std::cerr << "pluvia: warning: " << dataset << ": frames come from different builds of the program:\n";
        for (const auto& [build, frames] : state.builds) std::cerr << fmt::format("  {}: {} frames\n", build, frames);
    }
    make_folder_of(dataset + "/README.md");
    const auto files = manifest_files(config, dataset, state);
    if (!files.contains("failed.jsonl")) {
        std::error_code ignored;
        fs::remove(dataset + "/failed.jsonl", ignored);
    }
    for (const auto& [path, text] : files) write_text(dataset + "/" + path, text);
    return state.items.size() - state.count();
}

}  // namespace pluvia
