// `pluvia dataset run`: makes the frames of a dataset that are not done, all or a shard of them.
#pragma once

#include "tools/dataset/item.h"
#include "tools/progress.h"

#include <string>

namespace pluvia {

struct RunSettings {
    Shard shard;
    std::string only;  // a file of JSON lines with "id", as failed.jsonl: no other frames; empty: all
    Progress::Style progress = Progress::Style::bar;
};

struct RunResult {
    size_t wanted = 0, already_done = 0, made = 0, failed = 0;
};

/// Frames that are done are verified and left alone, others made. A frame that fails is noted and the rest goes on.
/// Throws Error: stopped_early after a signal, with what is finished kept; others when the run cannot go on.
RunResult run_dataset(const DatasetConfig& config, const std::string& dataset, const RunSettings& settings);

}  // namespace pluvia
