// Settings of `pluvia augment` as the command line gives them. Those of rain, lens and light are RenderOptions', with
// the same names and defaults.
#pragma once

#include "tools/augment/depth_input.h"
#include "tools/dataset/item.h"
#include "tools/render_options.h"

#include <optional>
#include <string>

namespace pluvia {

struct AugmentOptions {
    RenderOptions render;
    std::string input, dataset = "folder";
    std::string images, depth, labels;  // patterns, from the input's folder; empty: as the data set has them
    std::string depth_encoding;         // empty: as the data set has it
    std::string calibration;            // JSON file
    std::optional<double> fov;          // degrees across the picture
    std::optional<double> baseline;     // metres between the cameras of a stereo pair
    std::string curve = "srgb";
    bool delta_only = false, exr = false, dry_run = false;
    std::string shard = "1/1";

    AugmentOptions() { render.spp = 16, render.veil = "table"; }
};

void add_augment_options(CLI::App& command, AugmentOptions& options);

/// Options that decide over the files, with their values, as recorded.
nlohmann::ordered_json to_json(const AugmentOptions& options);

}  // namespace pluvia
