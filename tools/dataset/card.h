// What a dataset says about itself: README.md as a dataset card for readers and hubs, and Croissant metadata for
// programs (Croissant format 1.0, MLCommons 2024).
#pragma once

#include "tools/dataset/config.h"

#include <map>
#include <string>

namespace pluvia {

/// train, test: numbers of pairs that are there. lists: a sentence on where the keys are that the card explains.
std::string dataset_card(const DatasetConfig& config, size_t train, size_t test, const std::string& lists);

/// files: contents by path; those that the metadata point to are hashed.
std::string croissant_metadata(const DatasetConfig& config, const std::map<std::string, std::string>& files);

}  // namespace pluvia
