#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/image/color.h"
#include "renderer/image/image_io.h"
#include "tools/frame_render.h"
#include "tools/learn/learn_commands.h"
#include "tools/learn/picture_files.h"
#include "tools/learning/crig_config.h"
#include "tools/progress.h"
#include "tools/validate/known_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

struct MaskOptions {
    RenderOptions render;
    int frames = 1;
};

/// Open ground under a uniform sky, seen from eye height: nothing that stands before the rain.
FrameScene open_ground() {
    FrameScene frame;
    frame.scene = make_plane(lambert(Rgb(0.2f)));
    frame.scene.name = "open ground";
    Camera camera;
    camera.name = "eye";
    camera.scene_from_camera.translation = {0, 1.6f, 0};
    frame.scene.cameras.push_back(camera);
    frame.hash = content_hash(frame.scene);
    return frame;
}

/// Coverage of the streaks of each intensity, 0..1.
std::vector<Image<float>> streak_coverage(const FrameSettings& settings, const View& view, const Scene& scene,
                                          const ProgressCallback& progress) {
    const auto& intensities = settings.render.rain.intensities_mm_per_h;
    std::vector<Image<float>> coverage(intensities.size(), Image<float>(view.width, view.height));
    const auto channels = layer_channels(intensities);
    render(
        scene, settings.environment, view, settings.render,
        [&](const Band& band) {
            for (size_t i = 0; i < intensities.size(); ++i) {
                const std::string name = "rain_" + intensity_label(intensities[i]) + ".A";
                const auto channel = std::find(channels.begin(), channels.end(), name) - channels.begin();
                const auto& plane = band.planes[size_t(channel)];
                std::copy(plane.begin(), plane.end(), &coverage[i].at(0, band.y));
            }
        },
        progress);
    return coverage;
}

/// The coverage as grey and as alpha: readers of HRI's layers look at alpha, those of CRIGNet's and RainControlNet's
/// pictures (white streaks on black) at a colour.
void write_layer(const std::string& path, const Image<float>& coverage, const PngText& text) {
    std::vector<uint8_t> bytes;
    bytes.reserve(coverage.pixels.size() * 4);
    for (const float a : coverage.pixels) bytes.insert(bytes.end(), 4, byte_from_display(a));
    PngWriter writer(path, coverage.width, coverage.height, 4, 8, text);
    writer.write_rows(0, coverage.height, bytes.data());
    writer.finish();
}

void mask_command(MaskOptions o) {
    RenderOptions& r = o.render;
    r.composition = "paper";
    r.light.environment = "1,1,1";
    if (r.rain.empty()) throw usage_error("--rain", "names no intensity (expected one or more, mm/h)");
    if (o.frames < 1 || o.frames > 1'000'000)
        throw usage_error("--frames", fmt::format("is not valid (got {}, expected 1 to 1000000)", o.frames));
    const auto style = Progress::style_from_name(r.progress);
    set_thread_count(r.threads);
    const FrameScene scene = open_ground();
    std::error_code error;
    fs::create_directories(r.output, error);
    if (error) throw Error(ExitCode::render_failed, r.output, fmt::format("cannot be made ({})", error.message()));
    catch_interrupts();
    Progress progress(style, "masks");
    int kept = 0;
    std::vector<LabelledPicture> list;
    for (r.frame = 0; r.frame < o.frames; ++r.frame) {
        const auto name_of = [&](double intensity) {
            return fmt::format("{}mm_frame_{:04}.png", intensity_label(intensity), r.frame);
        };
        const auto path_of = [&](double intensity) { return r.output + "/" + name_of(intensity); };
        for (const double i : r.rain)
            list.push_back({name_of(i), i / crig_mm_per_h - 1, r.wind.empty() ? 0.0 : double(r.wind[0])});
        const bool all_there =
            std::all_of(r.rain.begin(), r.rain.end(), [&](double i) { return fs::exists(path_of(i)); });
        if (all_there && !r.overwrite) {
            ++kept;
            continue;
        }
        const FrameSettings settings(r);
        const View view = make_view(scene.scene.cameras.front(), settings.camera);
        const auto coverage = streak_coverage(
            settings, view, scene.scene, [&](double done) { return progress.update((r.frame + done) / o.frames); });
        for (size_t i = 0; i < r.rain.size(); ++i)
            write_layer(path_of(r.rain[i]), coverage[i], {{"pluvia:settings", json_text(to_json(r))}});
    }
    write_picture_labels(r.output + "/data_info.json", list);
    std::cout << fmt::format("{}: {} rain layers, {} of them were there already\n", r.output,
                             size_t(o.frames) * r.rain.size(), size_t(kept) * r.rain.size());
}

}  // namespace

void add_learn_mask_command(CLI::App& learn) {
    auto* command = learn.add_subcommand(
        "mask",
        "Rain layers from mm/h and wind, for pictures without depth: streaks of simulated drops in front of open\n"
        "ground, as the paper composes them, alpha being their coverage. Stands in for the published networks CRIGNet\n"
        "and RainControlNet, which draw such layers at 256 and 512 pixels, and keeps their contract: white streaks on\n"
        "black, and data_info.json with a label of each picture, intensity / 50 mm/h - 1 and wind along X in m/s (the\n"
        "scale of CRIGNet's own wind, -1 to 1, is not known). No libtorch is needed.");
    auto options = std::make_shared<MaskOptions>();
    options->render.size = "2048x1024";
    options->render.spp = 16;
    RenderOptions& r = options->render;
    command->add_option("--rain", r.rain, "intensities, mm/h")->delimiter(',')->required();
    command->add_option("--wind", r.wind, "X,Y,Z in m/s; x to the right, z towards the camera")->delimiter(',');
    command->add_option("--size", r.size, "WIDTHxHEIGHT, pixels")->capture_default_str();
    command->add_option("--frames", options->frames, "of a sequence: drops fall on from frame to frame")
        ->capture_default_str();
    command->add_option("--fps", r.fps, "frames per second")->capture_default_str();
    command->add_option("--camera-velocity", r.camera_velocity, "X,Y,Z in m/s")->delimiter(',');
    command->add_option("--focal-length", r.focal_length, "mm, of a sensor 36 mm wide; default: 34 degrees of height");
    command->add_option("--shutter", r.shutter, "exposure time, s")->capture_default_str();
    command
        ->add_option("--streak-distance", r.streak_distance,
                     "metres beyond which drops are drawn as wide as at it; 1.78 = the published code, 0 = true width")
        ->capture_default_str();
    command
        ->add_option("--streak-share", r.streak_share, "share of the drops that is drawn; 0.024 = the published code")
        ->capture_default_str();
    command->add_option("--spp", r.spp, "samples per pixel")->capture_default_str();
    command->add_option("--seed", r.seed, "another seed, other drops")->capture_default_str();
    command->add_option("--threads", r.threads, "0: all")->capture_default_str();
    command->add_option("-o,--output", r.output, "folder of the layers, PNG with alpha")->required();
    command->add_flag("--overwrite", r.overwrite, "make layers that are there again");
    command->add_option("--progress", r.progress, "bar, json or none")->capture_default_str();
    command->footer("Example:\n  pluvia learn mask --rain 10,50 --wind 2,0,0 --size 2048x1024 -o masks");
    command->callback([options] { mask_command(*options); });
}

}  // namespace pluvia
