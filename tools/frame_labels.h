// Labels of a frame: from the option --layers and a loaded scene to what the renderer needs and what files say of it.
#pragma once

#include "renderer/transport/label_layers.h"
#include "tools/frame_objects.h"

#include <map>
#include <string>
#include <vector>

namespace pluvia {

struct FrameScene;
struct FrameSettings;
struct RenderOptions;

/// What --layers asks for.
struct LabelChoice {
    LabelLayers layers;
    bool boxes = false;  // of objects, in frame.json; they need instance ids
};

/// Throws Error (usage) for a name that is none of semantic, instance, normals, albedo, position, flow, boxes,
/// cryptomatte and all.
LabelChoice label_choice(const std::vector<std::string>& names);

/// Objects of the scene by its file and the rules; null where no layer asks for them.
std::shared_ptr<const SceneObjects> objects_of(const FrameScene& frame, const LabelChoice& choice,
                                               const std::vector<LabelRule>& rules);

/// The views of the frames before and after, where flow is asked for.
void set_other_frames(const FrameScene& frame, const RenderOptions& options, const FrameSettings& settings,
                      const View& view, LabelSettings& labels);

/// Header entries of the EXR file: manifests of the mattes.
std::map<std::string, std::string> label_header(const Scene& scene, const LabelSettings& labels,
                                                const std::vector<double>& intensities);

}  // namespace pluvia
