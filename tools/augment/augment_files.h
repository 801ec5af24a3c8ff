// The layers of a picture in memory, and the files that are made of them.
#pragma once

#include "renderer/image/image_io.h"
#include "renderer/transport/layers.h"
#include "tools/display_rows.h"
#include "tools/frame_file.h"

#include <map>
#include <string>
#include <vector>

namespace pluvia {

/// All planes of layer_channels, filled by bands.
class LayerPlanes {
public:
    LayerPlanes(int width, int height, const std::vector<double>& intensities_mm_per_h);

    int width() const { return width_; }
    int height() const { return height_; }
    void add(const Band& band);
    void read(int y, int count, std::span<const ExrRequest> requests) const;
    const std::vector<float>& plane(const std::string& channel) const { return planes_.at(channel); }

private:
    int width_, height_;
    std::vector<std::string> channels_;
    std::map<std::string, std::vector<float>> planes_;
};

struct AugmentedFiles {
    std::vector<std::pair<std::string, std::string>> files;  // where it is, where it belongs: path in the output
    std::vector<double> mask_shares, coverages;              // means over the picture, per intensity
};

struct AugmentedFormat {
    bool pictures = true;    // rainy ones; else nothing that shows the input
    bool all_layers = true;  // in the EXR
    bool exr = false;
    std::string view = "srgb";
    bool paper = false;
    PngText text;
};

/// Writes into a folder, per intensity: rainy (8 bits), rain_layer (8 bits), rain_mask, transmittance (grey, 16 bits,
/// linear), inscatter (16 bits, displayed); and one EXR file of layers, if asked for.
AugmentedFiles write_augmented_files(const std::string& folder, const std::string& name, const LayerPlanes& layers,
                                     const FrameHeader& header, double ev100, const AugmentedFormat& format);

}  // namespace pluvia
