// `pluvia dataset figure`: what hour, intensity and wind do to one view, as a grid of pictures.
#pragma once

#include "tools/dataset/config.h"
#include "tools/progress.h"

#include <string>
#include <vector>

namespace pluvia {

struct FigureSettings {
    std::string scene, camera;  // empty: the first
    std::vector<double> hours = {8, 12, 20};
    std::vector<double> winds = {-4, 0, 4};  // m/s along X
};

/// Renders the configuration's view once per hour and wind, with all its intensities, and writes folder/figure.png:
/// one row an hour; the clean picture, then for each wind its intensities in rising order. Cells are at most 512 pixels
/// wide. Returns the path.
std::string write_figure(const DatasetConfig& config, const std::string& folder, const FigureSettings& settings,
                         Progress::Style progress);

}  // namespace pluvia
