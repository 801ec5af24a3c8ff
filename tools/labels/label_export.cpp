#include "tools/labels/label_export.h"

#include "renderer/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace pluvia {

const std::vector<std::string>& label_formats() {
    static const std::vector<std::string> names = {"cityscapes", "kitti", "coco", "carla", "carla-0.9.13", "flo"};
    return names;
}

void export_labels(const std::vector<LabelSource>& frames, const std::string& format, const std::string& folder) {
    if (std::find(label_formats().begin(), label_formats().end(), format) == label_formats().end())
        throw usage_error("--format", fmt::format("there is no format \"{}\" (expected {})", format,
                                                  fmt::join(label_formats(), ", ")));
    std::set<std::string> names;
    for (const LabelSource& source : frames) {
        if (!names.insert(source.name).second)
            throw usage_error(
                source.exr,
                fmt::format("two frames are named \"{}\" (expected a name of its own for each)", source.name));
    }
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw Error(ExitCode::render_failed, folder, fmt::format("cannot be made ({})", error.message()));
    if (format == "kitti") return export_kitti(frames, folder);
    if (format == "coco") return export_coco(frames, folder);
    for (const LabelSource& source : frames) {
        LabelFrame frame(source);
        if (format == "cityscapes")
            export_cityscapes(frame, folder);
        else if (format == "flo")
            export_flo(frame, folder);
        else
            export_carla(frame, folder, format == "carla-0.9.13");
    }
}

}  // namespace pluvia
