// Tar archives whose bytes depend on nothing but what is put in; the libarchive door.
#pragma once

#include <memory>
#include <string>

namespace pluvia {

/// Appears whole, by rename. Entries have no owner and no time. Throws Error (render_failed) when it cannot be written.
class TarWriter {
public:
    explicit TarWriter(const std::string& path);
    ~TarWriter();

    void add(const std::string& name, const std::string& bytes);
    /// The same of a file's bytes. Throws Error (input) when it cannot be read.
    void add_file(const std::string& name, const std::string& path);
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pluvia
