#include "tools/frame_render.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/texture_size.h"
#include "renderer/transport/passes.h"
#include "shaders/streak_files.h"
#include "shaders/streak_textures.h"
#include "tools/frame_in_time.h"
#include "tools/label_rules.h"
#include "tools/sample_choice.h"
#include "tools/scene_light.h"
#include "tools/streak_cache.h"
#include "tools/time_limit.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <optional>

namespace pluvia {

namespace fs = std::filesystem;

FrameScene load_frame_scene(const RenderOptions& options) {
    const CameraSettings camera = camera_settings(options);
    GltfContents contents;
    FrameScene result;
    result.scene = load_gltf(
        options.scene, {camera.mid_exposure, camera.exposure_time, options.variant, options.allow_outside}, &contents);
    for (const std::string& warning : result.scene.warnings)
        std::cerr << "pluvia: warning: " << options.scene << ": " << warning << "\n";
    result.hash = content_hash(result.scene);
    if (options.texture_size) shrink_textures(result.scene, *options.texture_size);
    result.is_animated = !contents.animations.empty();
    result.labelled_paths = std::move(contents.labelled_paths);
    if (!result.is_animated || !label_choice(options.layers).layers.flow) return result;
    const auto at = [&](int step) {
        const GltfSettings then{camera.mid_exposure + step / options.fps, camera.exposure_time, options.variant,
                                options.allow_outside, false};
        auto other = std::make_shared<Scene>(load_gltf(options.scene, then));
        if (same_places(result.scene, *other)) {
            other->meshes.clear(), other->instances.clear();  // only cameras move: the frame's own will do
        } else {
            other->images = result.scene.images;  // the same file's; masks of alpha decide over what is hidden
        }
        return other;
    };
    result.next = at(1), result.previous = at(-1);
    return result;
}

FrameSettings::FrameSettings(const RenderOptions& options)
    : camera(camera_settings(options)), render(render_settings(options)), ev100(exposure_ev100(options)) {
    display.view = options.view;
    display.depth_encoding = depth_encoding_from_name(options.depth_encoding, "--depth-encoding");
    display.depth_max = float(options.depth_max);
    display.paper = render.streaks.composition == Composition::paper;
    labels = label_choice(options.layers);
    render.labels.layers = labels.layers;
    if (!options.labels.empty()) label_rules = read_label_rules(options.labels);
    check_display_view(options.view);
    environment = make_environment(options.light, !options.rain.empty());
    render.streaks.textures = streak_textures(options);
}

std::shared_ptr<const StreakTextures> streak_textures(const RenderOptions& options) {
    if (options.composition != "paper" || options.rain.empty()) return nullptr;
    const Progress::Style style = Progress::style_from_name(options.progress);
    return std::make_shared<StreakTextures>(options.streaks.empty() ? cached_streaks(StreakTracing(), style)
                                                                    : read_streaks(options.streaks));
}

namespace {

/// time_limit: seconds; where given, it decides over the samples.
RenderedFrame render_to_file(FrameScene frame, const RenderOptions& options, const FrameSettings& settings,
                             const std::string& exr, const std::optional<double>& time_limit,
                             const ProgressCallback& progress, const BandSink& look) {
    Scene& scene = frame.scene;
    prepare_scene(scene, options, settings);
    const Camera camera = find_camera(scene, options.camera);
    RenderedFrame result{{scene.name, frame.hash, scene.origin, camera.name, make_view(camera, settings.camera),
                          to_json(options), settings.render.rain.intensities_mm_per_h},
                         0,
                         {},
                         {}};
    RenderSettings render_settings = settings.render;
    LabelSettings& labels = render_settings.labels;
    labels.objects = objects_of(frame, settings.labels, settings.label_rules);
    set_other_frames(frame, options, settings, result.header.view, labels);
    result.header.labels = labels.layers;
    result.header.label_entries = label_header(scene, labels, result.header.intensities);
    if (labels.next) result.header.next = labels.next->view, result.header.previous = labels.previous->view;
    for (const auto* other : {&frame.next, &frame.previous})
        result.header.things_move |= *other && !(*other)->instances.empty();
    SeenObjects seen;
    std::optional<FrameWriter> writer;
    if (options.target_error)
        render_settings.choose_samples = [&](const PixelRenderer& pilot) {
            const View& view = result.header.view;
            const int samples = samples_for_error(*options.target_error, pilot, result.header.intensities,
                                                  int64_t(view.width) * view.height, options.seed);
            result.header.options["spp"] = samples;
            writer.emplace(exr, result.header);
            return samples;
        };
    else if (!time_limit)
        writer.emplace(exr, result.header);
    const BandSink write = [&](const Band& band) {
        if (look) look(band);
        if (labels.layers.instance) seen.look(band.ids.back(), band.y, band.width);
        writer->write(band);
    };
    if (time_limit) {
        TimeLimit limit(*time_limit);
        const NextPass next_pass = [&](int done, const BandPreview& preview) {
            if (done == 1) {
                const std::string folder = fs::path(exr).parent_path();
                // A tenth and 1 % of the limit more, for what a trial does not see: counts, other text, the end.
                limit.reserve(1.1 * seconds_to_write(result.header, preview, settings.display, folder) +
                              0.01 * *time_limit);
            }
            const int samples = limit.next_pass();
            if (samples == 0) {
                result.header.options["spp"] = done;
                writer.emplace(exr, result.header);
            }
            return samples;
        };
        result.report = render_in_passes(scene, settings.environment, result.header.view, render_settings, next_pass,
                                         write, progress);
    } else {
        result.report = render(scene, settings.environment, result.header.view, render_settings, write, progress);
    }
    result.ev100 = settings.ev100 ? *settings.ev100 : writer->background_luminance().auto_ev100();
    writer->finish(result.ev100);
    if (labels.layers.instance) {
        const View& view = result.header.view;
        const std::vector<ObjectExtent> extents =
            settings.labels.boxes ? object_extents(scene, *labels.objects, view) : std::vector<ObjectExtent>();
        const auto motions = [&](const std::shared_ptr<const Scene>& other) {
            return !other || other->instances.empty() ? std::vector<ObjectMotion>()
                                                      : object_motions(*labels.objects, scene, *other);
        };
        result.objects = objects_json(*labels.objects, seen, extents, {motions(frame.next), motions(frame.previous)},
                                      view, scene.origin);
    }
    return result;
}

}  // namespace

RenderedFrame render_frame(FrameScene scene, const RenderOptions& options, const FrameSettings& settings,
                           const std::string& exr, const ProgressCallback& progress, const BandSink& look) {
    return render_to_file(std::move(scene), options, settings, exr, {}, progress, look);
}

RenderedFrame render_frame_in_time(FrameScene scene, const RenderOptions& options, const FrameSettings& settings,
                                   const std::string& exr, double seconds, const ProgressCallback& progress) {
    return render_to_file(std::move(scene), options, settings, exr, seconds, progress, {});
}

PngText display_text(const RenderedFrame& frame) {
    return {{"Software", std::string("Pluvia ") + PLUVIA_VERSION},
            {"pluvia:settings", json_text(frame.header.options)},
            {"pluvia:exposure_ev100", fmt::format("{}", frame.ev100)}};
}

void require_valid_samples(const RenderedFrame& frame, const std::string& where) {
    const Counters& counters = frame.report.counters;
    if (counters.invalid_samples > 0)
        throw Error(ExitCode::render_failed, where,
                    fmt::format("{} of {} samples were not finite and are missing from the picture",
                                counters.invalid_samples, counters[Feature::camera_path]));
}

}  // namespace pluvia
