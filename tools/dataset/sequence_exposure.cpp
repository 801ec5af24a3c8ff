#include "tools/dataset/sequence_exposure.h"

#include "renderer/image/exposure.h"

#include <fmt/format.h>

#include <filesystem>

namespace pluvia {

std::optional<double> SequenceExposure::of(const DatasetItem& item, SceneSource& source) {
    if (!item.is_sequence || item.options.exposure != "auto") return std::nullopt;
    const std::pair key(item.scene, item.camera);
    const auto known = known_.find(key);
    if (known != known_.end()) return known->second;
    std::vector<const DatasetItem*> frames;
    for (const DatasetItem& other : items_)
        if (other.scene == item.scene && other.camera == item.camera) frames.push_back(&other);
    return known_[key] = meter(frames, source);
}

double SequenceExposure::meter(std::span<const DatasetItem* const> frames, SceneSource& source) const {
    constexpr int width = 128, samples = 16;
    const size_t count = std::min(metered_frames, frames.size());
    const std::string exr = scratch_ + "/meter.exr";
    LuminanceHistogram all;
    for (size_t i = 0; i < count; ++i) {
        const DatasetItem& frame = *frames[(2 * i + 1) * frames.size() / (2 * count)];
        RenderOptions options = frame.options;
        const CameraSettings full = camera_settings(options);
        options.size = fmt::format("{}x{}", width, std::max(1, width * full.height / full.width));
        options.spp = samples;
        options.rain.clear();
        options.layers.clear();
        const FrameScene& scene = source.at(frame.scene, frame.options);
        render_frame(
            scene, options, FrameSettings(options), exr, [](double) { return true; },
            [&](const Band& band) {
                for (size_t k = 0; k < band.planes[0].size(); ++k)
                    all.add({band.planes[0][k], band.planes[1][k], band.planes[2][k]});
            });
    }
    std::error_code ignored;
    std::filesystem::remove(exr, ignored);
    return all.auto_ev100();
}

}  // namespace pluvia
