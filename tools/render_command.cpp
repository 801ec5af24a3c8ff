#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "tools/commands.h"
#include "tools/frame_in_time.h"
#include "tools/option_check.h"
#include "tools/progress.h"
#include "tools/time_limit.h"

#include <fmt/format.h>

#include <algorithm>
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

void report(const RenderOptions& options, const RenderReport& r, const DisplayReport& display, double ev100,
            const std::vector<double>& intensities) {
    if (options.json) {
        nlohmann::ordered_json j;
        j["output"] = options.output;
        j["samples"] = r.samples;
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
    std::cout << fmt::format("{}: {} samples, {:.1f} s, {:.2f} million paths/s, EV {:.1f}\n", options.output, r.samples,
                             r.render_seconds, double(r.counters[Feature::camera_path]) / r.render_seconds * 1e-6,
                             ev100);
    if (!intensities.empty())
        std::cout << fmt::format("rain: {} streaks in view, {} more under shelter\n", r.streaks, r.sheltered_streaks);
    for (size_t i = 0; i < intensities.size(); ++i)
        std::cout << fmt::format("  {:g} mm/h: rain mask covers {:.2f} % of the picture\n", intensities[i],
                                 100 * display.mask_shares[i]);
    if (display.depths_beyond > 0)
        std::cout << fmt::format("depth.png: {} depths lie beyond the encoding and are 0 there\n",
                                 display.depths_beyond);
}

void render_command(const RenderOptions& options, const std::optional<double>& time_limit) {
    // Everything is checked before anything is computed or written.
    const auto progress_style = Progress::style_from_name(options.progress);
    if (time_limit) require_option(*time_limit > 0, "time-limit", *time_limit, "above 0 s");
    render_settings(options);  // the number of threads is one of them
    set_thread_count(options.threads);
    const FrameSettings settings(options);
    FrameScene scene = load_frame_scene(options);
    find_camera(scene.scene, options.camera);
    prepare_folder(options);

    catch_interrupts();
    const std::string exr = options.output + "/frame.exr";
    std::optional<RenderedFrame> frame;
    {
        Progress progress(progress_style, "rendering");
        frame = time_limit
                    ? render_frame_in_time(
                          std::move(scene), options, settings, exr, *time_limit,
                          [&](double) { return progress.update(std::min(1.0, process_seconds() / *time_limit)); })
                    : render_frame(std::move(scene), options, settings, exr,
                                   [&](double done) { return progress.update(done); });
    }
    DisplaySettings display = settings.display;
    display.ev100 = frame->ev100;
    display.text = display_text(*frame);
    const std::vector<double>& intensities = frame->header.intensities;
    const DisplayReport shown = write_display_files(options.output, exr, intensities, display);
    write_text(options.output + "/frame.json",
               json_text(frame_json(frame->header, frame->ev100, frame->report.counters, frame->objects), 2) + "\n");
    report(options, frame->report, shown, frame->ev100, intensities);
    require_valid_samples(*frame, options.output);
}

}  // namespace

void add_render_command(CLI::App& app) {
    auto* command = app.add_subcommand("render", "one frame of a glTF scene, clean and in the rain");
    auto options = std::make_shared<RenderOptions>();
    add_render_options(*command, *options);
    auto time_limit = std::make_shared<std::optional<double>>();
    // Of this command alone: the items of a dataset have the counts that its file says.
    command
        ->add_option("--target-error", options->target_error,
                     "take as many samples as this needs: square root of the trimmed relMSE (validate compare), of the "
                     "clean picture and of the highest intensity's; a pilot chooses, the frame records --spp")
        ->group("Accuracy")
        ->excludes("--spp");
    command
        ->add_option("--time-limit", *time_limit,
                     "seconds, files included: take as many samples as fit, one at least; the frame records --spp. "
                     "Sums stay in memory, about 100 bytes a pixel and as many for each intensity")
        ->group("Accuracy")
        ->excludes("--spp")
        ->excludes("--target-error");
    command->callback([options, time_limit] { render_command(*options, *time_limit); });
}

}  // namespace pluvia
