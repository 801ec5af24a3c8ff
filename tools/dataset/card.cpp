#include "tools/dataset/card.h"

#include "tools/dataset/file_hash.h"
#include "tools/dataset/item.h"
#include "tools/dataset/item_files.h"
#include "tools/frame_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

const char* size_category(size_t pairs) {
    return pairs < 1000 ? "n<1K" : pairs < 10000 ? "1K<n<10K" : pairs < 100000 ? "10K<n<100K" : "100K<n<1M";
}

std::string description(const DatasetConfig& config) {
    return config.description.empty() ? "Path-traced pairs of clean and rainy pictures of street scenes."
                                      : config.description;
}

std::string intensities(const DatasetConfig& config) {
    if (!config.scenes[0].is_sequence()) return fmt::format("{} mm/h", fmt::join(config.scenes[0].options.rain, ", "));
    double least = 1e9, most = 0;
    for (const DatasetScene& scene : config.scenes)
        for (const FrameKey& key : scene.course.rain)
            least = std::min(least, key.value.x), most = std::max(most, key.value.x);
    return fmt::format("{:g} to {:g} mm/h, changing from frame to frame", least, most);
}

}  // namespace

std::string dataset_card(const DatasetConfig& config, size_t train, size_t test, const std::string& lists) {
    const RenderOptions& o = config.scenes.front().options;
    const bool is_paper = o.composition == "paper", veil = has_veil(o);
    std::string card = fmt::format(
        "---\nlicense: {}\npretty_name: {}\ntask_categories:\n- image-to-image\n- depth-estimation\n"
        "size_categories:\n- {}\ntags:\n- rain\n- synthetic\n- deraining\n---\n\n# {}\n\n{}\n\n",
        config.license, config.name, size_category(train + test), config.name, description(config));
    card += fmt::format(
        "{} training and {} test pairs of {} pixels, rendered by Pluvia {} with {} samples per pixel.\n"
        "Training and test share no camera. Licence: {}.\n\n",
        train, test, o.size, PLUVIA_VERSION, o.spp, config.license);
    card += "| scene | frames of each camera | cameras, training | cameras, test |\n| --- | --- | --- | --- |\n";
    for (const DatasetScene& scene : config.scenes)
        card += fmt::format("| {} | {} | {} | {} |\n", scene.name, scene.frames, fmt::join(scene.train, ", "),
                            fmt::join(scene.test, ", "));
    card += fmt::format("\nIntensities: {}. Weather: {}. Composition: {}{}.\n", intensities(config), o.light.weather,
                        o.composition, o.veil == "table" ? ", light of fine rain interpolated" : "");
    card += "\n## Files\n\n" + lists +
            "\n\n| key | content |\n| --- | --- |\n"
            "| `scene`, `sequence`, `intensity`, `wind` | the scene, its camera, mm/h, folder of the wind |\n";
    card += fmt::format(
        "| `background` | clean picture, {} |\n",
        config.pictures.bits == 8 ? fmt::format("JPEG, quality {}", config.pictures.jpeg_quality) : "PNG, 16 bits");
    card += fmt::format(
        "| `depth` | 16 bits; value / 65535 x `depth_max_m` is the distance along the view axis in metres, 65535 = sky "
        "or farther |\n"
        "| `rain_layer` | RGBA, {0} bits: light of the streaks, displayed as the pictures are; alpha: share of the "
        "exposure or of the texture that streaks cover |\n"
        "| `rainy_depth` | as `depth`, to the nearest streak at least a pixel wide where there is one |\n"
        "| `rainy_image` | the picture in the rain, {0} bits |\n"
        "| `rain_mask` | 255 where {1} |\n"
        "| `metric_depth` | EXR, channel Z in metres, sky = inf |\n",
        config.pictures.bits,
        is_paper ? "alpha is 0.01 or more"
                 : "streaks at least a pixel wide change the displayed picture by 3 of 255 levels or more");
    if (veil)
        card +=
            "| `transmittance`, `inscatter` | 16 bits: share of the background's light that arrives (linear), and "
            "light of finer rain (displayed) |\n";
    if (config.pictures.exr) card += "| `exr` | all layers, 32-bit float, radiance in cd/m2, linear Rec.709 |\n";
    card += fmt::format(
        "| `frame`, `hour`, `wind_x`, `wind_y`, `wind_z`, `exposure_ev100` | number, local time, m/s, exposure |\n\n"
        "In linear light `rainy_image = background x {} + rain_layer{}`. Colours are displayed through the view `{}`.\n"
        "`cameras.jsonl` has pose and intrinsics of every frame (x right, y up, looks along -z), `records/` the "
        "settings, "
        "checksums and histograms, `provenance.json` the builds that rendered them.\n",
        veil ? "transmittance" : "(1 - alpha)", veil ? " + inscatter" : "", o.view);
    card +=
        "\nDepth has 16 bits. A reader that converts it to 8 bits by clipping (as Pillow's `convert(\"L\")` does) must "
        "divide by 257 first.\n";
    return card;
}

std::string croissant_metadata(const DatasetConfig& config, const std::map<std::string, std::string>& files) {
    Json j;
    j["@context"] = {{"@language", "en"},
                     {"@vocab", "https://schema.org/"},
                     {"sc", "https://schema.org/"},
                     {"cr", "http://mlcommons.org/croissant/"},
                     {"dct", "http://purl.org/dc/terms/"},
                     {"conformsTo", "dct:conformsTo"},
                     {"recordSet", "cr:recordSet"},
                     {"field", "cr:field"},
                     {"source", "cr:source"},
                     {"extract", "cr:extract"},
                     {"jsonPath", "cr:jsonPath"},
                     {"fileObject", "cr:fileObject"},
                     {"fileSet", "cr:fileSet"},
                     {"includes", "cr:includes"},
                     {"dataType", {{"@id", "cr:dataType"}, {"@type", "@vocab"}}}};
    j["@type"] = "sc:Dataset";
    j["conformsTo"] = "http://mlcommons.org/croissant/1.0";
    j["name"] = config.name;
    j["description"] = description(config);
    j["license"] = config.license;
    j["version"] = "1.0.0";
    j["distribution"] = Json::array();
    for (const char* path : {"trainset.json", "testset.json"})
        j["distribution"].push_back({{"@type", "cr:FileObject"},
                                     {"@id", path},
                                     {"name", path},
                                     {"contentUrl", path},
                                     {"encodingFormat", "application/json"},
                                     {"sha256", sha256(files.at(path))}});
    const std::string background = config.pictures.bits == 8 ? "jpg" : "png";
    const auto add_set = [&](const char* id, const std::string& includes, const char* format) {
        j["distribution"].push_back(
            {{"@type", "cr:FileSet"}, {"@id", id}, {"name", id}, {"includes", includes}, {"encodingFormat", format}});
    };
    add_set("backgrounds", "clean/*/*/background/*." + background, background == "jpg" ? "image/jpeg" : "image/png");
    add_set("depths", "clean/*/*/depth/*.png", "image/png");
    add_set("rainy-images", "rainy/*/*/*/*/rainy_image/*.png", "image/png");
    add_set("rain-layers", "rainy/*/*/*/*/rain_layer/*.png", "image/png");
    add_set("rain-masks", "rainy/*/*/*/*/rain_mask/*.png", "image/png");
    add_set("rainy-depths", "rainy/*/*/*/*/depth/*.png", "image/png");

    const std::pair<const char*, const char*> fields[] = {
        {"scene", "sc:Text"},       {"sequence", "sc:Text"},  {"intensity", "sc:Float"},   {"wind", "sc:Text"},
        {"background", "sc:Text"},  {"depth", "sc:Text"},     {"rain_layer", "sc:Text"},   {"rainy_depth", "sc:Text"},
        {"rainy_image", "sc:Text"}, {"rain_mask", "sc:Text"}, {"depth_max_m", "sc:Float"}, {"hour", "sc:Float"}};
    j["recordSet"] = Json::array();
    for (const char* split : {"train", "test"}) {
        Json set{{"@type", "cr:RecordSet"}, {"@id", split}, {"name", split}, {"field", Json::array()}};
        for (const auto& [key, type] : fields)
            set["field"].push_back({{"@type", "cr:Field"},
                                    {"@id", fmt::format("{}/{}", split, key)},
                                    {"name", key},
                                    {"dataType", type},
                                    {"source",
                                     {{"fileObject", {{"@id", fmt::format("{}set.json", split)}}},
                                      {"extract", {{"jsonPath", fmt::format("$[*].{}", key)}}}}}});
        j["recordSet"].push_back(set);
    }
    return json_text(j, 1) + "\n";
}

}  // namespace pluvia
