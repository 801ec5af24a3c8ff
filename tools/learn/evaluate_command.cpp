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
    std::string prediction, truth, mask, lpips, fid;
    bool json = false;
};

struct Score {
    std::string name;
    double psnr, ssim;
    double rain_psnr;  // where there is rain; NaN without a mask
    double lpips;      // NaN where it is not asked for
};

std::vector<std::string> arguments_of(const EvaluateOptions& o) {
    std::vector<std::string> arguments = {"--prediction", o.prediction, "--truth", o.truth};
    const auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) arguments.insert(arguments.end(), {option, value});
    };
    add("--mask", o.mask);
    add("--lpips", o.lpips);
    add("--fid", o.fid);
    if (o.json) arguments.push_back("--json");
    return arguments;
}

/// Without those that are NaN; NaN when all are.
double mean_of(const std::vector<Score>& scores, double Score::*member) {
    double sum = 0;
    int n = 0;
    for (const Score& s : scores)
        if (!std::isnan(s.*member)) sum += s.*member, ++n;
    return n > 0 ? sum / n : NAN;
}

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

void evaluate_command(const EvaluateOptions& o, const OpenTrainedScores& open) {
    TrainedScores trained;
    if (!o.lpips.empty() || !o.fid.empty()) trained = open(o.lpips, o.fid, arguments_of(o));
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
        scores.push_back({name, psnr(a, b), ssim(a, b), in_rain, trained.lpips ? trained.lpips(a, b) : NAN});
        if (trained.add_to_fid) trained.add_to_fid(a, b);
    }
    const Score mean{"mean", mean_of(scores, &Score::psnr), mean_of(scores, &Score::ssim),
                     mean_of(scores, &Score::rain_psnr), mean_of(scores, &Score::lpips)};
    const double fid = trained.fid ? trained.fid() : NAN;
    if (o.json) {
        const auto to_json = [](const Score& s) {
            nlohmann::ordered_json j = {{"psnr_db", s.psnr}, {"ssim", s.ssim}};
            if (!std::isnan(s.rain_psnr)) j["rain_psnr_db"] = s.rain_psnr;
            if (!std::isnan(s.lpips)) j["lpips"] = s.lpips;
            return j;
        };
        nlohmann::ordered_json j;
        for (const Score& s : scores) j["pictures"][s.name] = to_json(s);
        j["mean"] = to_json(mean);
        if (!std::isnan(fid)) j["fid"] = fid;
        std::cout << j.dump(2) << "\n";
        return;
    }
    scores.push_back(mean);
    const auto text = [](double value, int digits) {
        return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, digits);
    };
    std::cout << fmt::format("{:<32} {:>9} {:>7} {:>14}{}\n", "picture", "PSNR dB", "SSIM", "PSNR in rain",
                             trained.lpips ? "   LPIPS" : "");
    for (const Score& s : scores)
        std::cout << fmt::format("{:<32} {:>9.3f} {:>7.4f} {:>14}{}\n", s.name, s.psnr, s.ssim, text(s.rain_psnr, 3),
                                 trained.lpips ? fmt::format(" {:>7}", text(s.lpips, 4)) : "");
    if (!std::isnan(fid)) std::cout << fmt::format("FID {:.3f} of {} pictures\n", fid, truths.size());
}

}  // namespace

void add_learn_evaluate_command(CLI::App& learn, OpenTrainedScores open) {
    auto* command = learn.add_subcommand(
        "evaluate",
        "PSNR and SSIM of rainy pictures against the truth, as RainImageEvaluation defines them, and PSNR of the\n"
        "pixels that have rain. Means are over pictures; a picture without partner is an error.");
    auto options = std::make_shared<EvaluateOptions>();
    EvaluateOptions& o = *options;
    command->add_option("--prediction", o.prediction, "pictures to judge: a folder or one file")->required();
    command->add_option("--truth", o.truth, "the same pictures as they should be")->required();
    command->add_option("--mask", o.mask, "rain layers or masks of the same names, or one file for all");
    command->add_option(
        "--lpips", o.lpips,
        "also LPIPS 0.1 by these weights: AlexNet's or VGG16's features of torchvision and the linear heads\n"
        "of lpips in one .safetensors (tools/learning/convert_checkpoint.py); needs libtorch");
    command->add_option(
        "--fid", o.fid,
        "also FID by the weights of pytorch-fid (pt_inception-2015-12-05) as .safetensors: features of\n"
        "2,048 values, pictures brought to 299x299. Fewer pictures make a larger FID: compare equal numbers\n"
        "only; needs libtorch");
    command->add_flag("--json", o.json, "print JSON");
    command->footer("Example:\n  pluvia learn evaluate --prediction rainy --truth rendered --mask masks");
    command->callback([options, open] { evaluate_command(*options, open); });
}

}  // namespace pluvia
