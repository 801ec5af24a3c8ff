// KITTI's odometry benchmark: sequences/NN with image_2, image_3, calib.txt, times.txt and velodyne, and poses/NN.txt;
// below the input or below its folder dataset. And the pictures that the depth benchmark selects, each with its own
// intrinsics: val_selection_cropped and test_depth_completion_anonymous.
#include "renderer/core/error.h"
#include "tools/augment/kitti_files.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>

namespace pluvia {
namespace {

/// Lines of numbers, so many in each.
std::vector<std::vector<double>> read_lines(const std::string& path, size_t count) {
    std::ifstream file(path);
    if (!file) throw input_error(path, "cannot be opened");
    std::vector<std::vector<double>> lines;
    for (std::string line; std::getline(file, line);) {
        std::istringstream numbers(line);
        lines.emplace_back();
        for (double v; numbers >> v;) lines.back().push_back(v);
        if (lines.back().size() != count)
            throw input_error(
                path, fmt::format("line {} holds {} numbers (expected {})", lines.size(), lines.back().size(), count));
    }
    return lines;
}

const std::vector<double>& line_of(const std::vector<std::vector<double>>& lines, size_t frame,
                                   const std::string& path) {
    if (frame >= lines.size()) throw input_error(path, fmt::format("has no line {}", frame + 1));
    return lines[frame];
}

struct Sequence {
    std::string folder, times_path, poses_path;
    NumberTable calib;
    std::vector<std::vector<double>> times, poses;  // poses: of the first camera, right, down, forward at the start

    Sequence(const std::string& root, const std::string& number)
        : folder(root + "/sequences/" + number),
          times_path(folder + "/times.txt"),
          poses_path(root + "/poses/" + number + ".txt"),
          calib(read_number_table(folder + "/calib.txt")),
          times(read_lines(times_path, 1)) {
        // Those of the sequences that are left for evaluation are not published.
        if (std::ifstream(poses_path)) poses = read_lines(poses_path, 12);
    }

    void place(AugmentItem& item, const std::string& camera, const std::string& stem) const {
        const std::string path = folder + "/calib.txt";
        const size_t frame = std::stoul(stem);
        const Vec3d offset = set_projection(item.camera, table_numbers(calib, "P" + camera, 12, path), path);
        const auto pose = [&](size_t i) {
            return poses.empty() ? Transform() : rigid_rows(line_of(poses, i, poses_path));
        };
        item.camera.world_from_camera = camera_from_opencv() * pose(frame) * translate(offset) * camera_from_opencv();
        item.camera.mid_exposure = line_of(times, frame, times_path)[0];
        if (poses.size() > 1) {
            const size_t before = frame > 0 ? frame - 1 : 0, after = std::min(frame + 1, poses.size() - 1);
            const double time = line_of(times, after, times_path)[0] - times[before][0];
            if (time > 0)
                item.camera.velocity =
                    camera_from_opencv().vector((pose(after).translation - pose(before).translation) / time);
        }
        Transform camera_from_lidar;
        const std::string scan = folder + "/velodyne/" + stem + ".bin";
        if (std::ifstream(scan))
            camera_from_lidar = translate(-offset) * rigid_rows(table_numbers(calib, "Tr", 12, path));
        set_kitti_depth(item, {fmt::format("{}/depth_{}/{}.png", folder, camera, stem)}, scan, camera_from_lidar);
    }
};

}  // namespace

std::vector<AugmentItem> kitti_odometry_items(const std::string& root) {
    std::vector<AugmentItem> items;
    std::map<std::string, Sequence> sequences;
    for (const std::string camera : {"2", "3"})
        for (const FoundFile& file : find_matching(root, "sequences/*/image_" + camera + "/*.png")) {
            const std::string &number = file.stars.at(0), &stem = file.stars.at(1);
            if (stem.empty() || stem.size() > 9 || stem.find_first_not_of("0123456789") != std::string::npos) continue;
            AugmentItem item;
            item.name = file.path.substr(0, file.path.rfind('.'));
            item.picture = root + "/" + file.path;
            item.rain = "sequence " + number;
            try {
                auto found = sequences.find(number);
                if (found == sequences.end()) found = sequences.emplace(number, Sequence(root, number)).first;
                found->second.place(item, camera, stem);
            } catch (const Error& e) {
                item.fault = e.what();
            }
            items.push_back(std::move(item));
        }
    return items;
}

std::vector<AugmentItem> kitti_selection_items(const std::string& root) {
    std::vector<AugmentItem> items;
    for (const std::string set : {"val_selection_cropped", "test_depth_completion_anonymous"})
        for (const FoundFile& file : find_matching(root, set + "/image/*.png")) {
            const std::string& stem = file.stars.at(0);
            AugmentItem item;
            item.name = file.path.substr(0, file.path.rfind('.'));
            item.picture = root + "/" + file.path;
            item.rain = item.name;
            // Validation's names say what a file is: DRIVE_image_FRAME_image_0N, DRIVE_velodyne_raw_FRAME_image_0N.
            const size_t kind = stem.find("_image_");
            const auto beside = [&](const std::string& folder) {
                std::string name = stem;
                if (kind != std::string::npos) name.replace(kind, 7, "_" + folder + "_");
                return fmt::format("{}/{}/{}/{}.png", root, set, folder, name);
            };
            try {
                const std::string path = fmt::format("{}/{}/intrinsics/{}.txt", root, set, stem);
                const auto lines = read_lines(path, 9);
                const std::vector<double>& k = line_of(lines, 0, path);
                set_projection(item.camera, {k[0], k[1], k[2], 0, k[3], k[4], k[5], 0, k[6], k[7], k[8], 0}, path);
                set_kitti_depth(item, {beside("groundtruth_depth"), beside("velodyne_raw")}, "", {});
            } catch (const Error& e) {
                item.fault = e.what();
            }
            items.push_back(std::move(item));
        }
    return items;
}

}  // namespace pluvia
