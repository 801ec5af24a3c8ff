#include "tools/dataset/item_render.h"

#include "renderer/core/error.h"
#include "tools/dataset/file_hash.h"
#include "tools/dataset/item_files.h"
#include "tools/dataset/layer_check.h"
#include "tools/dataset/work_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

Json record_json(const DatasetItem& item, const PictureFormat& format, const std::string& scene_hash,
                 const RenderedFrame& frame, const LayerCheck& check) {
    const RenderOptions& o = item.options;
    const Json described = frame_json(frame.header, frame.ev100, frame.report.counters);
    Json j;
    j["id"] = item.id();
    j["settings_hash"] = settings_hash(item, format, scene_hash);
    j["build"] = build_name();
    j["scene"] = item.scene_name, j["scene_hash"] = scene_hash;
    j["sequence"] = item.camera, j["frame"] = item.frame, j["split"] = item.split();
    j["hour"] = o.light.hour, j["wind"] = wind_name(o.wind), j["wind_m_per_s"] = o.wind;
    j["seed"] = o.seed, j["samples"] = o.spp;
    j["width"] = frame.header.view.width, j["height"] = frame.header.view.height, j["bits"] = format.bits,
    j["jpeg_quality"] = format.jpeg_quality;
    j["view"] = o.view, j["composition"] = o.composition;
    j["depth_max_m"] = o.depth_max;
    j["exposure_ev100"] = frame.ev100;
    j["residual"] = check.residual();
    j["camera"] = described.at("camera");
    if (described.contains("things_move")) j["things_move"] = described.at("things_move");
    if (!frame.objects.is_null()) j["objects"] = frame.objects;
    j["settings"] = frame.header.options;
    return j;
}

}  // namespace

void make_item(const std::string& dataset, const std::string& scratch, const DatasetItem& item,
               const PictureFormat& format, const FrameScene& scene, const std::string& scene_hash,
               std::optional<double> ev100, const ProgressCallback& progress) {
    FrameSettings settings(item.options);
    if (ev100) settings.ev100 = ev100;
    LayerCheck check(item.options.rain);
    const std::string exr = scratch + "/layers.exr";
    const RenderedFrame frame =
        render_frame(scene, item.options, settings, exr, progress, [&](const Band& band) { check.look(band); });
    const int64_t invalid = frame.report.counters.invalid_samples;
    if (invalid > 0 || check.not_finite() > 0)
        throw Error(ExitCode::some_failed, item.id(),
                    fmt::format("{} samples and {} values of layers are not finite", invalid, check.not_finite()));
    if (!(check.residual() <= residual_limit))
        throw Error(
            ExitCode::some_failed, item.id(),
            fmt::format(
                "the layers do not add up to the rainy picture (got a relative error of {:g}, expected up to {:g})",
                check.residual(), residual_limit));

    DisplaySettings display = settings.display;
    display.ev100 = frame.ev100;
    display.text = display_text(frame);
    const ItemFiles made = write_item_files(scratch, exr, item, format, frame, display);
    Record record{record_json(item, format, scene_hash, frame, check)};
    record.json.update(made.frame);
    record.json["pairs"] = made.pairs;
    std::vector<RecordedFile> files;
    for (const StoredFile& file : made.files)
        files.push_back({file.path, std::filesystem::file_size(file.temporary), hash_file(file.temporary)});
    record.set_files(files);
    const std::string record_file = scratch + "/record.json";
    write_text(record_file, json_text(record.json, 1) + "\n");

    const auto old = read_record(dataset, item);
    for (const StoredFile& file : made.files) move_into_place(file.temporary, dataset + "/" + file.path);
    move_into_place(record_file, dataset + "/" + item.record_path());
    std::error_code ignored;
    if (old) {
        std::set<std::string> kept;
        for (const RecordedFile& file : files) kept.insert(file.path);
        for (const RecordedFile& file : old->files())
            if (!kept.contains(file.path)) std::filesystem::remove(dataset + "/" + file.path, ignored);
    }
    if (!format.exr) std::filesystem::remove(exr, ignored);
}

}  // namespace pluvia
