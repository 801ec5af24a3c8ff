#include "tools/dataset/layer_check.h"

#include "renderer/image/exr.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

LayerCheck::LayerCheck(const std::vector<double>& intensities) : names_(layer_channels(intensities)) {
    for (const double intensity : intensities) labels_.push_back(intensity_label(intensity));
}

const std::vector<float>& LayerCheck::plane(const Band& band, const std::string& name) const {
    return band.planes[size_t(std::find(names_.begin(), names_.end(), name) - names_.begin())];
}

void LayerCheck::look(const Band& band) {
    for (size_t i = 0; i < band.planes.size(); ++i) {
        // Where there is only sky a depth is infinite, and so is a label's position.
        const auto is_depth = [](const std::string& name) {
            return name == "Z" || name == "distance.Y" || name.starts_with("rainy_Z_");
        };
        const bool may_be_infinite = i >= names_.size() || is_depth(names_[i]);
        for (const float v : band.planes[i]) not_finite_ += may_be_infinite ? std::isnan(v) : !std::isfinite(v);
    }
    for (const std::string& label : labels_)
        for (const char* channel : {".R", ".G", ".B"}) {
            const auto layer = [&](const std::string& name) -> const std::vector<float>& {
                return plane(band, name + channel);
            };
            const auto &background = layer("background"), &transmittance = layer("transmittance_" + label),
                       &rain = layer("rain_" + label), &inscatter = layer("inscatter_" + label),
                       &rainy = layer("rainy_" + label);
            for (size_t k = 0; k < rainy.size(); ++k) {
                const double sum = double(background[k]) * transmittance[k] + rain[k] + inscatter[k];
                const double difference = std::abs(sum - rainy[k]);
                if (difference > 0) residual_ = std::max(residual_, difference / std::max(sum, double(rainy[k])));
            }
        }
}

LayerCheck checked_layers(const std::string& path, const std::vector<double>& intensities) {
    constexpr int rows = 64;
    ExrReader exr(path);
    LayerCheck check(intensities);
    const std::vector<std::string> names = layer_channels(intensities);
    for (int y = 0; y < exr.height(); y += rows) {
        Band band(y, std::min(rows, exr.height() - y), exr.width(), names.size());
        std::vector<ExrRequest> requests;
        for (size_t i = 0; i < names.size(); ++i) requests.push_back({names[i], band.planes[i].data()});
        exr.read_rows(y, band.rows, requests);
        check.look(band);
    }
    return check;
}

}  // namespace pluvia
