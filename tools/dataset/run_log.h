// What runs did and how long it took: lines appended to DATASET/logs, one file per shard. Products hold no times, so
// that a dataset has the same bytes however it was made.
#pragma once

#include "tools/dataset/item.h"

#include <map>
#include <string>
#include <vector>

namespace pluvia {

class RunLog {
public:
    /// Throws Error (render_failed) when the file cannot be opened.
    RunLog(const std::string& dataset, Shard shard);

    /// scene: what items are counted under.
    void add_done(const std::string& id, const std::string& scene, double seconds);
    void add_failed(const std::string& id, const std::string& scene, const std::string& reason);

private:
    void add(const std::string& line);
    std::string path_;
};

struct RunHistory {
    std::map<std::string, std::vector<double>> seconds;  // of frames, by scene
    std::map<std::string, std::string> failures;         // the last reason, by the frame's id
};
/// Of all shards. Damaged lines, as a killed run may leave one, are passed over.
RunHistory read_run_history(const std::string& dataset);

}  // namespace pluvia
