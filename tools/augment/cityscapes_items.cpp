// Cityscapes: leftImg8bit and rightImg8bit with disparity and camera, and vehicle and gtFine where they are there.
// Source: Cordts et al. 2016, "The Cityscapes Dataset", and its scripts' README.
#include "renderer/core/error.h"
#include "tools/augment/augment_items.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

/// camera: its JSON. Lenses and mounts, the right camera at the baseline beside the left one.
void set_camera(AugmentItem& item, const std::string& path, bool right) {
    const nlohmann::ordered_json json = read_json(path);
    try {
        const auto &intrinsic = json.at("intrinsic"), &extrinsic = json.at("extrinsic");
        const double focal = intrinsic.at("fx"), baseline = extrinsic.at("baseline");
        if (!(focal > 0) || !(baseline > 0))
            throw input_error(path, fmt::format("has no focal length or baseline (got {:g}, {:g})", focal, baseline));
        item.camera.focal_pixels = focal;
        item.camera.centre = Vec2{intrinsic.at("u0").get<float>() + 0.5f, intrinsic.at("v0").get<float>() + 0.5f};
        item.format.focal_times_baseline = focal * baseline;
        // Pitch turns the camera down (ISO 8855: about the axis to the left).
        const double pitch = extrinsic.at("pitch");
        item.camera.world_from_camera = rotate(-std::sin(pitch / 2), 0, 0, std::cos(pitch / 2));
        if (right) item.camera.world_from_camera.translation = {baseline, 0, 0};
    } catch (const nlohmann::ordered_json::exception& e) {
        throw input_error(path, fmt::format("is no camera of Cityscapes ({})", e.what()));
    }
}

void set_speed(AugmentItem& item, const std::string& path) {
    if (!fs::exists(path)) return;
    const nlohmann::ordered_json json = read_json(path);
    if (!json.contains("speed") || !json["speed"].is_number()) throw input_error(path, "has no \"speed\"");
    item.camera.velocity = {0, 0, -json["speed"].get<double>()};
}

}  // namespace

std::vector<AugmentItem> cityscapes_items(const AugmentOptions& o) {
    std::vector<AugmentItem> items;
    for (const bool right : {false, true}) {
        const std::string kind = right ? "rightImg8bit" : "leftImg8bit";
        for (const FoundFile& file : find_matching(o.input, kind + "/*/*/*_" + kind + ".png")) {
            const std::string place = file.stars.at(0) + "/" + file.stars.at(1) + "/" + file.stars.at(2);
            const auto beside = [&](const std::string& folder, const std::string& ending) {
                return fmt::format("{}/{}/{}_{}", o.input, folder, place, ending);
            };
            AugmentItem item;
            item.name = file.path.substr(0, file.path.rfind('.'));
            item.picture = o.input + "/" + file.path;
            item.depth = beside("disparity", "disparity.png");
            item.format.encoding = DepthInput::disparity;
            item.format.seen_from_right = right;
            item.rain = place;
            try {
                set_camera(item, beside("camera", "camera.json"), right);
                set_speed(item, beside("vehicle", "vehicle.json"));
            } catch (const Error& e) {
                item.fault = e.what();
            }
            for (const char* kind_of_label : {"gtFine", "gtCoarse"})
                for (const char* ending : {"labelIds.png", "labelTrainIds.png", "instanceIds.png",
                                           "instanceTrainIds.png", "color.png", "polygons.json"}) {
                    const std::string path = fmt::format("{0}/{1}_{0}_{2}", kind_of_label, place, ending);
                    if (!right && fs::exists(o.input + "/" + path)) item.labels.push_back({o.input + "/" + path, path});
                }
            items.push_back(std::move(item));
        }
    }
    return items;
}

}  // namespace pluvia
