// A picture read for comparison: light, display values, depth or a mask, from whatever file it is in.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/depth_encoding.h"
#include "renderer/image/image.h"

#include <map>
#include <string>

namespace pluvia {

enum class PictureKind {
    light,    // scene-linear, from EXR or HDR
    display,  // 8 or 16 bits as stored, divided by 255 or 65535
    depth,    // metres; +inf or 0: none
    mask,     // set where the stored value is at least one half
};

/// Names of the kinds: light, display, depth, mask.
const char* picture_kind_name(PictureKind kind);

struct ReadSettings {
    std::string layer;                                      // of EXR files, see exr_layers.h
    std::string kind = "auto";                              // auto, color, depth or mask
    DepthEncoding depth_encoding = DepthEncoding::kitti16;  // of integer depth
    float depth_max = 100;                                  // metres of a full value in the encoding hri
};

struct ComparedPicture {
    PictureKind kind = PictureKind::light;
    std::string layer;                          // which was found in an EXR file
    Image<Rgb> color;                           // light and display
    Image<float> value;                         // depth and mask
    std::map<std::string, std::string> origin;  // what the file says of its making: version, scene, samples, seed, ...

    int width() const { return color.width + value.width; }
    int height() const { return color.height + value.height; }
};

/// kind auto: EXR by the layer (exr_layers.h), other files by their name: "mask" in it makes a mask, "depth" at its
/// beginning depth, all else is a picture. Negative light is kept.
/// Throws Error (input) for what cannot be read, has not the layer, or holds light or display values that are not
/// finite.
ComparedPicture read_compared_picture(const std::string& path, const ReadSettings& settings);

}  // namespace pluvia
