#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "tools/learn/learn_commands.h"
#include "tools/learn/picture_files.h"
#include "tools/learning/blend.h"
#include "tools/validate/color_metrics.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>

namespace pluvia {
namespace {

struct EvaluateOptions {
    std::string prediction, truth, mask;
    bool json = false;
};

struct Score {
    std::string name;
    double psnr, ssim, rain_psnr;  // the last where there is rain only; NaN without a mask
};

/// psnr() of the pixels that have rain.
double psnr_in_rain(const Image<Rgb>& a, const Image<Rgb>& b, const Image<uint8_t>& coverage) {
    Image<Rgb> rain_a, rain_b;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        if (coverage.pixels[i] >= rain_alpha) {
            rain_a.pixels.push_back(a.pixels[i]);
            rain_b.pixels.push_back(b.pixels[i]);
        }
    if (rain_a.pixels.empty()) return NAN;
    rain_a.width = rain_b.width = int(rain_a.pixels.size());
    rain_a.height = rain_b.height = 1;
    return psnr(rain_a, rain_b);
}

void require_same_size(const std::string& path, int width, int height, int expected_width, int expected_height) {
    if (width != expected_width || height != expected_height)
        throw input_error(path, fmt::format("has another size (got {}x{}, expected {}x{})", width, height,
                                            expected_width, expected_height));
}

void evaluate_command(const EvaluateOptions& o) {
    const auto predictions = pictures_in(o.prediction), truths = pictures_in(o.truth);
    const auto masks = o.mask.empty() ? std::map<std::string, std::string>() : pictures_in(o.mask);
    const auto partner = [](const std::map<std::string, std::string>& pictures, const std::string& folder,
                            const std::string& name) {
        const auto found = pictures.size() == 1 ? pictures.begin() : pictures.find(name);
        if (found == pictures.end()) throw input_error(folder, fmt::format("has no picture \"{}\"", name));
        return found->second;
    };
    std::vector<Score> scores;
    for (const auto& [name, path] : truths) {
        const std::string prediction = partner(predictions, o.prediction, name);
        const Image<Rgb> b = read_display(path), a = read_display(prediction);
        require_same_size(prediction, a.width, a.height, b.width, b.height);
        double in_rain = NAN;
        if (!masks.empty()) {
            const std::string mask = partner(masks, o.mask, name);
            const Image<uint8_t> coverage = rain_coverage(read_rgba8(mask));
            require_same_size(mask, coverage.width, coverage.height, b.width, b.height);
            in_rain = psnr_in_rain(a, b, coverage);
        }
        scores.push_back({name, psnr(a, b), ssim(a, b), in_rain});
    }
    Score mean{"mean", 0, 0, 0};
    int with_rain = 0;
    for (const Score& s : scores) {
        mean.psnr += s.psnr / double(scores.size());
        mean.ssim += s.ssim / double(scores.size());
        if (!std::isnan(s.rain_psnr)) mean.rain_psnr += s.rain_psnr, ++with_rain;
    }
    mean.rain_psnr = with_rain > 0 ? mean.rain_psnr / with_rain : NAN;
    if (o.json) {
        const auto to_json = [](const Score& s) {
            nlohmann::ordered_json j = {{"psnr_db", s.psnr}, {"ssim", s.ssim}};
            if (!std::isnan(s.rain_psnr)) j["rain_psnr_db"] = s.rain_psnr;
            return j;
        };
        nlohmann::ordered_json j;
        for (const Score& s : scores) j["pictures"][s.name] = to_json(s);
        j["mean"] = to_json(mean);
        std::cout << j.dump(2) << "\n";
        return;
    }
    scores.push_back(mean);
    std::cout << fmt::format("{:<32} {:>9} {:>7} {:>14}\n", "picture", "PSNR dB", "SSIM", "PSNR in rain");
    for (const Score& s : scores)
        std::cout << fmt::format("{:<32} {:>9.3f} {:>7.4f} {:>14}\n", s.name, s.psnr, s.ssim,
                                 std::isnan(s.rain_psnr) ? "-" : fmt::format("{:.3f}", s.rain_psnr));
}

}  // namespace

void add_learn_evaluate_command(CLI::App& learn) {
    auto* command = learn.add_subcommand(
        "evaluate",
        "PSNR and SSIM of rainy pictures against the truth, as RainImageEvaluation defines them, and PSNR of the\n"
        "pixels that have rain. Means are over pictures; a picture without partner is an error.");
    auto options = std::make_shared<EvaluateOptions>();
    EvaluateOptions& o = *options;
    command->add_option("--prediction", o.prediction, "pictures to judge: a folder or one file")->required();
    command->add_option("--truth", o.truth, "the same pictures as they should be")->required();
    command->add_option("--mask", o.mask, "rain layers or masks of the same names, or one file for all");
    command->add_flag("--json", o.json, "print JSON");
    command->footer("Example:\n  pluvia learn evaluate --prediction rainy --truth rendered --mask masks");
    command->callback([options] { evaluate_command(*options); });
}

}  // namespace pluvia
