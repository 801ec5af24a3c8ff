// `pluvia labels`: what frames rendered with --layers hold, in other layouts, and proven.
#include "renderer/core/error.h"
#include "tools/commands.h"
#include "tools/labels/label_check.h"
#include "tools/labels/label_export.h"

#include <fmt/format.h>

#include <iostream>

namespace pluvia {
namespace {

struct LabelsOptions {
    std::vector<std::string> frames;
    std::string output, format;
};

std::vector<LabelSource> sources(const LabelsOptions& o) {
    std::vector<LabelSource> list;
    for (const std::string& folder : o.frames) list.push_back(label_source(folder));
    return list;
}

void export_command(const LabelsOptions& o) {
    export_labels(sources(o), o.format, o.output);
    std::cout << fmt::format("{}: labels of {} frame{} in the layout {}\n", o.output, o.frames.size(),
                             o.frames.size() == 1 ? "" : "s", o.format);
}

void check_command(const LabelsOptions& o) {
    size_t faults = 0;
    for (const LabelSource& source : sources(o)) {
        LabelFrame frame(source);
        const LabelCheck check = check_labels(frame);
        for (const std::string& fault : check.faults) std::cout << fault << "\n";
        std::cout << fmt::format(
            "{}: {} labelled pixels, {} boxes, {} pixels of flow, {} of them of what moves; {} "
            "not compared; off by {:.2g} pixels at most\n",
            source.name, check.labelled_pixels, check.boxes, check.flow_pixels, check.moving_pixels,
            check.left_out_pixels, check.largest_flow_error);
        faults += check.faults.size();
    }
    if (faults > 0)
        throw Error(ExitCode::check_failed, "labels", fmt::format("{} fault{} found", faults, faults == 1 ? "" : "s"));
}

}  // namespace

void add_labels_command(CLI::App& app) {
    auto* command = app.add_subcommand("labels", "labels of frames in the layouts of other datasets, and proven");
    command->require_subcommand(1);
    command->footer(
        "Example:\n  pluvia render lane.glb --layers all -o out/lane && pluvia labels export out/lane --format coco "
        "-o out/coco");
    auto o = std::make_shared<LabelsOptions>();
    auto* sub = command->add_subcommand("export", "write labels of frames as another dataset has them");
    sub->add_option("frames", o->frames, "folders of pluvia render --layers ...")->required();
    sub->add_option("-o,--output", o->output, "folder")->required();
    sub->add_option("--format", o->format, fmt::format("{}", fmt::join(label_formats(), ", ")))->required();
    sub->footer("Example:\n  pluvia labels export out/lane --format cityscapes -o out/cityscapes");
    sub->callback([o] { export_command(*o); });
    sub = command->add_subcommand("check", "prove that classes, instances, boxes, depth, poses and flow agree");
    sub->add_option("frames", o->frames, "folders of pluvia render --layers ...")->required();
    sub->footer("Example:\n  pluvia labels check out/lane");
    sub->callback([o] { check_command(*o); });
}

}  // namespace pluvia
