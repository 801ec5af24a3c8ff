// `pluvia dataset`: one command for each stage in the life of a dataset.
#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "tools/commands.h"
#include "tools/dataset/check.h"
#include "tools/dataset/export.h"
#include "tools/dataset/figure.h"
#include "tools/dataset/manifest.h"
#include "tools/dataset/plan.h"
#include "tools/dataset/report.h"
#include "tools/dataset/run.h"
#include "tools/dataset/video.h"
#include "tools/frame_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <optional>

namespace pluvia {
namespace {

struct DatasetOptions {
    std::string config, output;
    int threads = 0;
    bool json = false;
    std::string shard = "1/1", only, progress = "bar";
    bool no_sample = false;
    std::vector<std::string> from;
    std::string format = "hri", to, picture = "rainy_image";
    ReportSettings report;
    FigureSettings figure;
};

std::string plural(size_t count, const std::string& word) {
    return fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
}

void plan(const DatasetOptions& o, const DatasetConfig& config) {
    catch_interrupts();
    std::optional<Progress> progress;
    if (!o.no_sample) progress.emplace(Progress::style_from_name(o.progress), "measuring");
    const auto plan = dataset_plan(config, o.output, progress ? &*progress : nullptr);
    progress.reset();
    std::cout << (o.json ? json_text(plan, 2) + "\n" : plan_text(plan));
}

void status(const DatasetOptions& o, const DatasetConfig& config) {
    const auto status = dataset_status(config, o.output);
    std::cout << (o.json ? json_text(status, 2) + "\n" : status_text(status));
}

void run(const DatasetOptions& o, const DatasetConfig& config) {
    RunSettings settings;
    settings.shard = Shard::parse(o.shard);
    settings.only = o.only;
    settings.progress = Progress::style_from_name(o.progress);
    catch_interrupts();
    const RunResult result = run_dataset(config, o.output, settings);
    std::cout << fmt::format("{}: {} made, {} done before, {} failed\n", o.output, plural(result.made, "frame"),
                             result.already_done, result.failed);
    // A shard cannot know whether it is the last one.
    if (settings.shard.count == 1) merge_dataset(config, o.output, false);
    if (result.failed > 0)
        throw Error(ExitCode::some_failed, o.output,
                    fmt::format("{} failed; failed.jsonl names them after a merge", plural(result.failed, "frame")));
}

void merge(const DatasetOptions& o, const DatasetConfig& config) {
    const size_t missing = merge_dataset(config, o.output, true, o.from);
    if (missing > 0)
        throw Error(ExitCode::some_failed, o.output,
                    fmt::format("{} missing; failed.jsonl names them for pluvia dataset run --only",
                                missing == 1 ? "1 frame is" : fmt::format("{} frames are", missing)));
    std::cout << fmt::format("{}: all frames are there, lists are written\n", o.output);
}

void check(const DatasetOptions& o, const DatasetConfig& config) {
    const CheckReport report = check_dataset(config, o.output);
    for (const std::string& warning : report.warnings) std::cerr << "pluvia: warning: " << warning << "\n";
    if (o.json) {
        const nlohmann::ordered_json j{{"frames", report.frames},
                                       {"missing", report.missing},
                                       {"files", report.files},
                                       {"warnings", report.warnings},
                                       {"faults", report.faults}};
        std::cout << json_text(j, 2) << "\n";
    } else {
        for (const std::string& fault : report.faults) std::cout << fault << "\n";
        std::cout << fmt::format("{}, {}, {}\n", plural(report.frames, "frame"), plural(report.files, "file"),
                                 plural(report.faults.size(), "fault"));
    }
    if (!report.faults.empty())
        throw Error(ExitCode::check_failed, o.output,
                    fmt::format("{} found; pluvia dataset run repairs frames, merge the lists",
                                plural(report.faults.size(), "fault")));
}

void export_command(const DatasetOptions& o, const DatasetConfig& config) {
    const std::string to = o.to.empty() ? o.output + "-" + o.format : o.to;
    const size_t pairs = export_dataset(config, o.output, o.format, to);
    std::cout << fmt::format("{}: {} exported in the layout {}\n", to, pairs, o.format);
}

void report(const DatasetOptions& o, const DatasetConfig& config) {
    std::cout << write_report(config, o.output, o.report) << "\n";
}

void figure(const DatasetOptions& o, const DatasetConfig& config) {
    catch_interrupts();
    std::cout << write_figure(config, o.output, o.figure, Progress::style_from_name(o.progress)) << "\n";
}

void video(const DatasetOptions& o, const DatasetConfig& config) {
    for (const std::string& file : write_videos(config, o.output, o.picture)) std::cout << file << "\n";
}

using Action = void (*)(const DatasetOptions&, const DatasetConfig&);

}  // namespace

void add_dataset_command(CLI::App& app) {
    auto* command = app.add_subcommand(
        "dataset", "many frames from a configuration file: planned, rendered, resumed, split over machines and proven");
    command->require_subcommand(1);
    command->footer(
        "Configurations that come with Pluvia: scenes/hri.yaml, hri-physical.yaml, hri-smoke.yaml,\n"
        "extremerain.yaml, extremerain-smoke.yaml; template.yaml explains every key.\n"
        "Example:\n  pluvia dataset plan scenes/hri.yaml -o out/hri --no-sample");
    auto o = std::make_shared<DatasetOptions>();
    const auto add = [&](const char* name, const char* text, const char* example, Action action) {
        auto* sub = command->add_subcommand(name, text);
        sub->add_option("config", o->config, "configuration, YAML")->required();
        sub->add_option("-o,--output", o->output, "folder of the dataset")->required();
        sub->add_option("--threads", o->threads, "0 = all; changes no byte")->capture_default_str();
        sub->footer(fmt::format("Example:\n  pluvia dataset {}", example));
        sub->callback([o, action] {
            if (o->threads < 0)
                throw usage_error("--threads", fmt::format("is not valid (got {}, expected 0 or more)", o->threads));
            set_thread_count(o->threads);
            action(*o, read_dataset_config(o->config));
        });
        return sub;
    };
    const auto add_json = [&](CLI::App* sub) { sub->add_flag("--json", o->json, "print the result as JSON"); };
    const auto add_progress = [&](CLI::App* sub) {
        sub->add_option("--progress", o->progress, "bar, json or none, on stderr")->capture_default_str();
    };

    auto* sub = add("plan", "frames, hours, machines and disk, before anything is made",
                    "plan scenes/hri.yaml -o out/hri --no-sample", plan);
    sub->add_flag("--no-sample", o->no_sample, "counts only; without it parts of some frames are measured");
    add_progress(sub);
    add_json(sub);
    sub = add("run", "make the frames that are not done; what is done is verified and left alone",
              "run scenes/hri-smoke.yaml -o out/smoke --shard 1/4", run);
    sub->add_option("--shard", o->shard, "I/N: the I-th of N parts; merge joins them")->capture_default_str();
    sub->add_option("--only", o->only, "frames that a file of JSON lines with \"id\" names, as failed.jsonl");
    add_progress(sub);
    add_json(add("status", "how far runs are", "status scenes/hri.yaml -o out/hri", status));
    sub = add("merge", "write the lists, the card and the metadata anew when all runs have ended",
              "merge scenes/hri-smoke.yaml -o out/smoke", merge);
    sub->add_option("--from", o->from, "folders of other machines whose frames are copied first");
    add_json(add("check", "prove that every file, list and number of a dataset is right",
                 "check scenes/hri-smoke.yaml -o out/smoke", check));
    sub = add("export", "the dataset in another layout", "export scenes/hri-smoke.yaml -o out/smoke --format hf",
              export_command);
    sub->add_option("--format", o->format, fmt::format("{}", fmt::join(export_formats(), ", ")))->capture_default_str();
    sub->add_option("--to", o->to, "new folder; default: that of the dataset and the format's name");
    sub = add("report", "one HTML page to look at the dataset", "report scenes/hri-smoke.yaml -o out/smoke", report);
    sub->add_option("--frames", o->report.frames, "frames shown, spread over the dataset")->capture_default_str();
    sub = add("video", "a clip of every sequence, by ffmpeg where it is installed",
              "video scenes/extremerain-smoke.yaml -o out/extremerain", video);
    sub->add_option("--picture", o->picture, "rainy_image or background")->capture_default_str();
    sub = add("figure", "a scene at several hours, intensities and winds, as one picture and a page",
              "figure scenes/hri-smoke.yaml -o out/figure --hours 8,20 --winds=-4,4", figure);
    sub->add_option("--scene", o->figure.scene, "default: the first of the configuration");
    sub->add_option("--camera", o->figure.camera, "default: the scene's first");
    sub->add_option("--hours", o->figure.hours, "rows, e.g. 8,12,20")->delimiter(',')->capture_default_str();
    sub->add_option("--winds", o->figure.winds, "columns, m/s along X, e.g. -4,0,4; beside every intensity")
        ->delimiter(',')
        ->capture_default_str();
    add_progress(sub);
}

}  // namespace pluvia
