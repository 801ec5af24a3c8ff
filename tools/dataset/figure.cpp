#include "tools/dataset/figure.h"

#include "renderer/core/error.h"
#include "renderer/image/exposure.h"
#include "tools/dataset/item.h"
#include "tools/dataset/scene_source.h"
#include "tools/dataset/thumbnail.h"
#include "tools/dataset/work_folder.h"
#include "tools/display_rows.h"
#include "tools/html_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace pluvia {
namespace {

constexpr int cell_width = 512, gap = 6;

/// A layer of a frame as displayed.
Image<Rgba8> picture(ExrReader& exr, const RenderedFrame& frame, const std::string& view_name, int intensity) {
    const DisplayView view(view_name);
    Image<Rgba8> image(exr.width(), exr.height());
    for (int y = 0; y < exr.height(); y += display_band_rows) {
        const FrameRows rows = read_frame_rows(exr, y, frame.header.intensities);
        const ColorPlanes& color = intensity < 0 ? rows.background : rows.rain[size_t(intensity)].rainy;
        const std::vector<uint8_t> bytes = display_bytes(displayed(rows, color, view, exposure_scale(frame.ev100)));
        for (size_t i = 0; i < rows.band_pixels(); ++i)
            image.pixels[size_t(y) * size_t(exr.width()) + i] = {bytes[3 * i], bytes[3 * i + 1], bytes[3 * i + 2]};
    }
    return shrunk(image, cell_width);
}

/// Cells of one size, white between them.
void write_grid(const std::string& path, const std::vector<std::vector<Image<Rgba8>>>& rows) {
    const int width = rows[0][0].width, height = rows[0][0].height;
    Image<Rgba8> grid((width + gap) * int(rows[0].size()) - gap, (height + gap) * int(rows.size()) - gap,
                      {255, 255, 255});
    for (size_t r = 0; r < rows.size(); ++r)
        for (size_t c = 0; c < rows[r].size(); ++c)
            for (int y = 0; y < height; ++y)
                std::copy_n(&rows[r][c].at(0, y), width, &grid.at(int(c) * (width + gap), int(r) * (height + gap) + y));
    PngWriter file(path, grid.width, grid.height, 4, 8);
    file.write_rows(0, grid.height, &grid.pixels[0].r);
    file.finish();
}

size_t chosen_scene(const DatasetConfig& config, const std::string& name) {
    for (size_t i = 0; i < config.scenes.size(); ++i)
        if (name.empty() || config.scenes[i].name == name) return i;
    throw usage_error("--scene", fmt::format("is not in {} (got \"{}\")", config.path, name));
}

}  // namespace

std::string write_figure(const DatasetConfig& config, const std::string& folder, const FigureSettings& settings,
                         Progress::Style style) {
    const size_t scene_index = chosen_scene(config, settings.scene);
    const DatasetScene& scene = config.scenes[scene_index];
    if (settings.hours.empty() || settings.winds.empty())
        throw usage_error("figure", "has no cells (expected at least one of --hours and --winds)");
    RenderOptions options = scene.options;
    options.camera = !settings.camera.empty() ? settings.camera : scene.train.empty() ? scene.test[0] : scene.train[0];
    const WorkFolder work(folder, {});
    SceneSource source(config, work.path());
    Progress progress(style, "figure");
    std::vector<std::vector<Image<Rgba8>>> rows;
    std::string table = "<tr><th></th><th>clean</th>";
    for (const double wind : settings.winds)
        for (const double intensity : options.rain)
            table += fmt::format("<th>{:g} mm/h, wind {:g} m/s</th>", intensity, wind);
    table += "</tr>";
    const double frames = double(settings.hours.size() * settings.winds.size());
    double done = 0;
    for (const double hour : settings.hours) {
        options.light.hour = hour;
        std::vector<Image<Rgba8>> row;
        for (const double wind : settings.winds) {
            options.wind = {wind, 0, 0};
            const FrameSettings checked(options);
            const std::string exr_path = work.path() + "/layers.exr";
            const RenderedFrame frame =
                render_frame(source.at(scene_index, options), options, checked, exr_path,
                             [&](double share) { return progress.update((done + share) / frames); });
            require_valid_samples(frame, scene.name);
            ExrReader exr(exr_path);
            if (row.empty()) row.push_back(picture(exr, frame, options.view, -1));
            for (size_t i = 0; i < options.rain.size(); ++i) row.push_back(picture(exr, frame, options.view, int(i)));
            ++done;
        }
        table += fmt::format("<tr><th>{:g} h</th>", hour);
        for (const Image<Rgba8>& cell : row) table += "<td><img alt=\"\" src=\"" + jpeg_url(cell, 85) + "\"></td>";
        table += "</tr>";
        rows.push_back(std::move(row));
    }
    write_text(folder + "/figure.html",
               "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + html_escaped(config.name) +
                   "</title><style>" + html_page_style + "body{max-width:none}td img{display:block}th{font-size:13px}" +
                   "</style></head><body><h1>" + html_escaped(scene.name + ", " + options.camera) + "</h1><table>" +
                   table + "</table></body></html>\n");
    const std::string path = folder + "/figure.png";
    write_grid(path, rows);
    return path;
}

}  // namespace pluvia
