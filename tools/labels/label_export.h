// Labels in the layouts of other datasets. Every id comes from the taxonomy's table by way of the frame's own ids; none
// is derived from a colour or from a table of another dataset.
#pragma once

#include "tools/labels/label_frame.h"

#include <string>
#include <vector>

namespace pluvia {

/// cityscapes    NAME_gtFine_labelIds, _labelTrainIds, _instanceIds (16 bits: id * 1000 + number for countable
///               classes), _color .png and _polygons.json: [x, y] of corners of pixels, exact outlines, to be painted
///               in their order
/// kitti         label_2/NAME.txt, calib/NAME.txt, poses.txt (of frames, relative to the first), flow_occ and flow_noc
/// coco          instances.json with uncompressed RLE, panoptic.json and panoptic/NAME.png
/// carla         semantic/NAME.png: tag in red; instance/NAME.png: tag in red, number in green and blue;
///               depth/NAME.png: 24 bits, linear. Tags of CARLA 0.9.14 and later
/// carla-0.9.13  the same with the tags of 0.9.10 to 0.9.13
/// flo           flow/NAME_fwd.flo and NAME_bwd.flo, as Middlebury has them
const std::vector<std::string>& label_formats();

/// Writes the labels of frames into a folder. Frames' names must differ. Throws Error: usage for an unknown format,
/// input for a frame that lacks a layer or that the format cannot hold, render_failed where a file cannot be written.
void export_labels(const std::vector<LabelSource>& frames, const std::string& format, const std::string& folder);

// One format each. The folder is there.
void export_cityscapes(LabelFrame& frame, const std::string& folder);
void export_kitti(const std::vector<LabelSource>& frames, const std::string& folder);
void export_coco(const std::vector<LabelSource>& frames, const std::string& folder);
void export_carla(LabelFrame& frame, const std::string& folder, bool before_0_9_14);
void export_flo(LabelFrame& frame, const std::string& folder);

}  // namespace pluvia
