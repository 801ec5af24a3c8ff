// Clips of the sequences of a dataset, made by ffmpeg where it is installed.
#pragma once

#include "tools/dataset/config.h"

#include <string>
#include <vector>

namespace pluvia {

/// Writes dataset/video/SCENE_CAMERA.mp4, with _050 and the like behind it where frames have several intensities, at
/// the frame rate of the scene. picture: rainy_image or background. Returns the files written, each whole. Throws
/// Error: usage for another picture, check_failed when frames are missing, render_failed when ffmpeg is not there or
/// fails.
std::vector<std::string> write_videos(const DatasetConfig& config, const std::string& dataset,
                                      const std::string& picture);

}  // namespace pluvia
