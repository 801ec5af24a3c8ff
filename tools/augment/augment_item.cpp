#include "tools/augment/augment_item.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/core/random.h"
#include "renderer/image/color.h"
#include "renderer/image/exposure.h"
#include "renderer/image/exr.h"
#include "renderer/image/image_io.h"
#include "renderer/transport/picture_scene.h"
#include "tools/augment/augment_files.h"
#include "tools/augment/picture_exposure.h"
#include "tools/dataset/file_hash.h"
#include "tools/dataset/record.h"
#include "tools/dataset/work_folder.h"
#include "tools/frame_render.h"
#include "tools/option_check.h"
#include "tools/validate/exr_layers.h"

#include <filesystem>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

/// ev100: what the file says, else that of a light meter.
Image<Rgb> read_exr_picture(const std::string& path, double& ev100, std::string& by) {
    ExrReader exr(path);
    const ExrLayer layer = find_layer(exr.channels(), "", path);
    if (layer.channels.size() != 3) throw input_error(path, "has no colour");
    std::array<std::vector<float>, 3> planes;
    std::vector<ExrRequest> requests;
    for (size_t c = 0; c < 3; ++c) {
        planes[c].resize(size_t(exr.width()) * size_t(exr.height()));
        requests.push_back({layer.channels[c], planes[c].data()});
    }
    exr.read_rows(0, exr.height(), requests);
    Image<Rgb> image(exr.width(), exr.height());
    LuminanceHistogram histogram;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = {planes[0][i], planes[1][i], planes[2][i]};
        if (!is_finite(image.pixels[i])) throw input_error(path, "holds values that are not finite");
        histogram.add(image.pixels[i]);
    }
    const auto known = exr.attributes().find("pluvia:exposure_ev100");
    const bool has_exposure = known != exr.attributes().end() && std::holds_alternative<float>(known->second);
    ev100 = has_exposure ? double(std::get<float>(known->second)) : histogram.auto_ev100();
    by = has_exposure ? "file" : "light meter";
    return image;
}

void make_linear(Image<Rgb>& coded) {
    parallel_for(coded.height, [&](int y) {
        for (int x = 0; x < coded.width; ++x) {
            Rgb& c = coded.at(x, y);
            c = {linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)};
        }
    });
}

Json item_json(const AugmentItem& item, const AugmentSettings& settings, const PictureInput& picture,
               const FrameHeader& header, const RenderReport& report, const AugmentedFiles& made,
               const std::string& hash) {
    Json j = frame_json(header, picture.ev100, report.counters);
    j["id"] = item.name;
    j["settings_hash"] = hash;
    j["build"] = build_name();
    j["scene_hash"] = fmt::format("{:016x}", header.scene_hash);
    j["depth"] = {{"encoding", depth_input_names()[size_t(item.format.encoding)]},
                  {"filled_pixels", picture.filling.filled},
                  {"sky_pixels", picture.filling.sky},
                  {"assumed_sky_pixels", picture.filling.assumed_sky}};
    j["exposure_from"] = picture.exposed_by;
    j["environment"] = settings.environment ? "given" : "estimated";
    j["streaks"] = report.streaks;
    for (size_t i = 0; i < header.intensities.size(); ++i)
        j["pairs"].push_back({{"intensity", header.intensities[i]},
                              {"coverage", made.coverages[i]},
                              {"mask_share", made.mask_shares[i]}});
    return j;
}

/// Copies beside the other files, so that it appears whole.
void copy_label(const AugmentItem::Copy& label, const std::string& scratch, size_t number, AugmentedFiles& made) {
    const std::string temporary =
        fmt::format("{}/label_{}{}", scratch, number, std::filesystem::path(label.from).extension().string());
    std::error_code error;
    std::filesystem::copy_file(label.from, temporary, error);
    if (error) throw input_error(label.from, fmt::format("cannot be copied ({})", error.message()));
    made.files.emplace_back(temporary, label.to);
}

}  // namespace

AugmentSettings::AugmentSettings(const AugmentOptions& o) : options(o), render(render_settings(o.render)) {
    if (o.render.rain.empty()) fail_option("rain", "nothing", "intensities in mm/h such as 10,50");
    if (o.curve != "srgb" && o.curve != "linear") fail_option("curve", '"' + o.curve + '"', "srgb or linear");
    if (o.fov) require_option(*o.fov > 0 && *o.fov < 180, "fov", *o.fov, "above 0, below 180 degrees");
    if (o.fov && o.render.focal_length) fail_option("fov", "--focal-length beside it", "one of the two");
    if (o.baseline)
        require_option(*o.baseline > 0 && *o.baseline <= 100, "baseline", *o.baseline, "above 0, up to 100 m");
    if (o.delta_only && !o.labels.empty()) fail_option("labels", "--delta-only beside it", "one of the two");
    camera_settings(o.render);
    ev100 = exposure_ev100(o.render);
    if (!o.render.light.environment.empty()) environment = make_environment(o.render.light, true);
    render.streaks.textures = streak_textures(o.render);
}

PictureInput read_picture(const AugmentItem& item, const AugmentSettings& settings) {
    PictureInput picture;
    bool in_nits = true;
    if (is_exr(item.picture)) {
        picture.source.radiance = read_exr_picture(item.picture, picture.ev100, picture.exposed_by);
    } else {
        const bool is_float = read_image_info(item.picture).is_float;
        picture.source.radiance = is_float ? read_radiance(item.picture) : read_display(item.picture);
        if (!is_float && settings.options.curve == "srgb") make_linear(picture.source.radiance);
        in_nits = false;
    }
    const Image<Rgb>& p = picture.source.radiance;
    DepthFormat format = item.format;
    if (format.lidar && format.lidar->width == 0) {
        LidarProjection lidar = *format.lidar;
        lidar.width = p.width, lidar.height = p.height;
        format.lidar = std::make_shared<LidarProjection>(lidar);
    }
    picture.source.z = read_depth(item.depth, format);
    const Image<float>& z = picture.source.z;
    if (p.width != z.width || p.height != z.height)
        throw input_error(item.depth, fmt::format("is of another size than {} (got {} x {}, expected {} x {})",
                                                  item.picture, z.width, z.height, p.width, p.height));
    picture.filling = fill_depth(picture.source.z, item.depth);
    if (settings.ev100) {
        picture.ev100 = *settings.ev100, picture.exposed_by = "given";
    } else if (!in_nits) {
        const ExposureEstimate estimate = estimate_exposure(p, picture.source.z);
        picture.ev100 = estimate.ev100, picture.exposed_by = estimate.by;
    }
    if (!in_nits) {
        const float white = 1 / exposure_scale(picture.ev100);
        for (Rgb& c : picture.source.radiance.pixels) c *= white;
    }
    return picture;
}

std::string settings_hash(const AugmentItem& item, const AugmentOptions& options) {
    // The number of the layout: files of items done by an older one are made anew.
    constexpr int layout = 2;
    const Transform& t = item.camera.world_from_camera;
    std::string camera = fmt::format("{} {} {} {}", item.camera.focal_pixels, item.camera.fov, item.camera.mid_exposure,
                                     item.camera.exposure_time.value_or(0));
    if (item.camera.centre) camera += fmt::format(" {} {}", item.camera.centre->x, item.camera.centre->y);
    const Transform lidar = item.format.lidar ? item.format.lidar->camera_from_lidar : Transform();
    for (const Vec3d v : {t.column_x, t.column_y, t.column_z, t.translation, item.camera.velocity, lidar.column_x,
                          lidar.column_y, lidar.column_z, lidar.translation})
        camera += fmt::format(" {} {} {}", v.x, v.y, v.z);
    return fmt::format(
        "{:016x}", hash_text(fmt::format("{} {} {} {} {} {} {} {} {}", layout, item.name, item.rain,
                                         json_text(to_json(options)), hash_file(item.picture), hash_file(item.depth),
                                         int(item.format.encoding), item.format.focal_times_baseline, camera)));
}

void augment_item(const AugmentItem& item, const AugmentSettings& settings, const std::string& scratch,
                  const std::string& hash, const ProgressCallback& progress) {
    if (!item.fault.empty()) throw input_error(item.name, item.fault);
    const AugmentOptions& options = settings.options;
    const PictureInput picture = read_picture(item, settings);
    const int width = picture.source.z.width, height = picture.source.z.height;
    const View view = picture_view(item.camera, width, height, options);
    const Scene scene = make_picture_scene(picture.source, view);
    const Environment environment =
        settings.environment ? *settings.environment : estimate_environment(picture.source, view);
    RenderSettings render_settings = settings.render;
    if (render_settings.streaks.tabled_veil)
        render_settings.streaks.far_light =
            std::make_shared<FarLight>(make_far_light(picture.source, view, environment));
    if (!item.rain.empty()) render_settings.rain.seed = hash_key(render_settings.rain.seed, hash_text(item.rain));

    const FrameHeader header{item.name,
                             content_hash(scene),
                             Vec3d(),
                             "picture",
                             view,
                             to_json(options),
                             render_settings.rain.intensities_mm_per_h};
    LayerPlanes layers(width, height, header.intensities);
    const RenderReport report = render(
        scene, environment, view, render_settings, [&](const Band& band) { layers.add(band); }, progress,
        &picture.source);
    if (report.counters.invalid_samples > 0)
        throw Error(ExitCode::some_failed, item.name,
                    fmt::format("{} samples are not finite", report.counters.invalid_samples));

    AugmentedFormat format;
    format.pictures = format.all_layers = !options.delta_only;
    format.exr = options.exr || options.delta_only;
    format.view = options.curve == "srgb" ? "srgb" : "raw";
    format.paper = render_settings.streaks.composition == Composition::paper;
    format.text = {{"Software", std::string("Pluvia ") + PLUVIA_VERSION},
                   {"pluvia:settings", json_text(header.options)},
                   {"pluvia:exposure_ev100", fmt::format("{}", picture.ev100)}};
    AugmentedFiles made = write_augmented_files(scratch, item.name, layers, header, picture.ev100, format);
    for (size_t i = 0; !options.delta_only && i < item.labels.size(); ++i) copy_label(item.labels[i], scratch, i, made);

    Record record{item_json(item, settings, picture, header, report, made, hash)};
    std::vector<RecordedFile> files;
    for (const auto& [temporary, path] : made.files)
        files.push_back({path, std::filesystem::file_size(temporary), hash_file(temporary)});
    record.set_files(files);
    const std::string record_file = scratch + "/record.json";
    write_text(record_file, json_text(record.json, 1) + "\n");
    const std::string& output = options.render.output;
    for (const auto& [temporary, path] : made.files) move_into_place(temporary, output + "/" + path);
    move_into_place(record_file, output + "/" + item.record_path());
}

}  // namespace pluvia
