// What is known of a finished frame of a dataset: its settings, where its files are and what they hold. A frame whose
// record is there and agrees with its files is done; manifests are made of records alone.
#pragma once

#include "tools/dataset/item.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace pluvia {

struct RecordedFile {
    std::string path;  // from the dataset's folder
    uint64_t bytes = 0;
    std::string xxh3;  // 16 hexadecimal digits
};

/// The JSON object of a record with the parts that code asks for.
struct Record {
    nlohmann::ordered_json json;

    std::string text(const char* key) const { return json.at(key).get<std::string>(); }
    std::vector<RecordedFile> files() const;
    void set_files(const std::vector<RecordedFile>& files);
};

/// Fingerprint of everything that decides over a frame's files, but for the program: settings, scene and formats.
std::string settings_hash(const DatasetItem& item, const PictureFormat& format, const std::string& scene_hash);

/// Version and fingerprint of the running program: records of two builds may differ in the noise of pictures.
const std::string& build_name();

/// The record in a file; empty when there is none or it is damaged.
std::optional<Record> read_record(const std::string& path);
inline std::optional<Record> read_record(const std::string& dataset, const DatasetItem& item) {
    return read_record(dataset + "/" + item.record_path());
}

/// What is wrong with a recorded file, or empty: missing, of another size or with other bytes.
std::string file_fault(const std::string& dataset, const RecordedFile& file);

/// Whether the item of a record is done: the record has these settings and all its files are as recorded.
bool is_done(const std::string& dataset, const std::string& record_path, const std::string& settings_hash);
inline bool is_done(const std::string& dataset, const DatasetItem& item, const std::string& settings_hash) {
    return is_done(dataset, item.record_path(), settings_hash);
}

}  // namespace pluvia
