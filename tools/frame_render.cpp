#include "tools/frame_render.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/lamps.h"
#include "shaders/streak_files.h"
#include "tools/sample_choice.h"
#include "tools/streak_cache.h"

#include <fmt/format.h>

#include <iostream>
#include <optional>

namespace pluvia {
namespace {

/// m/s, as the file animates the camera.
Vec3d velocity_of(const FrameScene& scene, const Camera& camera) {
    for (size_t i = 0; i < scene.camera_velocities.size(); ++i)
        if (scene.scene.cameras[i].name == camera.name) return scene.camera_velocities[i];
    return {};
}

}  // namespace

FrameScene load_frame_scene(const RenderOptions& options) {
    const CameraSettings camera = camera_settings(options);
    GltfContents contents;
    FrameScene result;
    result.scene = load_gltf(
        options.scene, {camera.mid_exposure, camera.exposure_time, options.variant, options.allow_outside}, &contents);
    for (const std::string& warning : result.scene.warnings)
        std::cerr << "pluvia: warning: " << options.scene << ": " << warning << "\n";
    result.camera_velocities = contents.camera_velocities;
    result.hash = content_hash(result.scene);
    result.is_animated = !contents.animations.empty();
    return result;
}

FrameSettings::FrameSettings(const RenderOptions& options)
    : camera(camera_settings(options)), render(render_settings(options)), ev100(exposure_ev100(options)) {
    display.view = options.view;
    display.depth_encoding = depth_encoding_from_name(options.depth_encoding, "--depth-encoding");
    display.depth_max = float(options.depth_max);
    display.paper = render.streaks.composition == Composition::paper;
    const DisplayView check(options.view);
    environment = make_environment(options.light, !options.rain.empty());
    if (display.paper && !options.rain.empty()) {
        const Progress::Style style = Progress::style_from_name(options.progress);
        render.streaks.textures = std::make_shared<StreakTextures>(
            options.streaks.empty() ? cached_streaks(StreakTracing(), style) : read_streaks(options.streaks));
    }
}

RenderedFrame render_frame(FrameScene frame, const RenderOptions& options, const FrameSettings& settings,
                           const std::string& exr, const ProgressCallback& progress, const BandSink& look) {
    const Camera camera = find_camera(frame.scene, options.camera);
    CameraSettings camera_options = settings.camera;
    if (options.camera_velocity.empty()) camera_options.velocity = velocity_of(frame, camera);
    Scene& scene = frame.scene;
    if (lamp_count(scene) > 0 && !lamps_are_on(options.light, settings.environment)) switch_off_lamps(scene);
    scene.unlit_luminance = unlit_luminance(settings.ev100, settings.environment);

    RenderedFrame result{{scene.name, frame.hash, scene.origin, camera.name, make_view(camera, camera_options),
                          to_json(options), settings.render.rain.intensities_mm_per_h},
                         0,
                         {}};
    std::optional<FrameWriter> writer;
    RenderSettings render_settings = settings.render;
    if (options.target_error)
        render_settings.choose_samples = [&](const PixelRenderer& pilot) {
            const View& view = result.header.view;
            const int samples = samples_for_error(*options.target_error, pilot, result.header.intensities,
                                                  int64_t(view.width) * view.height, options.seed);
            result.header.options["spp"] = samples;
            writer.emplace(exr, result.header);
            return samples;
        };
    else
        writer.emplace(exr, result.header);
    result.report = render(
        scene, settings.environment, result.header.view, render_settings,
        [&](const Band& band) {
            if (look) look(band);
            writer->write(band);
        },
        progress);
    result.ev100 = settings.ev100 ? *settings.ev100 : writer->background_luminance().auto_ev100();
    writer->finish(result.ev100);
    return result;
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
