#include "tools/dataset/work_folder.h"

#include "renderer/core/error.h"
#include "tools/option_check.h"

#include <fmt/format.h>

#include <signal.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <filesystem>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

/// Letters, digits, points and dashes, so that '_' divides the parts of a folder's name.
std::string host_name() {
    std::array<char, 256> name = {};
    gethostname(name.data(), name.size() - 1);
    std::string text(name.data());
    std::replace(text.begin(), text.end(), '_', '-');
    return text.empty() ? "host" : text;
}

/// Whether the run that a folder is named after may still be at work.
bool may_be_alive(const std::string& folder, bool everywhere) {
    const size_t host = folder.find('_'), process = folder.rfind('_');
    int pid = 0;
    if (host == process || !parse_number(std::string_view(folder).substr(process + 1), pid)) return false;
    if (folder.substr(host + 1, process - host - 1) != host_name()) return !everywhere;
    return kill(pid, 0) == 0 || errno == EPERM;
}

}  // namespace

WorkFolder::WorkFolder(const std::string& dataset, Shard shard)
    : root_(dataset + "/work"), path_(fmt::format("{}/{}_{}_{}", root_, shard.label(), host_name(), getpid())) {
    remove_abandoned_work(dataset, false);
    std::error_code error;
    // Another run that ends may remove the folder above in the same moment.
    for (int attempt = 0; attempt < 10 && (attempt == 0 || error); ++attempt) fs::create_directories(path_, error);
    if (error) throw Error(ExitCode::render_failed, path_, fmt::format("cannot be made ({})", error.message()));
}

WorkFolder::~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    fs::remove(root_, ignored);  // only when it is empty
}

int count_work_folders(const std::string& dataset) {
    int count = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(dataset + "/work", error))
        count += may_be_alive(entry.path().filename(), false);
    return count;
}

void remove_abandoned_work(const std::string& dataset, bool everywhere) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(dataset + "/work", ignored))
        if (!may_be_alive(entry.path().filename(), everywhere)) fs::remove_all(entry.path(), ignored);
    fs::remove(dataset + "/work", ignored);
}

void make_folder_of(const std::string& path) {
    const fs::path folder = fs::path(path).parent_path();
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw Error(ExitCode::render_failed, folder.string(), fmt::format("cannot be made ({})", error.message()));
}

void move_into_place(const std::string& from, const std::string& to) {
    make_folder_of(to);
    std::error_code error;
    fs::rename(from, to, error);
    if (error) throw Error(ExitCode::render_failed, to, fmt::format("cannot be written ({})", error.message()));
}

}  // namespace pluvia
