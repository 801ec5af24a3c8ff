#include "tools/dataset/run_log.h"

#include "renderer/core/error.h"
#include "tools/dataset/work_folder.h"
#include "tools/frame_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace pluvia {

using Json = nlohmann::ordered_json;

RunLog::RunLog(const std::string& dataset, Shard shard)
    : path_(fmt::format("{}/logs/run_{}.jsonl", dataset, shard.label())) {
    make_folder_of(path_);
}

void RunLog::add_done(const std::string& id, const std::string& scene, double seconds) {
    add(json_text(Json{{"id", id}, {"scene", scene}, {"seconds", seconds}}));
}

void RunLog::add_failed(const std::string& id, const std::string& scene, const std::string& reason) {
    add(json_text(Json{{"id", id}, {"scene", scene}, {"failed", reason}}));
}

void RunLog::add(const std::string& line) {
    // Opened for each line: nothing is lost when the run is killed, and a line after half a one stands alone.
    std::ofstream file(path_, std::ios::app | std::ios::binary);
    file << "\n" << line << "\n";
    file.close();
    if (!file) throw Error(ExitCode::render_failed, path_, "cannot be written (the disk may be full)");
}

RunHistory read_run_history(const std::string& dataset) {
    RunHistory history;
    std::vector<std::filesystem::path> paths;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(dataset + "/logs", error))
        paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    for (const auto& path : paths) {
        std::ifstream file(path);
        for (std::string line; std::getline(file, line);) {
            const Json j = Json::parse(line, nullptr, false);
            if (!j.is_object() || !j.contains("id") || !j.contains("scene")) continue;
            if (j.contains("seconds")) history.seconds[j["scene"]].push_back(j["seconds"]);
            if (j.contains("failed")) history.failures[j["id"]] = j["failed"];
        }
    }
    return history;
}

}  // namespace pluvia
