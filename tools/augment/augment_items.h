// The pictures of a data set with what belongs to each: depth, camera, labels. One function per layout.
#pragma once

#include "tools/augment/picture_camera.h"

#include <string>
#include <vector>

namespace pluvia {

struct AugmentItem {
    std::string name;            // in the output, with folders, without extension
    std::string picture, depth;  // files; that they are there is seen when they are read
    DepthFormat format;
    PictureCamera camera;
    /// Pictures with one text see the same drops, each from its own place.
    std::string rain;
    struct Copy {
        std::string from, to;  // to: in the output
    };
    std::vector<Copy> labels;
    std::string fault;  // what is wrong with the item's calibration; empty: nothing

    std::string record_path() const { return "records/" + name + ".json"; }
};

/// In the order of their names. Throws Error: usage for options that contradict each other, input where the folder
/// holds no picture in that layout.
std::vector<AugmentItem> augment_items(const AugmentOptions& options);

// The layouts.
std::vector<AugmentItem> folder_items(const AugmentOptions& options);
std::vector<AugmentItem> carla_items(const AugmentOptions& options);
std::vector<AugmentItem> kitti_items(const AugmentOptions& options);
std::vector<AugmentItem> cityscapes_items(const AugmentOptions& options);
std::vector<AugmentItem> nuscenes_items(const AugmentOptions& options);

/// Files of a folder that fit a pattern, sorted: path from the folder, and the text that each * stands for.
struct FoundFile {
    std::string path;
    std::vector<std::string> stars;
};
/// pattern: * is any text without '/', also none.
std::vector<FoundFile> find_matching(const std::string& folder, const std::string& pattern);
/// The pattern with its stars replaced, in order; those beyond the texts repeat the last one.
std::string filled_pattern(const std::string& pattern, const std::vector<std::string>& stars);

}  // namespace pluvia
