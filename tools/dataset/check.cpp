#include "tools/dataset/check.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "tools/dataset/item_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::vector<std::string> faults_of(const std::string& dataset, const DatasetItem& item,
                                   const std::optional<Record>& record) {
    std::error_code ignored;
    if (!record) {
        const bool exists = fs::exists(dataset + "/" + item.record_path(), ignored);
        return {item.record_path() + (exists ? ": is damaged or of other settings" : ": is missing")};
    }
    std::vector<std::string> faults;
    for (const RecordedFile& file : record->files())
        if (const std::string fault = file_fault(dataset, file); !fault.empty())
            faults.push_back(file.path + ": " + fault);
    if (!faults.empty()) return faults;
    try {
        return item_faults(dataset, item, *record);
    } catch (const Error& e) {
        return {e.what()};
    } catch (const Json::exception& e) {
        return {item.record_path() + ": " + e.what()};
    }
}

/// Lists must be what the records give, byte for byte.
void check_lists(const DatasetConfig& config, const std::string& dataset, const DatasetState& state,
                 CheckReport& report) {
    for (const auto& [path, expected] : manifest_files(config, dataset, state)) {
        std::ifstream file(dataset + "/" + path, std::ios::binary);
        std::ostringstream text;
        text << file.rdbuf();
        if (!file)
            report.faults.push_back(path + ": is missing; pluvia dataset merge writes it");
        else if (text.str() != expected)
            report.faults.push_back(path + ": is not what the records give; pluvia dataset merge writes it anew");
    }
}

/// As a reader of the lists sees it, whatever the configuration says.
void check_split(const std::string& dataset, CheckReport& report) {
    std::map<std::string, std::string> list_of;
    for (const char* name : {"trainset.json", "testset.json"}) {
        std::ifstream file(dataset + "/" + name);
        const Json list = Json::parse(file, nullptr, false);
        if (!list.is_array()) {
            report.faults.push_back(std::string(name) + ": is no JSON array");
            continue;
        }
        std::set<std::string> seen;
        for (const Json& pair : list) {
            for (const char* key : hri_keys)
                if (!pair.contains(key)) {
                    report.faults.push_back(fmt::format("{}: a pair has no key \"{}\"", name, key));
                    return;
                }
            const std::string camera = pair["scene"].get<std::string>() + "/" + pair["sequence"].get<std::string>();
            if (!seen.insert(camera).second) continue;
            const auto [before, is_new] = list_of.emplace(camera, name);
            if (!is_new)
                report.faults.push_back(fmt::format("{}: the camera {} is in {} too", name, camera, before->second));
        }
    }
}

void check_strays(const std::string& dataset, const DatasetState& state, CheckReport& report) {
    std::set<std::string> known;
    for (size_t i = 0; i < state.items.size(); ++i) {
        known.insert(state.items[i].record_path());
        if (!state.records[i]) continue;
        for (const RecordedFile& file : state.records[i]->files()) known.insert(file.path);
    }
    for (const char* folder : {"clean", "rainy", "exr", "records"}) {
        std::error_code error;
        for (const auto& entry : fs::recursive_directory_iterator(dataset + "/" + folder, error)) {
            const std::string path = fs::relative(entry.path(), dataset).string();
            if (entry.is_regular_file() && !known.contains(path))
                report.faults.push_back(path + ": belongs to no frame of the configuration");
        }
    }
}

}  // namespace

CheckReport check_dataset(const DatasetConfig& config, const std::string& dataset) {
    CheckReport report;
    const DatasetState state = read_dataset_state(config, dataset);
    report.frames = state.items.size();
    report.missing = state.items.size() - state.count();
    std::vector<std::vector<std::string>> faults(state.items.size());
    parallel_for(int(state.items.size()), [&](int i) {
        faults[size_t(i)] = faults_of(dataset, state.items[size_t(i)], state.records[size_t(i)]);
    });
    for (const auto& list : faults) report.faults.insert(report.faults.end(), list.begin(), list.end());
    std::map<std::string, std::string> hashes;
    for (size_t i = 0; i < state.items.size(); ++i) {
        if (!state.records[i]) continue;
        report.files += state.records[i]->files().size();
        const auto [entry, is_new] = hashes.emplace(state.items[i].scene_name, state.records[i]->text("scene_hash"));
        if (!is_new && entry->second != state.records[i]->text("scene_hash"))
            report.faults.push_back(state.items[i].record_path() + ": the scene is another than that of other frames");
    }
    check_lists(config, dataset, state, report);
    check_split(dataset, report);
    check_strays(dataset, state, report);
    if (state.builds.size() > 1)
        report.warnings.push_back(fmt::format("frames come from {} builds of the program", state.builds.size()));
    for (const DatasetScene& scene : config.scenes)
        if (scene.options.view != "srgb")
            report.warnings.push_back(
                fmt::format("{}: sums of the layers are not checked in the pictures: the view {} cannot be undone",
                            scene.name, scene.options.view));
    return report;
}

}  // namespace pluvia
