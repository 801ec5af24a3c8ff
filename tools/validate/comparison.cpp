#include "tools/validate/comparison.h"

#include "renderer/core/error.h"
#include "renderer/image/color.h"
#include "tools/validate/color_metrics.h"
#include "tools/validate/depth_metrics.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace pluvia {
namespace {

namespace fs = std::filesystem;

template <class T>
Image<T> crop(const Image<T>& image, const PictureRegion& r) {
    if (r.width == image.width && r.height == image.height) return image;
    Image<T> part(r.width, r.height);
    for (int y = 0; y < r.height; ++y) std::copy_n(&image.at(r.x, r.y + y), r.width, &part.at(0, y));
    return part;
}

double mean_value(const Image<float>& image) {
    double sum = 0;
    for (const float v : image.pixels) sum += v;
    return sum / double(image.pixels.size());
}

double automatic_white(const Image<Rgb>& reference) {
    std::vector<float> luminances;
    for (const Rgb p : reference.pixels) luminances.push_back(luminance(p));
    const auto place = luminances.begin() + std::ptrdiff_t(double(luminances.size() - 1) * 0.98);
    std::nth_element(luminances.begin(), place, luminances.end());
    return *place > 0 ? *place : 1;
}

Image<Rgb> linear_from_display(Image<Rgb> picture) {
    for (Rgb& p : picture.pixels) p = {linear_from_srgb(p.r), linear_from_srgb(p.g), linear_from_srgb(p.b)};
    return picture;
}

Image<float> depth_difference(const Image<float>& a, const Image<float>& b) {
    Image<float> error(a.width, a.height);
    for (size_t i = 0; i < error.pixels.size(); ++i) {
        const float x = a.pixels[i], y = b.pixels[i];
        if (std::isfinite(x) && std::isfinite(y) && x > 0 && y > 0) error.pixels[i] = std::abs(x - y) / y;
    }
    return error;
}

Image<float> mask_difference(const Image<float>& a, const Image<float>& b) {
    Image<float> error(a.width, a.height);
    for (size_t i = 0; i < error.pixels.size(); ++i) error.pixels[i] = (a.pixels[i] >= 0.5f) != (b.pixels[i] >= 0.5f);
    return error;
}

/// Displayed pictures and FLIP maps of a pair of colours, made once for all regions.
struct ColorMaps {
    Image<Rgb> shown_a, shown_b;
    Image<float> ldr, hdr;
};

RegionMetrics color_metrics(const ComparedPair& pair, const ColorMaps& maps, const PictureRegion& region) {
    const Image<Rgb> a = crop(pair.a.color, region), b = crop(pair.b.color, region);
    const Image<Rgb> shown_a = crop(maps.shown_a, region), shown_b = crop(maps.shown_b, region);
    RegionMetrics r{region.name, {}};
    const auto relative = relative_squared_errors(a, b);
    const Bias difference = bias(a, b);
    r.metrics = {{"mse", mean_squared_error(a, b)},
                 {"relmse", mean(relative)},
                 {"relmse_trimmed", trimmed_mean(relative)},
                 {"bias", difference.value},
                 {"bias_r", difference.channel[0]},
                 {"bias_g", difference.channel[1]},
                 {"bias_b", difference.channel[2]},
                 {"psnr", psnr(shown_a, shown_b)},
                 {"ssim", ssim(shown_a, shown_b)}};
    if (!maps.ldr.pixels.empty()) r.metrics.emplace_back("flip_ldr", mean_value(crop(maps.ldr, region)));
    if (!maps.hdr.pixels.empty()) r.metrics.emplace_back("flip_hdr", mean_value(crop(maps.hdr, region)));
    r.bias_low = difference.low, r.bias_high = difference.high;
    return r;
}

RegionMetrics value_metrics(const ComparedPair& pair, const PictureRegion& region) {
    const Image<float> a = crop(pair.a.value, region), b = crop(pair.b.value, region);
    if (pair.result.kind == PictureKind::mask) {
        const MaskAgreement m = mask_agreement(a, b);
        return {region.name, {{"iou", m.iou}, {"precision", m.precision}, {"recall", m.recall}}};
    }
    const DepthErrors e = depth_errors(a, b);
    return {region.name,
            {{"abs_rel", e.abs_rel},
             {"rmse", e.rmse},
             {"delta1", e.delta[0]},
             {"delta2", e.delta[1]},
             {"delta3", e.delta[2]},
             {"missing", e.missing}}};
}

ComparedPair compare_files(const std::string& a, const std::string& b, const std::string& layers,
                           const CompareSettings& settings) {
    ComparedPair pair;
    ReadSettings read = settings.read;
    const size_t colon = layers.find(':');
    read.layer = layers.substr(0, colon);
    pair.a = read_compared_picture(a, read);
    if (colon != std::string::npos) read.layer = layers.substr(colon + 1);
    pair.b = read_compared_picture(b, read);
    if (pair.a.width() != pair.b.width() || pair.a.height() != pair.b.height())
        throw input_error(a, fmt::format("has another size than {} (got {}x{}, expected {}x{})", b, pair.a.width(),
                                         pair.a.height(), pair.b.width(), pair.b.height()));
    if (pair.a.kind != pair.b.kind)
        throw input_error(a, fmt::format("cannot be compared with {} (got {}, expected {})", b,
                                         picture_kind_name(pair.a.kind), picture_kind_name(pair.b.kind)));
    PairResult& result = pair.result;
    result.kind = pair.a.kind;
    result.layer_a = pair.a.layer, result.layer_b = pair.b.layer;
    result.origin_a = pair.a.origin, result.origin_b = pair.b.origin;
    result.width = pair.a.width(), result.height = pair.a.height();

    std::vector<PictureRegion> regions = {{"all", 0, 0, result.width, result.height}};
    for (const PictureRegion& r : settings.regions) {
        if (r.width > result.width - r.x || r.height > result.height - r.y)
            throw usage_error(
                "--region", fmt::format("{} is not inside the picture (got {},{},{},{}, expected inside {}x{})", r.name,
                                        r.x, r.y, r.width, r.height, result.width, result.height));
        regions.push_back(r);
    }
    if (result.kind == PictureKind::depth || result.kind == PictureKind::mask) {
        const bool is_depth = result.kind == PictureKind::depth;
        pair.error =
            is_depth ? depth_difference(pair.a.value, pair.b.value) : mask_difference(pair.a.value, pair.b.value);
        for (const PictureRegion& region : regions) result.regions.push_back(value_metrics(pair, region));
        return pair;
    }
    const bool is_light = result.kind == PictureKind::light;
    if (is_light) result.white = settings.white.value_or(automatic_white(pair.b.color));
    ColorMaps maps{displayed(pair.a, result.white), displayed(pair.b, result.white), {}, {}};
    if (settings.flip) {
        maps.ldr =
            ldr_flip(linear_from_display(maps.shown_a), linear_from_display(maps.shown_b), settings.pixels_per_degree);
        if (is_light) maps.hdr = hdr_flip(pair.a.color, pair.b.color, settings.pixels_per_degree);
    }
    for (const PictureRegion& region : regions) result.regions.push_back(color_metrics(pair, maps, region));
    pair.error = is_light ? std::move(maps.hdr) : std::move(maps.ldr);
    return pair;
}

std::set<std::string> pictures_in(const std::string& folder) {
    const std::set<std::string> endings = {".exr", ".png", ".jpg",  ".jpeg", ".tif", ".tiff",
                                           ".hdr", ".bmp", ".webp", ".pfm",  ".ppm", ".pgm"};
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        std::string ending = entry.path().extension();
        std::transform(ending.begin(), ending.end(), ending.begin(),
                       [](unsigned char c) { return char(std::tolower(c)); });
        if (entry.is_regular_file() && endings.contains(ending)) names.insert(fs::relative(entry.path(), folder));
    }
    return names;
}

/// Files of both folders, which must be the same.
std::set<std::string> common_pictures(const std::string& a, const std::string& b) {
    const std::set<std::string> in_a = pictures_in(a), in_b = pictures_in(b);
    const auto missing = [](const std::set<std::string>& here, const std::set<std::string>& there) {
        std::vector<std::string> names;
        std::set_difference(here.begin(), here.end(), there.begin(), there.end(), std::back_inserter(names));
        if (names.size() > 5) names[4] = fmt::format("and {} more", names.size() - 4), names.resize(5);
        return names;
    };
    for (const auto& [folder, names] : {std::pair{a, missing(in_b, in_a)}, {b, missing(in_a, in_b)}})
        if (!names.empty())
            throw input_error(folder, fmt::format("lacks pictures that the other has: {}", fmt::join(names, ", ")));
    if (in_a.empty()) throw input_error(a, "holds no pictures");
    return in_a;
}

}  // namespace

PictureRegion parse_region(const std::string& text) {
    PictureRegion r;
    const size_t equals = text.find('=');
    char end = 0;
    if (equals == std::string::npos || equals == 0 ||
        std::sscanf(text.c_str() + equals + 1, "%d,%d,%d,%d%c", &r.x, &r.y, &r.width, &r.height, &end) != 4 ||
        r.x < 0 || r.y < 0 || r.width < 1 || r.height < 1)
        throw usage_error("--region",
                          fmt::format("is not a region (got \"{}\", expected NAME=X,Y,WIDTH,HEIGHT)", text));
    r.name = text.substr(0, equals);
    return r;
}

Image<Rgb> displayed(const ComparedPicture& picture, double white) {
    Image<Rgb> shown = picture.color;
    if (picture.kind != PictureKind::light) return shown;
    const auto show = [&](float v) { return srgb_from_linear(float(std::clamp(double(v) / white, 0.0, 1.0))); };
    for (Rgb& p : shown.pixels) p = {show(p.r), show(p.g), show(p.b)};
    return shown;
}

std::vector<PairResult> compare(const std::string& a, const std::string& b, const CompareSettings& settings,
                                const std::function<void(const ComparedPair&)>& visit) {
    for (const std::string& path : {a, b})
        if (!fs::exists(path)) throw input_error(path, "does not exist");
    const bool folders = fs::is_directory(a);
    if (folders != fs::is_directory(b))
        throw input_error(folders ? b : a, "is a file (expected a folder like the other)");
    std::vector<PairResult> results;
    const auto add = [&](const std::string& name, const std::string& file_a, const std::string& file_b,
                         const std::string& layers) {
        ComparedPair pair = compare_files(file_a, file_b, layers, settings);
        pair.result.name = layers.empty() ? name : name + " " + layers;
        if (visit) visit(pair);
        results.push_back(pair.result);
    };
    if (!folders) {
        for (const std::string& layers : settings.layers) add(fs::path(a).filename(), a, b, layers);
        return results;
    }
    for (const std::string& name : common_pictures(a, b)) {
        const std::string file_a = fs::path(a) / name, file_b = fs::path(b) / name;
        if (fs::path(name).extension() == ".exr")
            for (const std::string& layers : settings.layers) add(name, file_a, file_b, layers);
        else
            add(name, file_a, file_b, "");
    }
    return results;
}

std::vector<RegionMetrics> mean_over_pairs(const std::vector<PairResult>& pairs) {
    std::vector<RegionMetrics> means;
    for (size_t r = 0; r < pairs[0].regions.size(); ++r) {
        RegionMetrics region{pairs[0].regions[r].name, {}};
        for (const MetricInfo& info : metric_list()) {
            double sum = 0;
            int count = 0;
            for (const PairResult& pair : pairs)
                for (const auto& [name, value] : pair.regions[r].metrics)
                    if (name == info.name) sum += value, ++count;
            if (count > 0) region.metrics.emplace_back(info.name, sum / count);
        }
        means.push_back(region);
    }
    return means;
}

}  // namespace pluvia
