#include "tools/dataset/report.h"

#include "renderer/core/error.h"
#include "renderer/core/parallel.h"
#include "renderer/image/image_io.h"
#include "tools/dataset/manifest.h"
#include "tools/dataset/report_page.h"
#include "tools/dataset/thumbnail.h"
#include "tools/frame_file.h"
#include "tools/html_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

constexpr int thumbnail_width = 384, thumbnail_quality = 80;

std::string thumbnail(const std::string& path) {
    return jpeg_url(shrunk(read_rgba8(path), thumbnail_width), thumbnail_quality);
}

Json frame_data(const std::string& dataset, const DatasetItem& item, const Record& record, bool with_pictures) {
    const Json& r = record.json;
    Json j{{"id", item.id()}, {"scene", item.scene_name}, {"camera", item.camera}, {"split", item.split()}};
    j["hour"] = r.at("hour"), j["wind"] = r.at("wind"), j["ev"] = r.at("exposure_ev100");
    j["depth"] = r.at("depth_histogram");
    if (with_pictures) j["clean"] = thumbnail(dataset + "/" + r.at("background").get<std::string>());
    j["pairs"] = Json::array();
    for (const Json& pair : r.at("pairs")) {
        Json p{{"intensity", pair.at("intensity")},
               {"coverage", pair.at("coverage")},
               {"brightness", pair.at("brightness_histogram")}};
        if (with_pictures) p["rainy"] = thumbnail(dataset + "/" + pair.at("rainy_image").get<std::string>());
        j["pairs"].push_back(std::move(p));
    }
    return j;
}

}  // namespace

std::string write_report(const DatasetConfig& config, const std::string& dataset, const ReportSettings& settings) {
    if (settings.frames < 0)
        throw usage_error("--frames", fmt::format("is not valid (got {}, expected 0 or more)", settings.frames));
    const DatasetState state = read_dataset_state(config, dataset);
    std::vector<size_t> there;
    for (size_t i = 0; i < state.items.size(); ++i)
        if (state.records[i]) there.push_back(i);
    const size_t shown = std::min(there.size(), size_t(settings.frames));
    std::vector<char> with_pictures(there.size(), 0);
    for (size_t k = 0; k < shown; ++k) with_pictures[k * there.size() / shown] = 1;
    std::vector<Json> frames(there.size());
    parallel_for(int(there.size()), [&](int k) {
        const size_t i = there[size_t(k)];
        frames[size_t(k)] = frame_data(dataset, state.items[i], *state.records[i], with_pictures[size_t(k)]);
    });
    const size_t pairs = there.size() * config.intensity_count();
    std::string html = fmt::format(
        "<!doctype html><html lang=\"en\"><head><meta "
        "charset=\"utf-8\"><title>{0}</title><style>{1}{2}</style></head><body>"
        "<h1>{0}</h1><p>{3} of {4} frames, {5} pairs; pictures of {6} frames. {7}</p>{8}",
        html_escaped(config.name), html_page_style, report_style, there.size(), state.items.size(), pairs, shown,
        html_escaped(config.description), report_body);
    // "</" would end the script.
    std::string data = json_text(Json{{"frames", frames}});
    for (size_t at = 0; (at = data.find("</", at)) != std::string::npos; at += 3) data.insert(at + 1, "\\");
    html += "<script>const DATA=" + data + ";\nfunction bind(){" + html_slider_script + "}\n" + report_script +
            "</script></body></html>\n";
    const std::string path = dataset + "/report.html";
    write_text(path, html);
    return path;
}

}  // namespace pluvia
