// A dataset of few small frames, and what tests do to it.
#pragma once

#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "tests/run_program.h"
#include "tests/temporary_folder.h"
#include "tests/test_scenes.h"
#include "tools/dataset/file_hash.h"
#include "tools/dataset/manifest.h"

#include <doctest/doctest.h>

#include <map>
#include <string>

namespace pluvia {

/// A court with two cameras under a constant sky, and its configuration court.yaml. Pictures are 64 x 32 pixels, and
/// lenses long enough for streaks to be seen on them.
class SmallDataset {
public:
    /// more: lines for the configuration.
    explicit SmallDataset(int frames = 2, const std::string& more = "composition: paper\n") {
        Scene scene = make_court(lambert(Rgb(0.5f)));
        add_sphere(scene, {1, 3, -2}, 0.2f, 16, emitter(Rgb(500)));
        scene.cameras.push_back({"eye", translate({1, 1.6, 3.5}), 0.3});
        scene.cameras.push_back({"low", translate({0.5, 0.6, 3}), 0.4});
        save_glb(scene, folder / "court.glb");
        write_file(config_path(),
                   "size: 64x32\nspp: 2\nstreak-width: 0.25\nrain: [10, 100]\nwinds: [-2, [1, 0, 2]]\nhours: [10, 20]\n"
                   "environment: 80,90,100\n" +
                       more + "scenes:\n  - scene: court.glb\n    frames: " + std::to_string(frames) +
                       "\n    train: [eye]\n    test: [low]\n");
    }

    std::string config_path() const { return folder / "court.yaml"; }
    DatasetConfig config() const { return read_dataset_config(config_path()); }
    /// "court.yaml -o FOLDER", for a command line.
    std::string arguments(const std::string& output) const { return config_path() + " -o " + (folder / output); }
    Outcome command(const std::string& verb, const std::string& output, const std::string& more = "") const {
        const bool has_progress = verb == "run" || verb == "figure";
        return run_program("dataset " + verb + " " + arguments(output) + (has_progress ? " --progress none " : " ") +
                           more);
    }

    TemporaryFolder folder;
};

/// Bytes of all files but logs, by path.
inline std::map<std::string, std::string> product_files(const std::string& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string path = std::filesystem::relative(entry.path(), folder).string();
        if (entry.is_regular_file() && !path.starts_with("logs/")) files[path] = read_file(entry.path().string());
    }
    return files;
}

/// Names what differs, so that a failure says it.
inline std::string difference(const std::map<std::string, std::string>& a,
                              const std::map<std::string, std::string>& b) {
    for (const auto& [path, bytes] : a)
        if (!b.contains(path) || b.at(path) != bytes) return path;
    for (const auto& [path, bytes] : b)
        if (!a.contains(path)) return path;
    return "";
}

}  // namespace pluvia
