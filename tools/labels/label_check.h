// What the labels of a frame must have in common, as read back from its files.
#pragma once

#include "tools/labels/label_frame.h"

#include <string>
#include <vector>

namespace pluvia {

/// Where nothing hides a point in the other frame, depth and poses lead to where flow says, to within this, pixels.
constexpr double flow_tolerance = 0.1;

struct LabelCheck {
    std::vector<std::string> faults;
    int64_t labelled_pixels = 0;    // whose class was compared with that of their instance
    int64_t boxes = 0;              // compared with the pixels of their objects
    int64_t flow_pixels = 0;        // compared with depth, poses and motions of objects
    int64_t moving_pixels = 0;      // of these, those of objects that move
    int64_t left_out_pixels = 0;    // not compared: their objects bend, as skins do, or say no motion; or without
                                    // instance ids in a scene that moves, those that do not rest
    double largest_flow_error = 0;  // pixels
};

/// Checks what the frame has: that the class of every pixel is that of its instance; that boxes hug the pixels of their
/// objects, and 3D boxes hold the points that these show; that flow agrees with depth, poses and the
/// motions of objects.
/// Throws Error (input) where a file is broken.
LabelCheck check_labels(LabelFrame& frame);

}  // namespace pluvia
