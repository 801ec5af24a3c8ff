#include "tools/augment/augment_items.h"

#include "tools/option_check.h"

#include <algorithm>
#include <filesystem>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

bool matches(std::string_view text, std::string_view pattern, std::vector<std::string>& stars) {
    const size_t star = pattern.find('*');
    if (star == std::string_view::npos) return text == pattern;
    if (text.substr(0, star) != pattern.substr(0, star)) return false;
    text.remove_prefix(star), pattern.remove_prefix(star + 1);
    // The longest text first: a name's extension begins at its last point.
    const size_t most = std::min(text.find('/'), text.size());
    for (size_t length = most + 1; length-- > 0;) {
        stars.emplace_back(text.substr(0, length));
        if (matches(text.substr(length), pattern, stars)) return true;
        stars.pop_back();
    }
    return false;
}

std::string without_extension(const std::string& path) {
    return fs::path(path).replace_extension().string();
}

/// What frame.json's cameras are to be moved by, so that drops are those of the render.
Vec3d scene_origin(const nlohmann::ordered_json& calibration, const std::string& where) {
    try {
        if (!calibration.contains("scene") || !calibration["scene"].contains("origin")) return {};
        const auto& v = calibration["scene"]["origin"];
        return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
    } catch (const nlohmann::ordered_json::exception&) {
        throw input_error(where, "\"scene\" has an \"origin\" that is not three numbers");
    }
}

/// Items of pictures and depth by patterns; the camera of those that a calibration names.
std::vector<AugmentItem> pattern_items(const AugmentOptions& o, const DepthFormat& format) {
    const auto stars_of = [](const std::string& pattern) { return std::ranges::count(pattern, '*'); };
    if (stars_of(o.images) != stars_of(o.depth))
        fail_option("depth", '"' + o.depth + '"', fmt::format("as many * as in \"{}\"", o.images));
    nlohmann::ordered_json calibration;
    if (!o.calibration.empty()) calibration = read_json(o.calibration);
    const Vec3d origin = scene_origin(calibration, o.calibration);
    std::vector<AugmentItem> items;
    for (const FoundFile& file : find_matching(o.input, o.images)) {
        AugmentItem item;
        for (const std::string& star : file.stars) item.name += (item.name.empty() ? "" : "/") + star;
        if (item.name.empty()) item.name = without_extension(file.path);
        item.picture = o.input + "/" + file.path;
        item.depth = o.input + "/" + filled_pattern(o.depth, file.stars);
        item.format = format;
        item.rain = item.name;
        if (!o.labels.empty()) {
            const std::string path = filled_pattern(o.labels, file.stars);
            item.labels.push_back({o.input + "/" + path, path});
        }
        try {
            if (calibration.contains("cameras")) {
                const auto& cameras = calibration["cameras"];
                if (!cameras.contains(item.name))
                    throw input_error(o.calibration, "names no camera \"" + item.name + "\"");
                item.camera = camera_from_json(cameras[item.name], origin, o.calibration + ": " + item.name);
                item.rain.clear();
            } else if (calibration.contains("camera")) {
                item.camera = camera_from_json(calibration["camera"], origin, o.calibration);
                if (stars_of(o.images) == 0) item.rain.clear();
            }
        } catch (const Error& e) {
            item.fault = e.what();
        }
        item.format.focal_times_baseline = item.camera.focal_pixels * o.baseline.value_or(0);
        items.push_back(std::move(item));
    }
    return items;
}

}  // namespace

std::vector<FoundFile> find_matching(const std::string& folder, const std::string& pattern) {
    std::vector<FoundFile> found;
    // Only folders that the pattern names are entered: a data set may have millions of files beside.
    const auto visit = [&](const auto& self, const std::string& path, const std::string& rest,
                           const std::vector<std::string>& stars) -> void {
        const size_t slash = rest.find('/');
        const std::string part = rest.substr(0, slash);
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(folder + "/" + path, error)) {
            const std::string name = entry.path().filename().string();
            FoundFile file{path.empty() ? name : path + "/" + name, stars};
            if (!matches(name, part, file.stars)) continue;
            if (slash == std::string::npos)
                found.push_back(std::move(file));
            else
                self(self, file.path, rest.substr(slash + 1), file.stars);
        }
    };
    visit(visit, "", pattern, {});
    std::ranges::sort(found, {}, &FoundFile::path);
    return found;
}

std::string filled_pattern(const std::string& pattern, const std::vector<std::string>& stars) {
    std::string text;
    size_t next = 0;
    for (const char c : pattern) {
        if (c == '*' && !stars.empty())
            text += stars[std::min(next++, stars.size() - 1)];
        else
            text += c;
    }
    return text;
}

std::vector<AugmentItem> folder_items(const AugmentOptions& o) {
    if (o.images.empty()) fail_option("images", "nothing", "a pattern such as 'rgb/*.png' with --dataset folder");
    if (o.depth.empty()) fail_option("depth", "nothing", "a pattern such as 'depth/*.png' with --dataset folder");
    const bool stated = o.depth.ends_with(".exr") || o.depth.ends_with(".npy");
    if (o.depth_encoding.empty() && !stated)
        fail_option("depth-encoding", "nothing", "one of the encodings, since a picture does not say its own");
    const DepthFormat format{o.depth_encoding.empty() ? DepthInput::metres
                                                      : depth_input_from_name(o.depth_encoding, "--depth-encoding")};
    return pattern_items(o, format);
}

std::vector<AugmentItem> carla_items(const AugmentOptions& given) {
    AugmentOptions o = given;
    std::vector<std::string> patterns = {o.images};
    if (o.images.empty()) {
        patterns.clear();
        for (const char* folder : {"background", "rgb", "images"})
            for (const char* extension : {".png", ".jpg", ".jpeg"})
                patterns.push_back(fmt::format("{}/*{}", folder, extension));
    }
    if (o.depth.empty()) o.depth = "depth/*.png";
    const DepthFormat format{o.depth_encoding.empty() ? DepthInput::carla
                                                      : depth_input_from_name(o.depth_encoding, "--depth-encoding")};
    std::vector<AugmentItem> items;
    for (const std::string& pattern : patterns) {
        o.images = pattern;
        for (AugmentItem& item : pattern_items(o, format)) {
            item.camera.fov = 90;  // CARLA's default
            for (const char* folder : {"semantic_segmentation", "instance_segmentation"}) {
                const std::string path = fmt::format("{}/{}.png", folder, item.name);
                if (o.labels.empty() && fs::exists(o.input + "/" + path))
                    item.labels.push_back({o.input + "/" + path, path});
            }
            items.push_back(std::move(item));
        }
    }
    return items;
}

std::vector<AugmentItem> augment_items(const AugmentOptions& o) {
    using Layout = std::vector<AugmentItem> (*)(const AugmentOptions&);
    static const std::vector<std::pair<std::string, Layout>> layouts = {{"folder", folder_items},
                                                                        {"carla", carla_items},
                                                                        {"kitti", kitti_items},
                                                                        {"cityscapes", cityscapes_items},
                                                                        {"nuscenes", nuscenes_items}};
    const auto layout = std::ranges::find(layouts, o.dataset, &std::pair<std::string, Layout>::first);
    if (layout == layouts.end())
        fail_option("dataset", '"' + o.dataset + '"', "folder, carla, kitti, cityscapes or nuscenes");
    if (o.dataset != "folder" && o.dataset != "carla")
        for (const auto& [name, value] : {std::pair("images", o.images),
                                          {"depth", o.depth},
                                          {"labels", o.labels},
                                          {"depth-encoding", o.depth_encoding},
                                          {"calibration", o.calibration}})
            if (!value.empty()) fail_option(name, '"' + value + '"', "--dataset folder or carla beside it");
    if (!fs::is_directory(o.input)) throw input_error(o.input, "is no folder");
    std::vector<AugmentItem> items = layout->second(o);
    if (items.empty()) throw input_error(o.input, fmt::format("holds no picture in the layout {}", o.dataset));
    std::ranges::sort(items, {}, &AugmentItem::name);
    for (size_t i = 1; i < items.size(); ++i)
        if (items[i].name == items[i - 1].name)
            throw input_error(items[i].picture,
                              fmt::format("has the name of {} but for its extension", items[i - 1].picture));
    return items;
}

}  // namespace pluvia
