#include "tools/dataset/item_check.h"

#include "renderer/core/error.h"
#include "renderer/image/color.h"
#include "renderer/image/depth_encoding.h"
#include "renderer/image/exr.h"
#include "renderer/image/image_io.h"
#include "tools/dataset/item_files.h"
#include "tools/dataset/layer_check.h"
#include "tools/labels/label_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

using Json = nlohmann::ordered_json;

class ItemCheck {
public:
    ItemCheck(const std::string& dataset, const DatasetItem& item, const Record& record)
        : dataset_(dataset),
          item_(item),
          json_(record.json),
          width_(json_.at("width")),
          height_(json_.at("height")),
          bits_(json_.at("bits")) {}

    std::vector<std::string> faults() {
        if (!(json_.at("residual").get<double>() <= residual_limit))
            fault(item_.record_path(), fmt::format("the layers did not add up (got {}, expected up to {:g})",
                                                   json_.at("residual").dump(), residual_limit));
        const std::string background = json_.at("background");
        check_picture(background, 3, background.ends_with(".jpg") ? 8 : bits_);
        check_picture(json_.at("depth"), 1, 16);
        for (const Json& pair : json_.at("pairs")) {
            check_picture(pair.at("rainy_image"), 3, bits_);
            check_picture(pair.at("rain_layer"), 4, bits_);
            check_picture(pair.at("rain_mask"), 1, 8);
            check_picture(pair.at("rainy_depth"), 1, 16);
            for (const char* key : {"transmittance", "inscatter"})
                if (pair.contains(key)) check_picture(pair.at(key), 3, 16);
        }
        if (!faults_.empty()) return faults_;  // what has not the right size cannot be compared
        check_depths();
        check_rain();
        if (item_.options.view == "srgb") check_sums();
        if (json_.contains("exr")) check_layers(json_.at("exr"));
        return faults_;
    }

private:
    void fault(const std::string& path, const std::string& what) { faults_.push_back(path + ": " + what); }
    std::string full(const std::string& path) const { return dataset_ + "/" + path; }

    void check_picture(const std::string& path, int channels, int bits) {
        const ImageInfo info = read_image_info(full(path));
        if (info.width != width_ || info.height != height_ || info.channels != channels || info.bits != bits)
            fault(path,
                  fmt::format("is another picture (got {} x {} pixels, {} channels of {} bits, expected {} x {}, {} "
                              "of {})",
                              info.width, info.height, info.channels, info.bits, width_, height_, channels, bits));
    }

    void check_depths() {
        const std::string path = json_.at("metric_depth");
        ExrReader exr(full(path));
        if (exr.width() != width_ || exr.height() != height_ || !exr.has_channel("Z"))
            return fault(path, "is no depth of the frame's size (expected a channel Z)");
        std::vector<float> z(size_t(width_) * size_t(height_));
        const ExrRequest request{"Z", z.data()};
        exr.read_rows(0, height_, std::span(&request, 1));
        const auto bad = std::count_if(z.begin(), z.end(), [](float v) { return std::isnan(v) || v <= 0; });
        if (bad > 0) fault(path, fmt::format("{} depths are no numbers above 0", bad));
        const float depth_max = json_.at("depth_max_m");
        const Image<uint16_t> depth = read_grey16(full(json_.at("depth")));
        int64_t differ = 0;
        for (size_t i = 0; i < z.size(); ++i) differ += depth.pixels[i] != encode_hri(z[i], depth_max);
        if (differ > 0)
            fault(json_.at("depth"), fmt::format("{} of {} depths are not those of {}", differ, z.size(), path));
        for (const Json& pair : json_.at("pairs")) {
            const Image<uint16_t> rainy = read_grey16(full(pair.at("rainy_depth")));
            int64_t behind = 0;
            for (size_t i = 0; i < z.size(); ++i) behind += rainy.pixels[i] > depth.pixels[i];
            if (behind > 0)
                fault(pair.at("rainy_depth"), fmt::format("{} streaks are behind the scene's surfaces", behind));
        }
    }

    void check_rain() {
        std::vector<uint8_t> alpha_before(size_t(width_) * size_t(height_), 0);
        double intensity_before = 0, coverage_before = 0;
        for (const Json& pair : json_.at("pairs")) {
            const std::string path = pair.at("rain_layer");
            const Image<Rgba8> layer = read_rgba8(full(path));
            const Image<Rgba8> mask = read_rgba8(full(pair.at("rain_mask")));
            int64_t falls = 0, masked = 0, other_values = 0, misplaced = 0, alpha_sum = 0;
            for (size_t i = 0; i < layer.pixels.size(); ++i) {
                const int alpha = layer.pixels[i].a, shown = mask.pixels[i].r;
                falls += alpha < alpha_before[i];
                alpha_before[i] = uint8_t(alpha);
                alpha_sum += alpha;
                masked += shown == 255;
                other_values += shown != 0 && shown != 255;
                // At 16 bits the line may lie between two values of the 8 that are read here.
                const int slack = bits_ == 8 ? 0 : 1;
                misplaced += shown == 255 ? float(alpha + slack) / 255 < paper_mask_alpha
                                          : float(alpha - slack) / 255 >= paper_mask_alpha;
            }
            const double intensity = pair.at("intensity"), coverage = pair.at("coverage");
            const double pixels = double(width_) * height_;
            if (falls > 0 || coverage < coverage_before)
                fault(path, fmt::format("coverage at {:g} mm/h is below that at {:g} mm/h in {} pixels", intensity,
                                        intensity_before, falls));
            // Each pixel is rounded by at most half a step.
            if (std::abs(double(alpha_sum) / 255 / pixels - coverage) > 0.51 / 255)
                fault(path, fmt::format("the mean of alpha is not the recorded coverage (got {:.5f}, expected {:.5f})",
                                        double(alpha_sum) / 255 / pixels, coverage));
            if (other_values > 0)
                fault(pair.at("rain_mask"), fmt::format("{} values are neither 0 nor 255", other_values));
            if (std::abs(double(masked) / pixels - pair.at("mask_share").get<double>()) > 0.5 / pixels)
                fault(pair.at("rain_mask"), fmt::format("covers {:.5f} of the picture (expected {:.5f} as recorded)",
                                                        double(masked) / pixels, pair.at("mask_share").get<double>()));
            if (item_.options.composition == "paper" && misplaced > 0)
                fault(pair.at("rain_mask"),
                      fmt::format("{} pixels are not where alpha of the rain layer is 0.01 or more", misplaced));
            intensity_before = intensity, coverage_before = coverage;
        }
    }

    /// background x transmittance + rain + inscatter against the rainy picture, in linear light, judged as displayed.
    void check_sums() {
        const std::string background_path = json_.at("background");
        const Image<Rgb> background = read_display(full(background_path));
        for (const Json& pair : json_.at("pairs")) {
            const std::string path = pair.at("rainy_image");
            const Image<Rgb> rainy = read_display(full(path)), rain = read_display(full(pair.at("rain_layer")));
            const Image<Rgba8> layer = read_rgba8(full(pair.at("rain_layer")));
            Image<Rgb> transmittance, inscatter;
            if (pair.contains("inscatter")) {
                transmittance = read_display(full(pair.at("transmittance")));
                inscatter = read_display(full(pair.at("inscatter")));
            }
            const auto difference = [&](size_t i, int c) -> double {
                const auto part = [&](const Image<Rgb>& image) {
                    const Rgb p = image.pixels[i];
                    return c == 0 ? p.r : c == 1 ? p.g : p.b;
                };
                const float b = part(background), r = part(rain), shown = part(rainy);
                const float s = inscatter.pixels.empty() ? 0 : part(inscatter);
                // What is cut off at display white cannot be added up.
                if (std::max({b, r, s, shown}) >= 254.0f / 255) return 0;
                const float t = inscatter.pixels.empty() ? 1 - layer.pixels[i].a / 255.0f : part(transmittance);
                const float sum = linear_from_srgb(b) * t + linear_from_srgb(r) + linear_from_srgb(s);
                return 255 * (std::min(1.0f, srgb_from_linear(sum)) - shown);
            };
            if (!background_path.ends_with(".jpg")) {
                judge(path, difference, [](size_t, int) { return 0.0; });
                continue;
            }
            // What the codec does to a picture with this noise, seen with the same eyes.
            const Image<Rgba8> plain = read_rgba8(full(path));
            const Image<Rgba8> coded = decode_rgba8(encode_jpeg(plain, json_.at("jpeg_quality")), path);
            judge(path, difference, [&](size_t i, int c) -> double {
                const auto part = [&](const Rgba8& p) { return c == 0 ? p.r : c == 1 ? p.g : p.b; };
                const int a = part(coded.pixels[i]), b = part(plain.pixels[i]);
                return std::max(a, b) >= 254 ? 0 : a - b;
            });
        }
    }

    /// difference: of pixel and channel, in levels; codec: the same of what is not the picture's fault.
    template <class Difference, class Codec>
    void judge(const std::string& path, Difference&& difference, Codec&& codec) {
        constexpr int block = 16;
        double whole = 0, whole_codec = 0, worst = 0;
        for (int y = 0; y < height_; y += block)
            for (int x = 0; x < width_; x += block)
                for (int c = 0; c < 3; ++c) {
                    double sum = 0, codec_sum = 0;
                    for (int v = y; v < std::min(height_, y + block); ++v)
                        for (int u = x; u < std::min(width_, x + block); ++u) {
                            const size_t i = size_t(v) * size_t(width_) + size_t(u);
                            sum += difference(i, c), codec_sum += codec(i, c);
                        }
                    whole += sum, whole_codec += codec_sum;
                    // A block that is cut by the border has fewer pixels to average over.
                    worst = std::max(worst, (std::abs(sum) - 2 * std::abs(codec_sum)) / (block * block));
                }
        const double values = 3.0 * width_ * height_;
        const double mean = (std::abs(whole) - 2 * std::abs(whole_codec)) / values;
        if (worst > block_tolerance || mean > picture_tolerance)
            fault(path, fmt::format(
                            "is not the sum of background and rain (got {:.2f} levels in the worst block and {:.2f} in "
                            "the mean beyond the codec's error, expected up to {} and {})",
                            worst, mean, block_tolerance, picture_tolerance));
    }

    void check_layers(const std::string& path) {
        if (!item_.options.layers.empty()) {
            LabelFrame frame(item_.labels(dataset_));
            const LabelCheck labels = check_labels(frame);
            faults_.insert(faults_.end(), labels.faults.begin(), labels.faults.end());
        }
        const LayerCheck check = checked_layers(full(path), item_.options.rain);
        if (check.not_finite() > 0) fault(path, fmt::format("{} values are not finite", check.not_finite()));
        if (!(check.residual() <= residual_limit))
            fault(path, fmt::format("the layers do not add up (got a relative error of {:g}, expected up to {:g})",
                                    check.residual(), residual_limit));
    }

    const std::string& dataset_;
    const DatasetItem& item_;
    const Json& json_;
    int width_, height_, bits_;
    std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> item_faults(const std::string& dataset, const DatasetItem& item, const Record& record) {
    return ItemCheck(dataset, item, record).faults();
}

}  // namespace pluvia
