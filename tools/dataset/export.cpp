#include "tools/dataset/export.h"

#include "renderer/core/error.h"
#include "renderer/transport/layers.h"
#include "tools/dataset/card.h"
#include "tools/dataset/manifest.h"
#include "tools/dataset/tar_file.h"
#include "tools/dataset/work_folder.h"
#include "tools/frame_file.h"
#include "tools/labels/label_export.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Keys of a pair that name a picture, with what other layouts call them.
constexpr std::pair<const char*, const char*> pictures[] = {
    {"rainy_image", "rainy"},        {"background", "background"}, {"depth", "depth"},
    {"rain_layer", "rain_layer"},    {"rain_mask", "rain_mask"},   {"rainy_depth", "rainy_depth"},
    {"metric_depth", "metric_depth"}};

void place(const std::string& from, const std::string& to) {
    make_folder_of(to);
    std::error_code error;
    if (fs::exists(to, error)) return;  // pairs of a frame share its background
    fs::create_hard_link(from, to, error);
    if (error) fs::copy_file(from, to, error);
    if (error) throw Error(ExitCode::render_failed, to, fmt::format("cannot be written ({})", error.message()));
}

void export_hri(const DatasetState& state, const std::string& dataset, const std::string& to) {
    std::string lists[2] = {"[", "["};
    for (size_t i = 0; i < state.items.size(); ++i)
        for (const Json& pair : pair_objects(*state.records[i])) {
            Json flat;
            for (const char* key : hri_keys) flat[key] = pair.at(key);
            for (const char* key : {"background", "depth", "rain_layer", "rainy_depth", "rainy_image"})
                place(dataset + "/" + flat[key].get<std::string>(), to + "/" + flat[key].get<std::string>());
            std::string& list = lists[state.items[i].is_test];
            list += (list.size() == 1 ? "\n" : ",\n") + json_text(flat);
        }
    write_text(to + "/trainset.json", lists[0] + "\n]\n");
    write_text(to + "/testset.json", lists[1] + "\n]\n");
}

void export_hf(const DatasetConfig& config, const DatasetState& state, const std::string& dataset,
               const std::string& to) {
    std::string lines[2];
    size_t counts[2] = {0, 0};
    for (size_t i = 0; i < state.items.size(); ++i)
        for (const Json& pair : pair_objects(*state.records[i])) {
            const bool is_test = state.items[i].is_test;
            Json line;
            for (const auto& [key, name] : pictures) {
                const std::string path = pair.at(key);
                // The first one is what the hub shows.
                line[std::string(key) == "rainy_image" ? "file_name" : std::string(name) + "_file_name"] = path;
                place(dataset + "/" + path, fmt::format("{}/{}/{}", to, state.items[i].split(), path));
            }
            for (const auto& [key, value] : pair.items())
                if (!value.is_string() || key == "scene" || key == "sequence" || key == "wind") line[key] = value;
            lines[is_test] += json_text(line) + "\n";
            ++counts[is_test];
        }
    for (const bool is_test : {false, true})
        if (counts[is_test] > 0)
            write_text(fmt::format("{}/{}/metadata.jsonl", to, is_test ? "test" : "train"), lines[is_test]);
    write_text(to + "/README.md",
               dataset_card(config, counts[0], counts[1],
                            "`train/metadata.jsonl` and `test/metadata.jsonl` have one line per pair; paths begin at "
                            "their folders. `file_name` is the rainy picture, KEY`_file_name` the picture of another "
                            "key."));
}

/// Tar files of at most about half a gigabyte.
class ShardedTar {
public:
    explicit ShardedTar(std::string stem) : stem_(std::move(stem)) {}

    TarWriter& for_sample(uint64_t bytes) {
        if (tar_ && bytes_ + bytes > most_bytes) finish();
        if (!tar_) {
            tar_ = std::make_unique<TarWriter>(fmt::format("{}-{:06}.tar", stem_, number_++));
            bytes_ = 0;
        }
        bytes_ += bytes;
        return *tar_;
    }
    void finish() {
        if (tar_) tar_->finish();
        tar_.reset();
    }

private:
    static constexpr uint64_t most_bytes = uint64_t(1) << 29;
    std::string stem_;
    std::unique_ptr<TarWriter> tar_;
    uint64_t bytes_ = 0;
    int number_ = 0;
};

void export_webdataset(const DatasetState& state, const std::string& dataset, const std::string& to) {
    ShardedTar tars[2] = {ShardedTar(to + "/train"), ShardedTar(to + "/test")};
    for (size_t i = 0; i < state.items.size(); ++i) {
        const Record& record = *state.records[i];
        uint64_t bytes = 0;
        for (const RecordedFile& file : record.files()) bytes += file.bytes;
        TarWriter& tar = tars[state.items[i].is_test].for_sample(bytes);
        // Up to its first point the name is the sample's key.
        std::string key = state.items[i].id();
        std::replace(key.begin(), key.end(), '/', '_');
        std::replace(key.begin(), key.end(), '.', '-');
        Json text = Json::array();
        bool is_first = true;
        for (const Json& pair : pair_objects(record)) {
            const std::string label = intensity_label(pair.at("intensity"));
            for (const auto& [name, part] : pictures) {
                const std::string path = pair.at(name);
                const bool is_clean = path.starts_with("clean/");
                if (is_clean && !is_first) continue;
                const std::string extension = path.substr(path.rfind('.'));
                tar.add_file(key + "." + part + (is_clean ? "" : "_" + label) + extension, dataset + "/" + path);
            }
            Json numbers;
            for (const auto& [name, value] : pair.items())
                if (!value.is_string() || name == "scene" || name == "sequence" || name == "wind")
                    numbers[name] = value;
            text.push_back(numbers);
            is_first = false;
        }
        tar.add(key + ".json", json_text(text));
    }
    for (ShardedTar& tar : tars) tar.finish();
}

}  // namespace

const std::vector<std::string>& export_formats() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all = {"hri", "hf", "webdataset"};
        all.insert(all.end(), label_formats().begin(), label_formats().end());
        return all;
    }();
    return names;
}

size_t export_dataset(const DatasetConfig& config, const std::string& dataset, const std::string& format,
                      const std::string& to) {
    const auto& names = export_formats();
    if (std::find(names.begin(), names.end(), format) == names.end())
        throw usage_error("--format",
                          fmt::format("is not valid (got \"{}\", expected {})", format, fmt::join(names, ", ")));
    std::error_code ignored;
    if (fs::exists(to, ignored) && !fs::is_empty(to, ignored))
        throw usage_error(to, "is not empty (expected a new folder for the export)");
    const DatasetState state = read_dataset_state(config, dataset);
    if (const size_t missing = state.items.size() - state.count(); missing > 0)
        throw Error(
            ExitCode::check_failed, dataset,
            fmt::format("{} of {} frames are missing; pluvia dataset run makes them", missing, state.items.size()));
    if (format != "hri" && format != "hf" && format != "webdataset") {
        std::vector<LabelSource> frames;
        for (const DatasetItem& item : state.items) frames.push_back(item.labels(dataset));
        export_labels(frames, format, to);
        return frames.size();
    }
    make_folder_of(to + "/README.md");
    if (format == "hri") export_hri(state, dataset, to);
    if (format == "hf") export_hf(config, state, dataset, to);
    if (format == "webdataset") export_webdataset(state, dataset, to);
    return state.items.size() * config.intensity_count();
}

}  // namespace pluvia
