// One frame of a dataset, which is one render: the clean picture, its depth and the rainy pictures of all intensities.
// Where its files lie is the layout of the HRI dataset ("Learning from Rendering").
#pragma once

#include "tools/dataset/config.h"
#include "tools/labels/label_frame.h"

#include <string>
#include <vector>

namespace pluvia {

struct DatasetItem {
    size_t scene = 0;  // index in DatasetConfig::scenes
    std::string scene_name;
    std::string camera;  // HRI's "sequence"
    bool is_test = false;
    int frame = 0;
    RenderOptions options;     // all of the frame
    bool is_sequence = false;  // its rain goes on from frame to frame

    /// "lane/front/frame_0003".
    std::string id() const;
    const char* split() const { return is_test ? "test" : "train"; }

    // Paths from the dataset's folder.
    std::string record_path() const { return "records/" + id() + ".json"; }
    std::string exr_path() const { return "exr/" + id() + ".exr"; }
    /// With label layers, which frames have in their EXR file.
    LabelSource labels(const std::string& dataset) const;
    /// kind: "background", "depth", ...; extension without its point.
    std::string clean_path(const std::string& kind, const std::string& extension) const;
    std::string rainy_path(double intensity, const std::string& kind, const std::string& extension) const;
};

/// "wind_2" for a wind along X, else "wind_2_0_-1"; m/s.
std::string wind_name(const std::vector<double>& wind);
/// "10mm", "12p5mm".
std::string intensity_folder(double intensity_mm_per_h);

/// All frames: scene by scene, camera by camera (training first), in rising order.
std::vector<DatasetItem> dataset_items(const DatasetConfig& config);

/// A part of a dataset: number of count, from 1.
struct Shard {
    int number = 1, count = 1;

    /// "1-of-3", for names of files.
    std::string label() const;
    /// First and past-the-end index of its part of a list: a contiguous run.
    std::pair<size_t, size_t> range(size_t size) const {
        return {size * size_t(number - 1) / size_t(count), size * size_t(number) / size_t(count)};
    }
    /// Throws Error (usage) unless it is I/N with 1 <= I <= N.
    static Shard parse(const std::string& text);
};

/// The shard's items: a contiguous run, so that few scenes are loaded. Shards have the same number but for one.
std::vector<DatasetItem> shard_items(const std::vector<DatasetItem>& items, Shard shard);

}  // namespace pluvia
