#include "renderer/transport/layers.h"

#include <fmt/format.h>

#include <cmath>

namespace pluvia {

std::string intensity_label(double intensity) {
    const std::string text = fmt::format("{}", intensity);
    const size_t point = text.find('.');
    if (point == std::string::npos) return fmt::format("{:0>3}", text);
    return fmt::format("{:0>3}p{}", text.substr(0, point), text.substr(point + 1));
}

std::vector<std::string> layer_channels(const std::vector<double>& intensities) {
    std::vector<std::string> names = {"background.R", "background.G", "background.B", "Z", "distance.Y"};
    for (const double intensity : intensities) {
        const std::string label = intensity_label(intensity);
        for (const char* layer : {"transmittance_", "rain_", "inscatter_", "rainy_"})
            for (const char* channel : {".R", ".G", ".B"}) names.push_back(layer + label + channel);
        names.push_back("rain_" + label + ".A");
        names.push_back("rain_wide_" + label + ".A");
        names.push_back("rainy_Z_" + label);
    }
    return names;
}

void develop(const PixelSums& sums, const CentreDepth& depth, int samples, float* values) {
    const double weight = 1.0 / samples;
    std::array<double, 3> background;
    for (int c = 0; c < 3; ++c) *values++ = float(background[c] = sums.background[c] * weight);
    *values++ = depth.z;
    *values++ = depth.distance;
    for (size_t i = 0; i < sums.rain.size(); ++i) {
        const RainSums& rain = sums.rain[i];
        std::array<double, 3> passed, light, inscatter;
        for (int c = 0; c < 3; ++c) {
            passed[c] = background[c] - rain.removed[c] * weight;
            light[c] = rain.light[c] * weight;
            inscatter[c] = rain.inscatter[c] * weight;
            // Where the background is black its mean transmission is what can be said.
            *values++ = float(background[c] > 0 ? passed[c] / background[c] : 1 - rain.blocked * weight);
        }
        for (int c = 0; c < 3; ++c) *values++ = float(light[c]);
        for (int c = 0; c < 3; ++c) *values++ = float(inscatter[c]);
        for (int c = 0; c < 3; ++c) *values++ = float(passed[c] + light[c] + inscatter[c]);
        *values++ = float(rain.coverage * weight);
        *values++ = float(rain.wide_coverage * weight);
        *values++ = depth.rainy_z[i];
    }
}

}  // namespace pluvia
