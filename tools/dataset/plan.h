// `pluvia dataset plan`: what a dataset will hold, how long it takes and how much disk, before anything is made.
#pragma once

#include "tools/dataset/item.h"

#include <nlohmann/json.hpp>

#include <string>

namespace pluvia {

/// Counts by scene and split. sample: also renders two frames of each scene that exists, as configured but with one
/// sample per pixel and at most two million pixels, and tells time and disk from them; half a minute a scene at 2048 x
/// 1024. dataset: where frames that are there already tell both better; may not exist.
nlohmann::ordered_json dataset_plan(const DatasetConfig& config, const std::string& dataset, bool sample);
std::string plan_text(const nlohmann::ordered_json& plan);

/// `pluvia dataset status`: how many frames of each scene are there, and when the rest will be.
nlohmann::ordered_json dataset_status(const DatasetConfig& config, const std::string& dataset);
std::string status_text(const nlohmann::ordered_json& status);

}  // namespace pluvia
