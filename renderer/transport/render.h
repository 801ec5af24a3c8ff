// render(): a scene, an environment and a view to the layers of a frame, in bands of finished rows.
#pragma once

#include "renderer/rain/streaks.h"
#include "renderer/scene/camera.h"
#include "renderer/transport/label_layers.h"
#include "renderer/transport/layers.h"
#include "renderer/transport/path.h"
#include "renderer/transport/picture_source.h"
#include "renderer/transport/streak_settings.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace pluvia {

/// Renders single pixels, y * width + x, with these samples each of that seed: the values of layer_channels(), one
/// pixel after the other, but for depth, which is 0. Uses all threads; called by one.
using PixelRenderer = std::function<std::vector<float>(std::span<const int64_t> pixels, int samples, uint64_t seed)>;

struct RenderSettings {
    int samples = 64;  // camera samples per pixel
    /// Where given, asked for the number of samples in place of the above when all is ready and before the first band.
    std::function<int(const PixelRenderer&)> choose_samples = {};
    uint64_t seed = 0;
    PathSettings path = {};
    RainSettings rain = {};  // no intensities: no rain stage at all; lowest_ground is taken from the scene
    StreakSettings streaks = {};
    WetSettings wet = {};
    std::optional<Vec3d> wet_wind =
        {};  // m/s, of the rain that made the ground wet; empty: that of the rain that falls
    LabelSettings labels = {};
    int tile_size = 32;  // pixels; changes no byte of the picture
};

struct RenderReport {
    int samples = 0;  // per pixel
    Counters counters;
    size_t streaks = 0;            // in view, after shelter
    size_t sheltered_streaks = 0;  // removed because a roof is above them
    double build_seconds = 0, render_seconds = 0;
};

/// Takes finished rows, in rising order.
using BandSink = std::function<void(const Band&)>;
/// Told after most pixels how much is done, 0 to 1, by one thread at a time; false asks to stop.
using ProgressCallback = std::function<bool(double)>;

/// Renders all layers of frame_channels(). The bands are the same for any number of
/// threads and any tile size. Throws Error (stopped_early) when progress returns false.
/// picture: of the view's size, what the camera sees without rain; the scene then lights the drops alone and shelters
/// none. Null: the scene is what it sees.
RenderReport render(const Scene& scene, const Environment& environment, const View& view,
                    const RenderSettings& settings, const BandSink& sink, const ProgressCallback& progress,
                    const PictureSource* picture = nullptr);

}  // namespace pluvia
