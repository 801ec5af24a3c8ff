// `pluvia inspect --rain`: rain in numbers, the closed forms beside what a camera draws of it.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pluvia {

struct RainInspectionOptions {
    std::vector<double> intensities;  // mm/h
    std::string size = "2048x1024";   // pixels
    double focal_length = 35;         // mm on a sensor 36 mm wide
    double streak_width = 0.25;       // pixels
    uint64_t seed = 0;
};

void add_rain_inspection_options(CLI::App& command, RainInspectionOptions& options);

/// One object per intensity, keyed by it. Throws Error (usage) for settings out of range.
nlohmann::ordered_json inspect_rain(const RainInspectionOptions& options);

}  // namespace pluvia
