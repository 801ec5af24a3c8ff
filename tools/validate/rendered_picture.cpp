#include "tools/validate/rendered_picture.h"

#include "renderer/transport/frame_channels.h"
#include "tools/validate/running_mean.h"

#include <cstring>

namespace pluvia {

double Picture::mean(const std::string& channel) const {
    double sum = 0;
    for (const float v : plane(channel)) sum += v;
    return sum / double(plane(channel).size());
}

bool operator==(const Picture& a, const Picture& b) {
    if (a.planes.size() != b.planes.size() || a.ids != b.ids) return false;
    for (const auto& [channel, plane] : a.planes) {
        const auto other = b.planes.find(channel);
        if (other == b.planes.end() || other->second.size() != plane.size() ||
            std::memcmp(plane.data(), other->second.data(), plane.size() * sizeof(float)) != 0)
            return false;
    }
    return true;
}

Picture render_picture(const Scene& scene, const Environment& environment, const View& view,
                       const RenderSettings& settings, const PictureSource* source) {
    Picture picture;
    picture.width = view.width, picture.height = view.height;
    const FrameChannels channels = frame_channels(settings.rain.intensities_mm_per_h, settings.labels.layers);
    const auto append = [](auto& all, const auto& rows) { all.insert(all.end(), rows.begin(), rows.end()); };
    picture.report = render(
        scene, environment, view, settings,
        [&](const Band& band) {
            for (size_t c = 0; c < channels.values.size(); ++c)
                append(picture.planes[channels.values[c]], band.planes[c]);
            for (size_t c = 0; c < channels.ids.size(); ++c) append(picture.ids[channels.ids[c]], band.ids[c]);
        },
        [](double) { return true; }, source);
    return picture;
}

Estimate estimate(const Scene& scene, const Environment& environment, const View& view, RenderSettings settings,
                  const std::string& channel, int seeds, uint64_t first_seed) {
    RunningMean mean;
    for (int k = 0; k < seeds; ++k) {
        settings.seed = settings.rain.seed = first_seed + uint64_t(k);
        mean.add(render_picture(scene, environment, view, settings).mean(channel));
    }
    return {mean.mean(), mean.standard_error()};
}

}  // namespace pluvia
