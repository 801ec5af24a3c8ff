// The file that a fuzz target hands to a reader: a million of them should not wait for a disk.
#pragma once

#include <unistd.h>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace pluvia {

/// In a folder of its own, in memory where the system has such; removed at the end.
struct MemoryFile {
    std::string folder, path;

    explicit MemoryFile(const std::string& name)
        : folder((std::filesystem::is_directory("/dev/shm") ? "/dev/shm/pluvia_fuzz_" : "/tmp/pluvia_fuzz_") +
                 std::to_string(getpid())),
          path(folder + "/" + name) {
        std::filesystem::create_directories(folder);
    }
    ~MemoryFile() {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }
    MemoryFile(const MemoryFile&) = delete;

    void write(const uint8_t* bytes, size_t size) const {
        std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes), std::streamsize(size));
    }
};

}  // namespace pluvia
