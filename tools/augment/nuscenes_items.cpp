// nuScenes: the key frames of all six cameras, with depth from the lidar of the same sample. The input holds a folder
// v1.0-* of tables, and samples.
// Source: Caesar et al. 2020, "nuScenes: A Multimodal Dataset for Autonomous Driving", and its schema.
#include "renderer/core/error.h"
#include "tools/augment/augment_items.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <memory>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;
using Table = std::map<std::string, Json>;  // by token

/// Those rows that `wanted` says: a full set has millions of others.
Table read_rows(const std::string& path, const std::function<bool(const Json&)>& wanted) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw input_error(path, "cannot be opened");
    Json json;
    try {
        json = Json::parse(file, [&](int depth, Json::parse_event_t event, Json& value) {
            return depth != 1 || event != Json::parse_event_t::object_end || wanted(value);
        });
        Table table;
        for (Json& row : json)
            if (row.is_object()) {
                const std::string token = row.at("token");
                table[token] = std::move(row);
            }
        return table;
    } catch (const Json::exception& e) {
        throw input_error(path, fmt::format("is no table of nuScenes ({})", e.what()));
    }
}

Vec3d vector(const Json& v) {
    return {v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
}

/// Of a row with a translation and a quaternion w, x, y, z.
Transform pose(const Json& row) {
    const Json& q = row.at("rotation");
    Transform t = rotate(q.at(1), q.at(2), q.at(3), q.at(0));
    t.translation = vector(row.at("translation"));
    return t;
}

struct Tables {
    Table data, sensors, calibrated, poses, samples;

    explicit Tables(const std::string& folder) {
        const auto all = [](const Json&) { return true; };
        data =
            read_rows(folder + "/sample_data.json", [](const Json& row) { return row.value("is_key_frame", false); });
        std::map<std::string, bool> used;
        for (const auto& [token, row] : data) used[row.at("ego_pose_token")] = true;
        poses = read_rows(folder + "/ego_pose.json",
                          [&](const Json& row) { return used.contains(row.value("token", "")); });
        sensors = read_rows(folder + "/sensor.json", all);
        calibrated = read_rows(folder + "/calibrated_sensor.json", all);
        samples = read_rows(folder + "/sample.json", all);
    }
    const Json& calibration(const Json& row) const { return calibrated.at(row.at("calibrated_sensor_token")); }
    const Json& sensor(const Json& row) const { return sensors.at(calibration(row).at("sensor_token")); }
    Transform world_from_sensor(const Json& row) const {
        return pose(poses.at(row.at("ego_pose_token"))) * pose(calibration(row));
    }
};

double seconds(const Json& row) {
    return row.at("timestamp").get<double>() * 1e-6;
}

/// East, north, up to the axes here.
Transform world_from_map() {
    return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
}

/// A drive's pictures of one camera in order of time.
using Track = std::vector<const Json*>;

Vec3d velocity(const Tables& tables, const Track& track, size_t i) {
    const Json &before = *track[i > 0 ? i - 1 : i], &after = *track[std::min(i + 1, track.size() - 1)];
    const double time = seconds(after) - seconds(before);
    if (!(time > 0)) return {};
    return (tables.world_from_sensor(after).translation - tables.world_from_sensor(before).translation) / time;
}

AugmentItem make_item(const Tables& tables, const std::string& root, const Track& track, size_t i, const Json* lidar,
                      const Json& first) {
    const Json& row = *track[i];
    const std::string file = row.at("filename");
    AugmentItem item;
    item.name = file.substr(0, file.rfind('.'));
    item.picture = root + "/" + file;
    item.rain = tables.samples.at(row.at("sample_token")).at("scene_token");
    const Json& k = tables.calibration(row).at("camera_intrinsic");
    item.camera.focal_pixels = k.at(0).at(0);
    item.camera.centre = Vec2{k.at(0).at(2).get<float>() + 0.5f, k.at(1).at(2).get<float>() + 0.5f};
    const Transform map_from_camera = tables.world_from_sensor(row);
    Transform from_start = map_from_camera;
    from_start.translation = map_from_camera.translation - tables.world_from_sensor(first).translation;
    item.camera.world_from_camera = world_from_map() * from_start * camera_from_opencv();
    item.camera.mid_exposure = seconds(row) - seconds(first);
    item.camera.velocity = world_from_map().vector(velocity(tables, track, i));
    if (!lidar) {
        item.fault = fmt::format("{} has no lidar in its sample", file);
        return item;
    }
    item.depth = root + "/" + lidar->at("filename").get<std::string>();
    item.format.encoding = DepthInput::lidar;
    item.format.lidar = std::make_shared<LidarProjection>(
        LidarProjection{inverse(map_from_camera) * tables.world_from_sensor(*lidar), item.camera.focal_pixels,
                        *item.camera.centre, row.at("width"), row.at("height")});
    return item;
}

}  // namespace

std::vector<AugmentItem> nuscenes_items(const AugmentOptions& o) {
    const std::vector<FoundFile> found = find_matching(o.input, "v1.0-*/sample_data.json");
    if (found.empty()) throw input_error(o.input, "holds no v1.0-*/sample_data.json");
    std::vector<AugmentItem> items;
    for (const FoundFile& file : found) {
        const std::string folder = o.input + "/v1.0-" + file.stars.at(0);
        try {
            const Tables tables(folder);
            std::map<std::string, const Json*> lidars, firsts;            // by sample; by scene
            std::map<std::pair<std::string, std::string>, Track> tracks;  // by scene and camera
            for (const auto& [token, row] : tables.data) {
                const Json& sensor = tables.sensor(row);
                const std::string scene = tables.samples.at(row.at("sample_token")).at("scene_token");
                if (sensor.at("channel") == "LIDAR_TOP") lidars[row.at("sample_token")] = &row;
                if (sensor.at("modality") != "camera") continue;
                tracks[{scene, sensor.at("channel")}].push_back(&row);
                const Json*& first = firsts[scene];
                if (!first || seconds(row) < seconds(*first)) first = &row;
            }
            for (auto& [key, track] : tracks) {
                std::ranges::sort(track, {}, [](const Json* row) { return seconds(*row); });
                for (size_t i = 0; i < track.size(); ++i) {
                    const auto lidar = lidars.find(track[i]->at("sample_token"));
                    items.push_back(make_item(tables, o.input, track, i,
                                              lidar == lidars.end() ? nullptr : lidar->second, *firsts.at(key.first)));
                }
            }
        } catch (const Json::exception& e) {
            throw input_error(folder, fmt::format("has a table without what is needed ({})", e.what()));
        } catch (const std::out_of_range&) {
            throw input_error(folder, "has a table that names a row which another one lacks");
        }
    }
    return items;
}

}  // namespace pluvia
