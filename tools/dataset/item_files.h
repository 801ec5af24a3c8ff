// The pictures of a dataset's frame, made from its EXR file of all layers.
//   background    displayed, JPEG or PNG        depth         16 bits, hri encoding of the centre ray's Z
//   metric_depth  EXR, metres                   and for every intensity
//   rainy_image   displayed                     rain_layer    light of streaks, displayed; alpha: their coverage
//   rain_mask     255 where streaks are seen    depth         to the nearest streak a pixel wide, else to the scene
// and, unless streaks fall in clear air as in the paper's composition,
//   transmittance 16 bits, linear               inscatter     16 bits, displayed: light of finer rain and fog
#pragma once

#include "tools/dataset/item.h"
#include "tools/frame_render.h"

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <vector>

namespace pluvia {

/// A finished file that waits for its final name.
struct StoredFile {
    std::string temporary, path;  // path: from the dataset's folder
};

struct ItemFiles {
    std::vector<StoredFile> files;
    nlohmann::ordered_json frame;               // keys for the record: paths of the clean files, histograms
    std::vector<nlohmann::ordered_json> pairs;  // per intensity: paths and numbers
};

/// Whether pictures have a veil between streaks: rain too fine for them, or fog.
bool has_veil(const RenderOptions& options);

/// Rain is where alpha is at least this share of its largest value, in the paper's composition.
constexpr float paper_mask_alpha = 0.01f;

// Histograms of records: 32 bins each.
constexpr int record_bins = 32;
/// Bin of a depth in metres: three an octave from 0.5 m on. -1 for none.
int depth_bin(float metres);
/// Bin of a brightness: luminance of displayed values, 0 to 1.
int brightness_bin(Rgb displayed);

/// Writes the files into a folder that is empty but for exr.
ItemFiles write_item_files(const std::string& folder, const std::string& exr, const DatasetItem& item,
                           const PictureFormat& format, const RenderedFrame& frame, const DisplaySettings& display);

}  // namespace pluvia
