#include "tools/dataset/config.h"

#include "renderer/image/color.h"
#include "scenes/builders.h"
#include "tools/dataset/config_tree.h"
#include "tools/dataset/suggestion.h"
#include "tools/frame_labels.h"
#include "tools/option_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace pluvia {
namespace {

using Kind = ConfigNode::Kind;

/// Options of `pluvia render` that a configuration may not set, and what it says instead.
const std::pair<const char*, const char*> set_elsewhere[] = {
    {"hour", "hours, a list that frames go through"},
    {"wind", "winds, a list that frames go through"},
    {"camera", "train and test of a scene"},
    {"frame", "frames of a scene"},
    {"output", "-o on the command line"},
    {"threads", "--threads on the command line"},
    {"progress", "--progress on the command line"},
    {"overwrite", "nothing: frames that are not right are made anew"},
    {"json", "--json on the command line"},
    {"depth-encoding", "nothing: the layout has its own"},
};

std::string replacement(const std::string& key) {
    for (const auto& [name, instead] : set_elsewhere)
        if (key == name) return instead;
    return "";
}

const std::vector<std::string> own_keys = {"name",  "description",    "license",       "scenes",
                                           "hours", "winds",          "bits",          "jpeg-quality",
                                           "exr",   "rain-over-time", "wind-over-time"};
const std::vector<std::string> scene_keys = {"scene", "name", "traffic",        "frames",        "hour",
                                             "train", "test", "rain-over-time", "wind-over-time"};

/// Options of `pluvia render` that are keys, without their dashes.
const std::vector<std::string>& render_keys() {
    static const std::vector<std::string> keys = [] {
        CLI::App app;
        RenderOptions options;
        add_render_options(app, options);
        std::vector<std::string> names;
        for (const CLI::Option* option : app.get_options())
            for (const std::string& name : option->get_lnames())
                if (name != "help" && replacement(name).empty()) names.push_back(name);
        return names;
    }();
    return keys;
}

class Reader {
public:
    explicit Reader(const std::string& path) : path_(path) {}

    DatasetConfig read() {
        const ConfigNode root = read_config_tree(path_);
        require(root.kind == Kind::map, root.line, "holds no keys", "KEY: VALUE lines");
        DatasetConfig config;
        config.path = path_;
        config.name = std::filesystem::path(path_).stem();
        RenderOptions common;
        const ConfigEntry* scenes = nullptr;
        const std::vector<ConfigEntry> entries = quality_first(root.entries);
        for (const ConfigEntry& entry : entries) {
            check_key(entry, own_keys);
            if (entry.key == "scenes") {
                scenes = &entry;
            } else if (read_course(course_, entry)) {
                continue;
            } else if (std::find(own_keys.begin(), own_keys.end(), entry.key) != own_keys.end()) {
                read_own(config, entry);
            } else {
                set(common, entry);
            }
        }
        if (!scenes) fail(root.line, "has no key \"scenes\"", "a list of scenes");
        require(scenes->value.kind == Kind::list && !scenes->value.items.empty(), scenes->line, "scenes is no list",
                "one entry per scene");
        for (const ConfigNode& node : scenes->value.items) config.scenes.push_back(read_scene(node, common));
        check_whole(config, scenes->line);
        return config;
    }

private:
    [[noreturn]] void fail(int line, const std::string& what, const std::string& expected) const {
        throw usage_error(fmt::format("{}:{}", path_, line), fmt::format("{} (expected {})", what, expected));
    }
    void require(bool ok, int line, const std::string& what, const std::string& expected) const {
        if (!ok) fail(line, what, expected);
    }

    void check_key(const ConfigEntry& entry, const std::vector<std::string>& others) const {
        const auto knows = [&](const std::vector<std::string>& keys) {
            return std::find(keys.begin(), keys.end(), entry.key) != keys.end();
        };
        if (knows(others) || knows(render_keys())) return;
        if (const std::string instead = replacement(entry.key); !instead.empty())
            fail(entry.line, fmt::format("\"{}\" is set for each frame or run", entry.key), instead);
        std::vector<std::string> known = others;
        known.insert(known.end(), render_keys().begin(), render_keys().end());
        const std::string near = nearest_word(entry.key, known);
        throw usage_error(
            fmt::format("{}:{}", path_, entry.line),
            fmt::format("there is no key \"{}\"{}", entry.key,
                        near.empty() ? "; options of pluvia render --help are keys" : "; did you mean " + near + "?"));
    }

    std::string scalar(const ConfigEntry& entry) const {
        require(entry.value.kind == Kind::scalar, entry.line, entry.key + " is not a single value", "one");
        return entry.value.text;
    }
    double number(const ConfigNode& node, const std::string& key) const {
        double value = 0;
        if (node.kind != Kind::scalar || !parse_number(node.text, value))
            fail(node.line, fmt::format("{} is not valid (got \"{}\")", key, node.text), "a number");
        return value;
    }
    int integer(const ConfigEntry& entry, int lowest, int highest) const {
        int value = 0;
        if (!parse_number(scalar(entry), value) || value < lowest || value > highest)
            fail(entry.line, fmt::format("{} is not valid (got \"{}\")", entry.key, entry.value.text),
                 fmt::format("a whole number from {} to {}", lowest, highest));
        return value;
    }
    bool truth(const ConfigEntry& entry) const {
        const std::string text = scalar(entry);
        if (text != "true" && text != "false")
            fail(entry.line, fmt::format("{} is not valid (got \"{}\")", entry.key, text), "true or false");
        return text == "true";
    }
    /// What stands beside it counts more, in whatever order.
    static std::vector<ConfigEntry> quality_first(std::vector<ConfigEntry> entries) {
        std::stable_partition(entries.begin(), entries.end(), [](const ConfigEntry& e) { return e.key == "quality"; });
        return entries;
    }
    const std::vector<ConfigNode>& list(const ConfigEntry& entry) const {
        require(entry.value.kind == Kind::list && !entry.value.items.empty(), entry.line, entry.key + " is no list",
                "[A, B, ...]");
        return entry.value.items;
    }
    /// Names of scenes and cameras become folders.
    void check_name(const std::string& name, int line) const {
        const bool ok = !name.empty() && name[0] != '.' && std::all_of(name.begin(), name.end(), [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-' || c == '.';
        });
        require(ok, line, fmt::format("\"{}\" cannot be the name of a folder", name),
                "letters, digits, '_', '-' and '.'");
    }

    /// [[frame, VALUE], ...] with 1 or 3 numbers for a value, in rising order of frames.
    std::vector<FrameKey> keys(const ConfigEntry& entry, size_t numbers) const {
        std::vector<FrameKey> result;
        for (const ConfigNode& node : list(entry)) {
            require(node.kind == Kind::list && node.items.size() == numbers + 1, node.line,
                    fmt::format("an entry of {} has not {} numbers", entry.key, numbers + 1),
                    numbers == 1 ? "[frame, mm/h]" : "[frame, X, Y, Z] in m/s");
            FrameKey key;
            key.frame = number(node.items[0], entry.key);
            for (size_t k = 0; k < numbers; ++k) key.value[int(k)] = number(node.items[k + 1], entry.key);
            require(key.frame >= 0 && (result.empty() || key.frame > result.back().frame), node.line,
                    "frames are not in order", "rising ones from 0 on");
            result.push_back(key);
        }
        return result;
    }

    /// False where the key is none of a course.
    bool read_course(RainCourse& course, const ConfigEntry& entry) const {
        if (entry.key == "rain-over-time") {
            course.rain = keys(entry, 1);
            for (const FrameKey& key : course.rain)
                require(key.value.x >= 0 && key.value.x <= 1000, entry.line, "rain-over-time is out of range",
                        "0 to 1000 mm/h");
        } else if (entry.key == "wind-over-time") {
            course.wind = keys(entry, 3);
            for (const FrameKey& key : course.wind)
                require(is_finite(key.value) && length(key.value) < 100, entry.line, "a wind is too strong",
                        "below 100 m/s");
        } else {
            return false;
        }
        return true;
    }

    void read_own(DatasetConfig& config, const ConfigEntry& entry) const {
        if (entry.key == "name") {
            config.name = scalar(entry);
            check_name(config.name, entry.line);
        } else if (entry.key == "description") {
            config.description = scalar(entry);
        } else if (entry.key == "license") {
            config.license = scalar(entry);
        } else if (entry.key == "bits") {
            config.pictures.bits = integer(entry, 8, 16);
            require(config.pictures.bits != 0 && config.pictures.bits % 8 == 0, entry.line, "bits is not valid",
                    "8 or 16");
        } else if (entry.key == "jpeg-quality") {
            config.pictures.jpeg_quality = integer(entry, 1, 100);
        } else if (entry.key == "exr") {
            config.pictures.exr = truth(entry);
        } else if (entry.key == "hours") {
            for (const ConfigNode& node : list(entry)) {
                const double hour = number(node, "hours");
                require(hour >= 0 && hour <= 24, node.line, fmt::format("hours holds {}", hour), "0 to 24");
                config.hours.push_back(hour);
            }
        } else if (entry.key == "winds") {
            config.winds.clear();
            for (const ConfigNode& node : list(entry)) {
                Vec3d wind;
                if (node.kind == Kind::list) {
                    require(node.items.size() == 3, node.line, "a wind has not three components",
                            "[X, Y, Z] in m/s, or X alone");
                    wind = {number(node.items[0], "winds"), number(node.items[1], "winds"),
                            number(node.items[2], "winds")};
                } else {
                    wind.x = number(node, "winds");
                }
                require(is_finite(wind) && length(wind) < 100, node.line, "a wind is too strong", "below 100 m/s");
                config.winds.push_back(wind);
            }
        }
    }

    /// As --KEY=VALUE of `pluvia render` would.
    void set(RenderOptions& options, const ConfigEntry& entry) {
        std::string value;
        if (entry.value.kind == Kind::list) {
            for (const ConfigNode& item : entry.value.items) {
                require(item.kind == Kind::scalar, item.line, entry.key + " holds a list of lists", "values");
                value += (value.empty() ? "" : ",") + item.text;
            }
        } else {
            value = scalar(entry);
        }
        if (app_.get_options().size() <= 1) {
            add_render_options(app_, parsed_);
            for (CLI::Option* option : app_.get_options()) option->required(false);
        }
        parsed_ = options;
        try {
            app_.parse(std::vector<std::string>{"--" + entry.key + "=" + value});
            options = parsed_;
            camera_settings(options), render_settings(options), exposure_ev100(options), label_choice(options.layers);
            check_display_view(options.view);
            if (options.light.environment.empty()) {
                sky_settings(options.light, !options.rain.empty());
                atmosphere_settings(options.light);
            }
        } catch (const CLI::ParseError& e) {
            throw usage_error(fmt::format("{}:{}", path_, entry.line), e.what());
        } catch (const Error& e) {
            // --focus is nothing without --f-number, which may stand on a later line: judged when all is read.
            if (entry.key != "focus") throw usage_error(fmt::format("{}:{}", path_, entry.line), e.what());
        }
    }

    DatasetScene read_scene(const ConfigNode& node, const RenderOptions& common) {
        require(node.kind == Kind::map, node.line, "a scene has no keys", "scene, frames, train, test");
        DatasetScene scene;
        scene.options = common;
        scene.course = course_;
        for (const ConfigEntry& entry : quality_first(node.entries)) {
            check_key(entry, scene_keys);
            if (entry.key == "scene") {
                scene.source = scalar(entry);
            } else if (entry.key == "name") {
                scene.name = scalar(entry);
            } else if (entry.key == "frames") {
                scene.frames = integer(entry, 1, 100000);
            } else if (entry.key == "traffic") {
                scene.traffic = truth(entry);
            } else if (entry.key == "hour") {
                scene.hour = number(entry.value, "hour");
                require(*scene.hour >= 0 && *scene.hour <= 24, entry.line, "hour is out of range", "0 to 24");
            } else if (entry.key == "train" || entry.key == "test") {
                auto& cameras = entry.key == "train" ? scene.train : scene.test;
                for (const ConfigNode& item : list(entry)) {
                    check_name(item.text, item.line);
                    for (const auto* others : {&scene.train, &scene.test})
                        require(std::find(others->begin(), others->end(), item.text) == others->end(), item.line,
                                fmt::format("the camera \"{}\" is there already", item.text),
                                "every camera once: training and test share none");
                    cameras.push_back(item.text);
                }
            } else if (!read_course(scene.course, entry)) {
                set(scene.options, entry);
            }
        }
        set_course(scene, node.line);
        require(!scene.source.empty(), node.line, "a scene has no key \"scene\"",
                "a name of pluvia scenes --list, or a glTF file");
        require(scene.frames > 0, node.line, "a scene has no key \"frames\"", "frames of each camera");
        require(!scene.train.empty() || !scene.test.empty(), node.line, "a scene has no cameras",
                "train, test or both");
        const std::filesystem::path source(scene.source);
        scene.is_built = !source.has_extension();
        require(scene.is_built || !scene.traffic, node.line, "traffic is asked for in a scene from a file",
                "a name of pluvia scenes --list");
        if (scene.name.empty()) scene.name = source.stem();
        check_name(scene.name, node.line);
        // A file is looked for where the configuration is.
        if (!scene.is_built && source.is_relative())
            scene.source = (std::filesystem::path(path_).parent_path() / source).string();
        scene.options.scene = scene.source;
        std::string& rules = scene.options.labels;
        if (!rules.empty() && std::filesystem::path(rules).is_relative())
            rules = (std::filesystem::path(path_).parent_path() / rules).string();
        // The picture of a rainy day without a word about the weather has the sky of rain; that is said here once.
        if (scene.options.light.weather.empty()) scene.options.light.weather = "rain";
        return scene;
    }

    void set_course(DatasetScene& scene, int line) const {
        require(scene.is_sequence() || scene.course.wind.empty(), line,
                "wind-over-time is given without rain-over-time", "both, or winds");
        if (!scene.is_sequence()) return;
        require(scene.options.rain.empty(), line, "both rain and rain-over-time are given", "one of them");
        scene.options.rain = {scene.course.rain[0].value.x};  // every frame has its own
    }

    void check_whole(const DatasetConfig& config, int line) const {
        for (const DatasetScene& scene : config.scenes) {
            camera_settings(scene.options);  // what depends on several keys
            require(scene.is_sequence() == config.scenes[0].is_sequence(), line,
                    "some scenes have rain-over-time and others none", "all or no scenes with it");
            require(!scene.options.rain.empty(), line, "no intensities are given", "rain: [10, 25, ...] in mm/h");
            require(scene.is_sequence() || scene.options.rain == config.scenes[0].options.rain, line,
                    "scenes differ in rain", "the same intensities");
            require(scene.options.layers.empty() || config.pictures.exr, line, "labels are asked for without EXR files",
                    "exr: true, since labels are layers of these");
            require(std::is_sorted(scene.options.rain.begin(), scene.options.rain.end()), line,
                    "intensities are not in order", "rising ones");
            for (const DatasetScene& other : config.scenes)
                require(&scene == &other || scene.name != other.name, line,
                        fmt::format("two scenes have the name \"{}\"", scene.name), "a name of its own for each");
        }
    }

    std::string path_;
    RainCourse course_;  // of scenes without one of their own
    RenderOptions parsed_;
    CLI::App app_;  // of `pluvia render`, made when the first of its options comes; parses one after another
};

}  // namespace

DatasetConfig read_dataset_config(const std::string& path) {
    return Reader(path).read();
}

}  // namespace pluvia
