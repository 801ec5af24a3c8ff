// Pictures rendered in memory, and means over many of them.
#pragma once

#include "renderer/transport/render.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pluvia {

/// All planes of a rendered frame.
class Picture {
public:
    int width = 0, height = 0;
    std::map<std::string, std::vector<float>> planes;
    std::map<std::string, std::vector<uint32_t>> ids;
    RenderReport report;

    const std::vector<float>& plane(const std::string& channel) const { return planes.at(channel); }
    double mean(const std::string& channel) const;
    friend bool operator==(const Picture& a, const Picture& b);  // every bit of every plane
};

Picture render_picture(const Scene& scene, const Environment& environment, const View& view,
                       const RenderSettings& settings, const PictureSource* picture = nullptr);

/// Mean and error of one channel averaged over the picture, from independent seeds of samples and drops.
struct Estimate {
    double mean, standard_error;
};
Estimate estimate(const Scene& scene, const Environment& environment, const View& view, RenderSettings settings,
                  const std::string& channel, int seeds, uint64_t first_seed = 1000);

}  // namespace pluvia
