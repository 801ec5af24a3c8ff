#include "tools/learn/training_files.h"

#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "renderer/image/pending_file.h"
#include "tools/learn/picture_files.h"
#include "tools/learning/blend.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pluvia {

std::vector<TrainingFiles> training_files(const std::string& backgrounds, const std::string& masks,
                                          const std::string& rainy) {
    const auto truths = pictures_in(rainy);
    std::vector<TrainingFiles> files;
    for (const PicturePair& pair : pair_pictures(backgrounds, masks)) {
        const auto found = truths.find(pair.name);
        if (found == truths.end()) throw input_error(rainy, fmt::format("has no picture \"{}\"", pair.name));
        files.push_back({pair.background, pair.mask, found->second});
    }
    return files;
}

std::vector<TrainingFiles> training_files_of_dataset(const std::string& list) {
    std::ifstream stream(list);
    if (!stream) throw input_error(list, "cannot be read");
    const auto records = nlohmann::json::parse(stream, nullptr, false);
    if (!records.is_array()) throw input_error(list, "is not a JSON list of records");
    const std::string root = (std::filesystem::path(list).parent_path() / "").string();
    std::vector<TrainingFiles> files;
    for (const auto& record : records) {
        const auto path = [&](const char* key) {
            if (!record.is_object() || !record.contains(key) || !record[key].is_string())
                throw input_error(list, fmt::format("record {} has no \"{}\"", files.size(), key));
            return root + record[key].get<std::string>();
        };
        files.push_back({path("background"), path("rain_layer"), path("rainy_image")});
    }
    return files;
}

TrainingPair read_training_pair(const TrainingFiles& files) {
    Image<Rgba8> layer = read_rgba8(files.mask);
    Image<uint8_t> coverage = rain_coverage(layer);
    return {read_rgba8(files.background), std::move(layer), std::move(coverage), read_rgba8(files.rainy)};
}

LossLog::LossLog(const std::string& path, int first_step) : path_(path) {
    std::ifstream stream(path);
    int step = 0;
    double loss = 0;
    for (std::string line; std::getline(stream, line);)
        if (std::sscanf(line.c_str(), "%d,%lf", &step, &loss) == 2 && step < first_step) add(step, loss);
}

void LossLog::add(int step, double loss) {
    losses_.emplace_back(step, loss);
}

void LossLog::write() const {
    PendingFile file(path_);
    file.stream() << "step,loss\n";
    for (const auto& [step, loss] : losses_) file.stream() << fmt::format("{},{:.6g}\n", step, loss);
    file.commit();
}

void LossLog::plot(const std::string& path) const {
    constexpr int width = 800, height = 400, border = 60;
    constexpr size_t most_points = 400;  // each a mean of its neighbours
    std::vector<std::pair<double, double>> points;
    const size_t group = std::max<size_t>(1, losses_.size() / most_points);
    for (size_t i = 0; i + group <= losses_.size(); i += group) {
        double sum = 0;
        for (size_t k = i; k < i + group; ++k) sum += losses_[k].second;
        points.emplace_back(losses_[i].first, std::log10(std::max(1e-12, sum / double(group))));
    }
    if (points.empty()) return;
    const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                                 [](const auto& a, const auto& b) { return a.second < b.second; });
    const double bottom = low->second, span = std::max(1e-3, high->second - bottom), last = points.back().first + 1;
    std::string line;
    for (const auto& [step, value] : points)
        line += fmt::format("{:.1f},{:.1f} ", border + step / last * (width - 2 * border),
                            height - border - (value - bottom) / span * (height - 2 * border));
    PendingFile file(path);
    file.stream() << fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" font-family=\"sans-serif\" "
        "font-size=\"13\"><rect width=\"{0}\" height=\"{1}\" fill=\"white\"/><polyline fill=\"none\" "
        "stroke=\"#1f5fa8\" "
        "points=\"{2}\"/><text x=\"{3}\" y=\"{4}\">{5:.3g}</text><text x=\"{3}\" y=\"{6}\">{7:.3g}</text>"
        "<text x=\"{8}\" y=\"{9}\" text-anchor=\"end\">step {10:.0f}</text><text x=\"{11}\" y=\"24\">loss, "
        "logarithmic</text></svg>\n",
        width, height, line, 8, border + 4, std::pow(10, high->second), height - border + 4, std::pow(10, bottom),
        width - border, height - border + 24, last, border);
    file.commit();
}

}  // namespace pluvia
