// A file on its way to its final name: written beside it and renamed when whole, so that no reader meets half a file.
// Used by image_io.h and exr.h.
#pragma once

#include "renderer/core/error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace pluvia {

/// Owns a temporary file in the folder of the final one; removes it unless committed. Errors are Error (render_failed).
class PendingFile {
public:
    /// NAME.EXT is written as NAME.tmp.EXT; its folder is made. Throws when that is impossible.
    explicit PendingFile(const std::filesystem::path& path)
        : path_(path), temporary_(path.parent_path() / (path.stem().string() + ".tmp" + path.extension().string())) {
        std::error_code ignored;  // said by the file that cannot be opened
        std::filesystem::create_directories(path.parent_path(), ignored);
        stream_.open(temporary_, std::ios::binary);
        if (!stream_) throw write_error(std::strerror(errno));
    }
    ~PendingFile() {
        std::error_code ignored;  // a destructor has nobody to tell
        if (!committed_) std::filesystem::remove(temporary_, ignored);
    }
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    /// What is written here becomes the file. Failures may be ignored until commit().
    std::ofstream& stream() { return stream_; }

    /// Gives the file its final name, replacing what had it. Throws when any byte could not be written.
    void commit() {
        stream_.close();
        if (!stream_) throw write_error("the disk may be full");
        std::error_code error;
        std::filesystem::rename(temporary_, path_, error);
        if (error) throw write_error(error.message());
        committed_ = true;
    }

    Error write_error(const std::string& reason) const {
        return {ExitCode::render_failed, path_.string(), "cannot be written (" + reason + ")"};
    }

private:
    std::filesystem::path path_, temporary_;
    std::ofstream stream_;
    bool committed_ = false;
};

}  // namespace pluvia
