#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/image/color.h"
#include "renderer/image/image_io.h"
#include "shaders/streak_files.h"
#include "tools/commands.h"
#include "tools/option_check.h"
#include "tools/streak_cache.h"

#include <algorithm>
#include <iostream>
#include <memory>
#include <mutex>

namespace pluvia {
namespace {

struct StreaksOptions {
    std::string folder, output, progress = "bar";
    std::vector<int> widths = {8};
    int rays = StreakTracing().rays_per_pixel, oscillation = 0, width = 0, threads = 0;
    uint64_t seed = 0;
};

bool is_width(int width) {
    return width == 4 || width == 8 || width == 16 || width == 32;
}

void build(const StreaksOptions& o) {
    for (const int width : o.widths)
        if (!is_width(width)) fail_option("widths", fmt::format("{}", width), "of 4, 8, 16 and 32");
    if (o.widths.empty()) fail_option("widths", "nothing", "of 4, 8, 16 and 32");
    require_option(o.rays >= 1 && o.rays <= 1000000, "rays", o.rays, "1 to 1000000");
    const Progress::Style style = Progress::style_from_name(o.progress);
    set_thread_count(o.threads);
    catch_interrupts();
    StreakTracing settings;
    settings.width = *std::max_element(o.widths.begin(), o.widths.end());
    settings.rays_per_pixel = o.rays;
    settings.seed = o.seed;
    const StreakDatabase widest = trace_streaks_with_progress(settings, style);
    std::vector<StreakDatabase> databases;
    for (const int width : o.widths)
        databases.push_back(width == settings.width ? widest : narrowed(widest, settings.width / width));
    Progress progress(style, "files");
    std::mutex mutex;
    write_streaks(o.output, databases, [&](double done) {
        const std::lock_guard lock(mutex);
        if (!progress.update(done)) throw Error(ExitCode::stopped_early, o.output, "stopped before the end");
    });
    const size_t pictures = o.widths.size() * streak_views.size() * streak_oscillations * (streak_light_count + 1);
    std::cout << fmt::format("{}: {} pictures\n", o.output, pictures);
}

/// All lights and views of one oscillation: views below each other, elevations from left to right with their azimuths
/// side by side. Every picture is scaled to its own maximum.
Image<uint8_t> contact_sheet(const StreakDatabase& database, int oscillation) {
    constexpr int gap = 2, group_gap = 10;
    const int cell = database.views[0].width + gap;
    std::vector<int> columns;
    int width = group_gap;
    for (int i = 0; i < streak_light_count; ++i) {
        if (i > 0 && streak_light(i).elevation != streak_light(i - 1).elevation) width += group_gap;
        columns.push_back(width);
        width += cell;
    }
    int height = group_gap;
    for (const auto& view : database.views) height += view.height + group_gap;
    Image<uint8_t> sheet(width + group_gap, height, 24);
    int y = group_gap;
    for (const auto& view : database.views) {
        for (int i = 0; i < streak_light_count; ++i) {
            const auto& values = view.picture(i, oscillation).values;
            for (int row = 0; row < view.height; ++row)
                for (int x = 0; x < view.width; ++x)
                    sheet.at(columns[size_t(i)] + x, y + row) =
                        byte_from_display(srgb_from_linear(float(values[size_t(row * view.width + x)]) / 65535));
        }
        y += view.height + group_gap;
    }
    return sheet;
}

void show(const StreaksOptions& o) {
    require_option(o.oscillation >= 0 && o.oscillation < streak_oscillations, "oscillation", o.oscillation, "0 to 9");
    if (o.width != 0 && !is_width(o.width)) fail_option("width", fmt::format("{}", o.width), "4, 8, 16 or 32");
    const StreakDatabase database = o.folder.empty()
                                        ? cached_streaks(StreakTracing(), Progress::style_from_name(o.progress))
                                        : read_streaks(o.folder, o.width);
    const Image<uint8_t> sheet = contact_sheet(database, o.oscillation);
    PngWriter writer(o.output, sheet.width, sheet.height, 1, 8,
                     {{"Software", std::string("Pluvia ") + PLUVIA_VERSION}});
    writer.write_rows(0, sheet.height, sheet.pixels.data());
    writer.finish();
}

}  // namespace

void add_streaks_command(CLI::App& app) {
    auto* command = app.add_subcommand("streaks", "the database of streaks of the paper's composition");
    command->require_subcommand(1);
    auto options = std::make_shared<StreaksOptions>();
    StreaksOptions& o = *options;

    auto* build_command = command->add_subcommand("build", "traces the database into Garg and Nayar's files");
    build_command->add_option("-o,--output", o.output, "new folder")->required();
    build_command->add_option("--widths", o.widths, "pixels across a drop, of 4,8,16,32")
        ->delimiter(',')
        ->capture_default_str();
    build_command->add_option("--rays", o.rays, "per pixel of the widest pictures")->capture_default_str();
    build_command->add_option("--seed", o.seed, "of the oscillations")->capture_default_str();
    build_command->add_option("--threads", o.threads, "0 = all; changes no byte")->capture_default_str();
    build_command->add_option("--progress", o.progress, "bar, json or none, on stderr")->capture_default_str();
    build_command->footer("Example:\n  pluvia streaks build --widths 4,8,16 -o streaks");
    build_command->callback([options] { build(*options); });

    auto* show_command = command->add_subcommand(
        "show",
        "one oscillation under all lights, each picture scaled to its maximum: views from 0 to 80 degrees "
        "downwards, lights from below to above and from the camera's side to behind the drop to the right");
    show_command->add_option("folder", o.folder, "database in the published layout; default: Pluvia's own");
    show_command->add_option("-o,--output", o.output, "PNG file")->required();
    show_command->add_option("--width", o.width, "of the pictures; default: the first of 16, 8, 32, 4");
    show_command->add_option("--oscillation", o.oscillation, "0 to 9")->capture_default_str();
    show_command->add_option("--progress", o.progress, "bar, json or none, on stderr")->capture_default_str();
    show_command->footer("Example:\n  pluvia streaks show -o streaks.png");
    show_command->callback([options] { show(*options); });
}

}  // namespace pluvia
