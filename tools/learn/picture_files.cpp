#include "tools/learn/picture_files.h"

#include "renderer/core/error.h"
#include "renderer/image/pending_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return tolower(c); });
    constexpr std::array known = {".png", ".jpg", ".jpeg", ".webp", ".tif", ".tiff", ".bmp"};
    return std::find(known.begin(), known.end(), extension) != known.end();
}

}  // namespace

std::map<std::string, std::string> pictures_in(const std::string& path) {
    std::error_code error;
    if (fs::is_regular_file(path, error)) return {{fs::path(path).stem().string(), path}};
    if (!fs::is_directory(path, error)) throw input_error(path, "is neither a picture nor a folder");
    std::map<std::string, std::string> pictures;
    for (const auto& entry : fs::directory_iterator(path)) {
        if (!entry.is_regular_file() || !is_picture(entry.path())) continue;
        const auto [other, is_new] = pictures.emplace(entry.path().stem().string(), entry.path().string());
        if (!is_new)
            throw input_error(
                path, fmt::format("two pictures have the same name (got {} and {})",
                                  fs::path(other->second).filename().string(), entry.path().filename().string()));
    }
    if (pictures.empty()) throw input_error(path, "holds no pictures");
    return pictures;
}

std::vector<PicturePair> pair_pictures(const std::string& backgrounds, const std::string& masks) {
    const auto clean = pictures_in(backgrounds), rain = pictures_in(masks);
    std::vector<PicturePair> pairs;
    if (clean.size() == 1 && rain.size() > 1)
        for (const auto& [name, path] : rain) pairs.push_back({name, clean.begin()->second, path});
    else if (rain.size() == 1)
        for (const auto& [name, path] : clean) pairs.push_back({name, path, rain.begin()->second});
    else
        for (const auto& [name, path] : clean) {
            const auto found = rain.find(name);
            if (found == rain.end()) throw input_error(masks, fmt::format("has no mask for \"{}\"", path));
            pairs.push_back({name, path, found->second});
        }
    return pairs;
}

void write_picture_labels(const std::string& path, const std::vector<LabelledPicture>& pictures) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const LabelledPicture& p : pictures) list.push_back({{"img", p.name}, {"label", {p.intensity, p.wind}}});
    PendingFile file(path);
    file.stream() << list.dump(2) << "\n";
    file.commit();
}

}  // namespace pluvia
