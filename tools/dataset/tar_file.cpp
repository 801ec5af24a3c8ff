#include "tools/dataset/tar_file.h"

#include "renderer/core/error.h"
#include "renderer/image/pending_file.h"

#include <archive.h>
#include <archive_entry.h>

#include <sstream>

namespace pluvia {

struct TarWriter::State {
    PendingFile pending;
    std::unique_ptr<archive, decltype(&archive_write_free)> tar{archive_write_new(), archive_write_free};

    explicit State(const std::string& path) : pending(path) {
        const auto write = [](archive*, void* self, const void* bytes, size_t size) -> la_ssize_t {
            std::ofstream& stream = static_cast<State*>(self)->pending.stream();
            return stream.write(static_cast<const char*>(bytes), std::streamsize(size)) ? la_ssize_t(size) : -1;
        };
        require(archive_write_set_format_ustar(tar.get()));
        require(archive_write_open(tar.get(), this, nullptr, write, nullptr));
    }
    void require(int status) {
        if (status == ARCHIVE_OK) return;
        const char* reason = archive_error_string(tar.get());
        throw pending.write_error(reason ? reason : "the disk may be full");
    }
};

TarWriter::TarWriter(const std::string& path) : state_(std::make_unique<State>(path)) {}
TarWriter::~TarWriter() = default;

void TarWriter::add(const std::string& name, const std::string& bytes) {
    const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> entry(archive_entry_new(), archive_entry_free);
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_size(entry.get(), la_int64_t(bytes.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    archive_entry_set_mtime(entry.get(), 0, 0);
    state_->require(archive_write_header(state_->tar.get(), entry.get()));
    if (archive_write_data(state_->tar.get(), bytes.data(), bytes.size()) != la_ssize_t(bytes.size()))
        throw state_->pending.write_error("the disk may be full");
}

void TarWriter::add_file(const std::string& name, const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    if (!file) throw input_error(path, "cannot be read");
    add(name, bytes.str());
}

void TarWriter::finish() {
    state_->require(archive_write_close(state_->tar.get()));
    state_->pending.commit();
}

}  // namespace pluvia
