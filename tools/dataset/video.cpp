#include "tools/dataset/video.h"

#include "renderer/core/error.h"
#include "renderer/transport/layers.h"
#include "tools/dataset/manifest.h"

#include <fmt/format.h>

#include <spawn.h>
#include <sys/wait.h>
#include <cstring>
#include <filesystem>

extern char** environ;

namespace pluvia {
namespace {

namespace fs = std::filesystem;

void run_ffmpeg(std::vector<std::string> arguments, const std::string& output) {
    arguments.insert(arguments.begin(), {"ffmpeg", "-nostdin", "-loglevel", "error"});
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    pid_t process = 0;
    if (const int error = posix_spawnp(&process, "ffmpeg", nullptr, nullptr, pointers.data(), environ); error != 0)
        throw Error(ExitCode::render_failed, "ffmpeg",
                    fmt::format("cannot be started ({}): apt-get install ffmpeg", std::strerror(error)));
    int status = 0;
    waitpid(process, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw Error(ExitCode::render_failed, output, "ffmpeg could not make it; what it says is above");
}

/// The pattern of a sequence's files from the path of its first: what ffmpeg counts up for it.
std::string pattern_of(const std::string& first) {
    const size_t number = first.rfind("frame_0000");
    std::string pattern;
    for (size_t i = 0; i < first.size(); ++i) {
        if (i == number) {
            pattern += "frame_%04d";
            i += 9;
        } else {
            pattern += first[i] == '%' ? "%%" : std::string(1, first[i]);
        }
    }
    return pattern;
}

void write_clip(const std::string& first, int frames, double fps, const std::string& to) {
    const std::string temporary = to + ".tmp.mp4";
    // Widths and heights of the usual chroma format are even.
    run_ffmpeg({"-y", "-framerate", fmt::format("{}", fps), "-start_number", "0", "-i", pattern_of(first), "-frames:v",
                std::to_string(frames), "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "16",
                "-pix_fmt", "yuv420p", temporary},
               to);
    fs::rename(temporary, to);
}

}  // namespace

std::vector<std::string> write_videos(const DatasetConfig& config, const std::string& dataset,
                                      const std::string& picture) {
    if (picture != "rainy_image" && picture != "background")
        throw usage_error("--picture",
                          fmt::format("is not valid (got \"{}\", expected rainy_image or background)", picture));
    const DatasetState state = read_dataset_state(config, dataset);
    if (const size_t missing = state.items.size() - state.count(); missing > 0)
        throw Error(
            ExitCode::check_failed, dataset,
            fmt::format("{} of {} frames are missing; pluvia dataset run makes them", missing, state.items.size()));
    fs::create_directories(dataset + "/video");
    std::vector<std::string> written;
    for (size_t i = 0; i < state.items.size(); ++i) {
        const DatasetItem& item = state.items[i];
        if (item.frame != 0) continue;
        const auto& record = state.records[i]->json;
        const DatasetScene& scene = config.scenes[item.scene];
        const std::string stem = fmt::format("{}/video/{}_{}", dataset, item.scene_name, item.camera);
        const auto add = [&](const std::string& first, const std::string& suffix) {
            written.push_back(stem + suffix + ".mp4");
            write_clip(dataset + "/" + first, scene.frames, scene.options.fps, written.back());
        };
        if (picture == "background") {
            add(record.at("background"), "_background");
            continue;
        }
        for (const auto& pair : record.at("pairs"))
            add(pair.at("rainy_image"),
                record.at("pairs").size() == 1 ? "" : "_" + intensity_label(pair.at("intensity").get<double>()));
    }
    return written;
}

}  // namespace pluvia
