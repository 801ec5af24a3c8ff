// From checked options and a loaded scene to the EXR file of one frame.
// `pluvia render` makes one of them, dataset/item_render.h many.
#pragma once

#include "renderer/transport/render.h"
#include "tools/display_files.h"
#include "tools/frame_file.h"
#include "tools/frame_labels.h"
#include "tools/render_options.h"

namespace pluvia {

/// A scene at the time of a frame, as a file or a builder gives it.
struct FrameScene {
    Scene scene;
    uint64_t hash = 0;  // of the content, whatever is switched off later
    bool is_animated = false;
    std::vector<std::string> labelled_paths;      // of Scene::instances: see GltfContents
    std::shared_ptr<const Scene> next, previous;  // a frame later and earlier; null: nothing moves or nobody asks;
                                                  // without instances: only cameras move
};

/// Reads options.scene as it is at the frame's mid-exposure; its warnings are printed to stderr.
FrameScene load_frame_scene(const RenderOptions& options);

/// What the options mean, all of it checked. Throws Error (usage, or input for a file of light).
struct FrameSettings {
    explicit FrameSettings(const RenderOptions& options);

    CameraSettings camera;
    RenderSettings render;
    std::optional<double> ev100;  // empty where the exposure is measured
    DisplaySettings display;      // but for the exposure and the text
    Environment environment;
    LabelChoice labels;
    std::vector<LabelRule> label_rules;
};

/// What streaks look like with the paper's composition, where there is rain; else nothing is read.
std::shared_ptr<const StreakTextures> streak_textures(const RenderOptions& options);

struct RenderedFrame {
    FrameHeader header;
    double ev100;  // of the pictures to be made
    RenderReport report;
    nlohmann::ordered_json objects = {};  // of objects_json(); null without instance ids
};

/// Renders to an EXR file that appears when it is whole. look, where given, sees each band of finished rows on its way.
RenderedFrame render_frame(FrameScene scene, const RenderOptions& options, const FrameSettings& settings,
                           const std::string& exr, const ProgressCallback& progress, const BandSink& look = {});

/// What is stored in every picture of a frame.
PngText display_text(const RenderedFrame& frame);

/// Throws Error (render_failed) when samples were not finite. where: the frame's name for the message.
void require_valid_samples(const RenderedFrame& frame, const std::string& where);

}  // namespace pluvia
