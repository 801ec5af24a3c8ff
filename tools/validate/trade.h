// What accuracy costs: one frame with the dials of the renderer at many settings, each with its time and its error
// against a reference of many more samples. The dials are in trade_dials.h, the reports in trade_report.h.
#pragma once

#include "tools/frame_render.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pluvia {

/// How far a layer is from the reference.
struct LayerError {
    double error = 0;                              // square root of the trimmed relMSE (color_metrics.h)
    double flip = 0;                               // mean over pixels
    double bias = 0, bias_low = 0, bias_high = 0;  // as color_metrics.h has them
};

/// One setting, measured. Without its picture.
struct TradeResult {
    std::string dial, value;
    bool biased = false;
    uint64_t key = 0;              // of all that it depends on
    int samples = 0;               // per pixel
    double build_cpu_s = 0;        // processor time of what is made before the first sample
    double cpu_s = 0, wall_s = 0;  // of the samples, a pilot's included
    LayerError background = {};
    std::optional<LayerError> rainy = {};  // of the highest intensity

    /// Of the worse layer.
    double error() const { return rainy ? std::max(rainy->error, background.error) : background.error; }
    double flip() const { return rainy ? std::max(rainy->flip, background.flip) : background.flip; }
};

struct TradeReport {
    std::string scene;
    nlohmann::ordered_json options;  // of the frame, with the samples of settings that say nothing about them
    int reference_samples = 0;
    double reference_error = 0;  // its own, of the worse layer, by the difference of its halves
    std::vector<TradeResult> results;
};

/// Colours of the layers that are judged: the background, and where it rains the rainy picture of the highest
/// intensity.
struct JudgedLayers {
    Image<Rgb> background;
    std::optional<Image<Rgb>> rainy;
};

/// A scene that is rendered again and again with other settings.
class TradeScene {
public:
    /// Loads all that the options name. Throws Error.
    explicit TradeScene(const RenderOptions& options);

    /// Of everything that the light of the frame depends on but samples and their seed.
    uint64_t key() const { return key_; }
    const View& view() const { return view_; }
    const FrameSettings& settings() const { return settings_; }
    /// Layers of a frame with these settings; times are added to the result.
    JudgedLayers render(RenderSettings settings, const std::optional<double>& target_error, TradeResult& result,
                        const ProgressCallback& progress) const;

private:
    FrameSettings settings_;
    FrameScene frame_;
    View view_;
    uint64_t key_ = 0;
};

/// Error of the judged layers against those of a reference.
LayerError error_of_layer(const Image<Rgb>& got, const Image<Rgb>& reference);

/// Whether each result is on the Pareto front of processor time and error, or FLIP: no other is as quick and more
/// accurate, or as accurate and quicker.
std::vector<bool> pareto_front(const std::vector<TradeResult>& results,
                               double (TradeResult::*value)() const = &TradeResult::error);

}  // namespace pluvia
