// Everything about a dataset that is not one frame's: lists of training and test pairs, cameras, provenance, card and
// metadata. Made anew from the records in the order of the configuration, so that it does not matter who rendered what.
#pragma once

#include "tools/dataset/record.h"

#include <map>
#include <string>
#include <vector>

namespace pluvia {

struct DatasetState {
    std::vector<DatasetItem> items;
    std::vector<std::optional<Record>> records;  // empty: not made, or with other settings
    std::map<std::string, size_t> builds;        // frames by build

    size_t count() const;  // of records
};
/// Records only; files are not looked at.
DatasetState read_dataset_state(const DatasetConfig& config, const std::string& dataset);

/// Keys of HRI's lists, which every pair has; then our own.
constexpr const char* hri_keys[] = {"scene", "sequence",   "intensity",   "wind",       "background",
                                    "depth", "rain_layer", "rainy_depth", "rainy_image"};

/// The pairs of a frame as flat objects.
std::vector<nlohmann::ordered_json> pair_objects(const Record& record);

/// Contents by path, from the dataset's folder: trainset.json, testset.json, cameras.jsonl, provenance.json,
/// config.yaml, README.md, croissant.json; and failed.jsonl with the frames that are missing, if any are.
std::map<std::string, std::string> manifest_files(const DatasetConfig& config, const std::string& dataset,
                                                  const DatasetState& state);

/// Writes them, and removes what killed runs left; all_ended: nobody is at work, so of other machines too. Warns on
/// stderr when records come from several builds. Returns the number of missing frames. from: other folders whose frames
/// are copied first where they are missing here.
size_t merge_dataset(const DatasetConfig& config, const std::string& dataset, bool all_ended,
                     const std::vector<std::string>& from = {});

}  // namespace pluvia
