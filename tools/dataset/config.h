// What a dataset consists of, as its configuration file says; checked. Keys that are options of `pluvia render` mean
// what they mean there. Its frames, one by one, are in item.h.
#pragma once

#include "tools/dataset/frame_keys.h"
#include "tools/render_options.h"

#include <string>
#include <vector>

namespace pluvia {

/// How the rain of a sequence goes from frame to frame.
struct RainCourse {
    std::vector<FrameKey> rain, wind;  // mm/h, in x, and m/s; wind empty: as frames have it otherwise
};

struct DatasetScene {
    std::string name;    // folder of its pictures
    std::string source;  // a builder's name, or the path of a glTF file
    bool is_built = false;
    bool traffic = false;                  // of a built scene: what moves in it
    int frames = 0;                        // of every camera
    std::optional<double> hour;            // of all frames; empty: as the dataset's hours have it
    RainCourse course;                     // its own, or the dataset's; without rain: frames are no sequence
    std::vector<std::string> train, test;  // cameras
    RenderOptions options;                 // the same for all its frames

    /// Whether rain falls on from frame to frame, one intensity each.
    bool is_sequence() const { return !course.rain.empty(); }
};

/// How pictures are stored.
struct PictureFormat {
    int bits = 8;           // 8: background as JPEG, the others as PNG; 16: all as PNG of 16 bits
    int jpeg_quality = 95;  // 1 to 100
    bool exr = false;       // all layers of every frame beside the pictures
};

struct DatasetConfig {
    std::string path;  // of the file
    std::string name, description, license = "other";
    std::vector<DatasetScene> scenes;
    std::vector<double> hours;             // frame i has hours[i % size]; empty: 24 i / frames
    std::vector<Vec3d> winds = {Vec3d()};  // m/s; frame i has winds[i % size]
    PictureFormat pictures;

    size_t intensity_count() const { return scenes.front().options.rain.size(); }
};

/// Throws Error (usage) with FILE:LINE for a key that is unknown, with the one that may have been meant, or for a value
/// that is out of range; input when the file cannot be read. A scene that does not exist is not noticed here.
DatasetConfig read_dataset_config(const std::string& path);

}  // namespace pluvia
