// `pluvia dataset plan`: what a dataset will hold, how long it takes and how much disk, before anything is made.
#pragma once

#include "tools/dataset/item.h"
#include "tools/progress.h"

#include <nlohmann/json.hpp>

#include <string>

namespace pluvia {

/// Counts by scene and split. progress: null, or measures what frames of the scenes that exist take (plan_sample.h) and
/// tells time and disk from that; throws Error (stopped_early) when it is interrupted. dataset: where frames that are
/// there already tell both better; may not exist.
nlohmann::ordered_json dataset_plan(const DatasetConfig& config, const std::string& dataset, Progress* progress);
std::string plan_text(const nlohmann::ordered_json& plan);

/// `pluvia dataset status`: how many frames of each scene are there, and when the rest will be.
nlohmann::ordered_json dataset_status(const DatasetConfig& config, const std::string& dataset);
std::string status_text(const nlohmann::ordered_json& status);

}  // namespace pluvia
