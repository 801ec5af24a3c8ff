// Pictures or folders of pictures against each other: which belong together, and all numbers of each pair.
// Printed by compare_report.h, shown by html_report.h.
#pragma once

#include "tools/validate/compared_picture.h"
#include "tools/validate/flip.h"
#include "tools/validate/metric_list.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pluvia {

struct PictureRegion {
    std::string name;
    int x = 0, y = 0, width = 0, height = 0;  // pixels from the upper left corner
};
/// "road=0,300,1024,212". Throws Error (usage).
PictureRegion parse_region(const std::string& text);

struct CompareSettings {
    ReadSettings read;
    std::vector<std::string> layers = {""};  // of EXR files; "A:B": named differently in the two
    std::vector<PictureRegion> regions;
    std::optional<double> white;  // light that displays as white; none: 98th percentile of B's luminance
    double pixels_per_degree = flip_pixels_per_degree;
    bool flip = true;
};

struct RegionMetrics {
    std::string name;  // "all" for the whole picture
    Metrics metrics;
    double bias_low = 0, bias_high = 0;  // where there is a bias
};

struct PairResult {
    std::string name;  // file within the folders, and layer
    PictureKind kind = PictureKind::light;
    std::string layer_a, layer_b;
    std::map<std::string, std::string> origin_a, origin_b;
    int width = 0, height = 0;
    double white = 0;                    // of light
    std::vector<RegionMetrics> regions;  // the whole picture first
};

/// One pair with its pictures, for whoever shows them.
struct ComparedPair {
    PairResult result;
    ComparedPicture a, b;
    Image<float> error;  // FLIP of colours, |a - b| / b of depth (0 where either is missing), 0 or 1 of masks
};

/// Light as display-coded values 0..1: divided by white, clipped, through the sRGB curve. Display values stay.
Image<Rgb> displayed(const ComparedPicture& picture, double white);

/// Compares file with file, or all files of the same relative path in two folders; in files of these folders that are
/// not EXR the layers are ignored. visit sees each pair, in the order of names.
/// Throws Error (input) when something is missing on either side, or sizes or kinds differ; (usage) for a region that
/// lies not inside.
std::vector<PairResult> compare(const std::string& a, const std::string& b, const CompareSettings& settings,
                                const std::function<void(const ComparedPair&)>& visit = {});

/// Means over the pairs of one region, per metric over the pairs that have it.
std::vector<RegionMetrics> mean_over_pairs(const std::vector<PairResult>& pairs);

}  // namespace pluvia
