#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/image/exr.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/lamps.h"
#include "tools/commands.h"
#include "tools/display_files.h"
#include "tools/frame_file.h"
#include "tools/progress.h"
#include "tools/render_options.h"

#include <fmt/format.h>

#include <filesystem>
#include <iostream>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

void prepare_folder(const RenderOptions& options) {
    std::error_code error;
    if (!options.overwrite && fs::exists(options.output + "/frame.json", error))
        throw usage_error(options.output, "holds a finished frame already (expected an empty folder, or --overwrite)");
    fs::create_directories(options.output, error);
    if (error)
        throw Error(ExitCode::render_failed, options.output, fmt::format("cannot be made ({})", error.message()));
    fs::remove(options.output + "/frame.json", error);  // it names a finished frame, and there is none until the end
}

/// m/s, as the file animates the camera.
Vec3d velocity_of(const Scene& scene, const GltfContents& contents, const Camera& camera) {
    for (size_t i = 0; i < scene.cameras.size(); ++i)
        if (scene.cameras[i].name == camera.name) return contents.camera_velocities[i];
    return {};
}

void report(const RenderOptions& options, const RenderReport& r, const DisplayReport& display, double ev100,
            const std::vector<double>& intensities) {
    if (options.json) {
        nlohmann::ordered_json j;
        j["output"] = options.output;
        j["build_s"] = r.build_seconds, j["render_s"] = r.render_seconds;
        j["rays"] = r.counters.rays, j["camera_paths"] = r.counters[Feature::camera_path];
        j["streaks"] = r.streaks, j["sheltered_streaks"] = r.sheltered_streaks;
        j["streak_hits"] = r.counters[Feature::streak_hit], j["streak_paths"] = r.counters[Feature::streak_path];
        j["exposure_ev100"] = ev100, j["invalid_samples"] = r.counters.invalid_samples;
        j["depths_beyond"] = display.depths_beyond;
        for (size_t i = 0; i < intensities.size(); ++i)
            j["rain_mask_share"][intensity_label(intensities[i])] = display.mask_shares[i];
        std::cout << json_text(j, 2) << "\n";
        return;
    }
    std::cout << fmt::format("{}: {:.1f} s, {:.2f} million paths/s, EV {:.1f}\n", options.output, r.render_seconds,
                             double(r.counters[Feature::camera_path]) / r.render_seconds * 1e-6, ev100);
    if (!intensities.empty())
        std::cout << fmt::format("rain: {} streaks in view, {} more under shelter\n", r.streaks, r.sheltered_streaks);
    for (size_t i = 0; i < intensities.size(); ++i)
        std::cout << fmt::format("  {:g} mm/h: rain mask covers {:.2f} % of the picture\n", intensities[i],
                                 100 * display.mask_shares[i]);
    if (display.depths_beyond > 0)
        std::cout << fmt::format("depth.png: {} depths lie beyond the encoding and are 0 there\n",
                                 display.depths_beyond);
}

void render_command(const RenderOptions& options) {
    // Everything is checked before anything is computed or written.
    CameraSettings camera_options = camera_settings(options);
    const RenderSettings settings = render_settings(options);
    const auto exposure = exposure_ev100(options);
    DisplaySettings display;
    display.view = options.view;
    display.depth_encoding = depth_encoding_from_name(options.depth_encoding, "--depth-encoding");
    display.depth_max = float(options.depth_max);
    display.paper = settings.streaks.composition == Composition::paper;
    DisplayView check_view(options.view);
    const auto progress_style = Progress::style_from_name(options.progress);
    set_thread_count(options.threads);
    const Environment environment = make_environment(options.light, !options.rain.empty());

    GltfContents contents;
    Scene scene = load_gltf(
        options.scene, {camera_options.mid_exposure, camera_options.exposure_time, options.allow_outside}, &contents);
    for (const std::string& warning : scene.warnings)
        std::cerr << "pluvia: warning: " << options.scene << ": " << warning << "\n";
    const Camera camera = find_camera(scene, options.camera);
    if (options.camera_velocity.empty()) camera_options.velocity = velocity_of(scene, contents, camera);
    const uint64_t scene_hash = content_hash(scene);  // of the file, whatever is switched off
    if (lamp_count(scene) > 0 && !lamps_are_on(options.light, environment)) switch_off_lamps(scene);
    scene.unlit_luminance = unlit_luminance(exposure, environment);
    prepare_folder(options);

    FrameHeader header{scene.name,
                       scene_hash,
                       scene.origin,
                       camera.name,
                       make_view(camera, camera_options),
                       to_json(options),
                       settings.rain.intensities_mm_per_h};
    catch_interrupts();
    const std::string exr = options.output + "/frame.exr";
    FrameWriter writer(exr, header);
    RenderReport result;
    {
        Progress progress(progress_style, "rendering");
        result = render(
            scene, environment, header.view, settings, [&](const Band& band) { writer.write(band); },
            [&](double done) { return progress.update(done); });
    }
    display.ev100 = exposure ? *exposure : writer.background_luminance().auto_ev100();
    writer.finish(display.ev100);

    display.text = {{"Software", std::string("Pluvia ") + PLUVIA_VERSION},
                    {"pluvia:settings", json_text(header.options)},
                    {"pluvia:exposure_ev100", fmt::format("{}", display.ev100)}};
    const DisplayReport shown = write_display_files(options.output, exr, header.intensities, display);
    write_text(options.output + "/frame.json", json_text(frame_json(header, display.ev100, result.counters), 2) + "\n");
    report(options, result, shown, display.ev100, header.intensities);
    if (result.counters.invalid_samples > 0)
        throw Error(ExitCode::render_failed, options.output,
                    fmt::format("{} of {} samples were not finite and are missing from the picture",
                                result.counters.invalid_samples, result.counters[Feature::camera_path]));
}

}  // namespace

void add_render_command(CLI::App& app) {
    auto* command = app.add_subcommand("render", "one frame of a glTF scene, clean and in the rain");
    auto options = std::make_shared<RenderOptions>();
    add_render_options(*command, *options);
    command->callback([options] { render_command(*options); });
}

}  // namespace pluvia
