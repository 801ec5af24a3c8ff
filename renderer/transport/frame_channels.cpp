#include "renderer/transport/frame_channels.h"

#include "renderer/transport/cryptomatte.h"
#include "renderer/transport/layers.h"

namespace pluvia {

FrameChannels frame_channels(const std::vector<double>& intensities, const LabelLayers& labels) {
    FrameChannels channels{layer_channels(intensities), label_id_channels(labels)};
    const auto add = [&](const std::vector<std::string>& names) {
        channels.values.insert(channels.values.end(), names.begin(), names.end());
    };
    add(label_channels(labels));
    if (!labels.cryptomatte) return channels;
    for (const char* layer : {"CryptoObject", "CryptoMaterial"}) add(cryptomatte_channel_names(layer));
    for (const double intensity : intensities) add(rain_matte_channel_names(intensity_label(intensity)));
    return channels;
}

}  // namespace pluvia
