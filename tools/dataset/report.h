// `pluvia dataset report`: a dataset to look at, as one HTML file that needs nothing beside it.
#pragma once

#include "tools/dataset/config.h"

#include <string>

namespace pluvia {

struct ReportSettings {
    int frames = 120;  // whose pictures are shown, spread evenly; numbers are of all
};

/// Writes dataset/report.html: a contact sheet with clean and rainy picture under a slider, filters by scene, split,
/// hour and intensity, and histograms of depth, coverage, hour and brightness that follow the filters. Returns the
/// path.
std::string write_report(const DatasetConfig& config, const std::string& dataset, const ReportSettings& settings);

}  // namespace pluvia
