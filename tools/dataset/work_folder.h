// Where a run keeps what is not finished: a folder of its own inside of the dataset, so that finished files need only a
// new name and two runs never write the same file.
#pragma once

#include "tools/dataset/item.h"

#include <string>

namespace pluvia {

class WorkFolder {
public:
    /// Makes a folder of this shard, host and process in DATASET/work, and removes those that dead processes of the
    /// same host have left. Throws Error (render_failed) when that is impossible.
    WorkFolder(const std::string& dataset, Shard shard);
    /// Removes it, and DATASET/work when nobody else is in it.
    ~WorkFolder();
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string root_, path_;
};

/// How many runs have a folder there: those at work, and those of other machines that were killed.
int count_work_folders(const std::string& dataset);
/// Removes folders of runs that are not alive. everywhere: also those of other machines, which nobody can ask.
void remove_abandoned_work(const std::string& dataset, bool everywhere);

/// Makes the folders above a path. Throws Error (render_failed).
void make_folder_of(const std::string& path);
/// A file's final name: makes its folder and renames. Throws Error (render_failed).
void move_into_place(const std::string& from, const std::string& to);

}  // namespace pluvia
