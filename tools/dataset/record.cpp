#include "tools/dataset/record.h"

#include "tools/dataset/file_hash.h"
#include "tools/frame_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace pluvia {

using Json = nlohmann::ordered_json;

std::vector<RecordedFile> Record::files() const {
    std::vector<RecordedFile> files;
    for (const Json& file : json.at("files"))
        files.push_back(
            {file.at("path").get<std::string>(), file.at("bytes").get<uint64_t>(), file.at("xxh3").get<std::string>()});
    return files;
}

void Record::set_files(const std::vector<RecordedFile>& files) {
    json["files"] = Json::array();
    for (const RecordedFile& file : files)
        json["files"].push_back({{"path", file.path}, {"bytes", file.bytes}, {"xxh3", file.xxh3}});
}

std::string settings_hash(const DatasetItem& item, const PictureFormat& format, const std::string& scene_hash) {
    // The number of the layout: files of frames done by an older one are made anew.
    constexpr int layout = 1;
    // Rules of labels are a file of their own: what they say counts, not what the file is called.
    const std::string& rules = item.options.labels;
    const std::string settings = json_text(to_json(item.options)) + (rules.empty() ? "" : hash_file(rules));
    return fmt::format("{:016x}",
                       hash_text(fmt::format("{} {} {} {} {} {} {} {}", layout, item.id(), item.split(), settings,
                                             scene_hash, format.bits, format.jpeg_quality, format.exr)));
}

const std::string& build_name() {
    static const std::string name = std::string(PLUVIA_VERSION) + "+" + hash_file("/proc/self/exe");
    return name;
}

std::optional<Record> read_record(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::nullopt;
    try {
        Record record{Json::parse(file)};
        record.files();
        record.text("settings_hash"), record.text("scene_hash"), record.text("build");
        record.json.at("pairs").at(0).at("intensity");
        return record;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

std::string file_fault(const std::string& dataset, const RecordedFile& file) {
    const std::string path = dataset + "/" + file.path;
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path, error);
    if (error) return "is missing";
    if (bytes != file.bytes) return fmt::format("has another size (got {} bytes, expected {})", bytes, file.bytes);
    if (const std::string hash = hash_file(path); hash != file.xxh3)
        return fmt::format("holds other bytes (got xxh3 {}, expected {})", hash, file.xxh3);
    return "";
}

bool is_done(const std::string& dataset, const std::string& record_path, const std::string& settings) {
    const auto record = read_record(dataset + "/" + record_path);
    if (!record || record->text("settings_hash") != settings) return false;
    for (const RecordedFile& file : record->files())
        if (!file_fault(dataset, file).empty()) return false;
    return true;
}

}  // namespace pluvia
