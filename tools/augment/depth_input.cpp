#include "tools/augment/depth_input.h"

#include "renderer/core/error.h"
#include "renderer/image/depth_encoding.h"
#include "renderer/image/exr.h"
#include "renderer/image/image_io.h"
#include "tools/augment/npy_file.h"
#include "tools/validate/exr_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace pluvia {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

Image<float> read_grey_depth(const std::string& path, const DepthFormat& format) {
    if (read_image_info(path).bits != 16)
        throw input_error(path, fmt::format("is no depth of this encoding (got {} bits a value, expected 16)",
                                            read_image_info(path).bits));
    const Image<uint16_t> stored = read_grey16(path);
    Image<float> z(stored.width, stored.height);
    for (size_t i = 0; i < z.pixels.size(); ++i) {
        const uint16_t v = stored.pixels[i];
        float& metres = z.pixels[i];
        if (v == 0)
            metres = unknown;
        else if (format.encoding == DepthInput::kitti16)
            metres = decode_kitti16(v);
        else if (format.encoding == DepthInput::mm16)
            metres = decode_mm16(v);
        else
            metres = v == 1 ? infinity : float(format.focal_times_baseline * 256 / (v - 1));
    }
    return z;
}

/// Each pixel moved by its disparity; of several that meet the nearest stays.
Image<float> from_right(const Image<float>& left, double focal_times_baseline) {
    Image<float> right(left.width, left.height, unknown);
    for (int y = 0; y < left.height; ++y)
        for (int x = 0; x < left.width; ++x) {
            const float z = left.at(x, y);
            const double moved = std::isnan(z) ? -1 : std::round(x - focal_times_baseline / double(z));
            if (!(moved >= 0)) continue;
            float& there = right.at(int(moved), y);
            if (!(there <= z)) there = z;
        }
    return right;
}

Image<float> read_carla_depth(const std::string& path, DepthInput encoding) {
    const Image<Rgba8> stored = read_rgba8(path);
    if (encoding == DepthInput::carla) {
        const bool grey = std::ranges::all_of(stored.pixels, [](const Rgba8& p) { return p.r == p.g && p.g == p.b; });
        encoding = grey ? DepthInput::carla_log : DepthInput::carla24;
    }
    Image<float> z(stored.width, stored.height);
    for (size_t i = 0; i < z.pixels.size(); ++i)
        z.pixels[i] =
            encoding == DepthInput::carla24 ? decode_carla24(stored.pixels[i]) : decode_carla_log(stored.pixels[i].r);
    return z;
}

Image<float> read_metres(const std::string& path) {
    if (path.ends_with(".npy")) return read_npy(path);
    ExrReader exr(path);
    Image<float> z(exr.width(), exr.height());
    const ExrRequest request{find_layer(exr.channels(), "depth", path).channels.at(0), z.pixels.data()};
    exr.read_rows(0, z.height, {&request, 1});
    return z;
}

/// For each pixel the offset to a known one, passed on from neighbour to neighbour in two sweeps.
/// Source: Danielsson 1980, "Euclidean Distance Mapping", 8SED.
class NearestKnown {
public:
    NearestKnown(const Image<float>& z) : width_(z.width), height_(z.height), offsets_(z.pixels.size()) {
        for (size_t i = 0; i < offsets_.size(); ++i) offsets_[i] = std::isnan(z.pixels[i]) ? far : Offset{0, 0};
        for (int y = 0; y < height_; ++y) {
            for (int x = 0; x < width_; ++x)
                for (const Offset step : {Offset{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) ask(x, y, step);
            for (int x = width_ - 1; x >= 0; --x) ask(x, y, {1, 0});
        }
        for (int y = height_ - 1; y >= 0; --y) {
            for (int x = width_ - 1; x >= 0; --x)
                for (const Offset step : {Offset{1, 0}, {1, 1}, {0, 1}, {-1, 1}}) ask(x, y, step);
            for (int x = 0; x < width_; ++x) ask(x, y, {-1, 0});
        }
    }

    float depth(const Image<float>& z, int x, int y) const {
        const Offset o = offsets_[index(x, y)];
        return z.at(x + o.x, y + o.y);
    }

private:
    struct Offset {
        int x, y;
        int64_t squared() const { return int64_t(x) * x + int64_t(y) * y; }
    };
    static constexpr Offset far = {1 << 20, 1 << 20};
    size_t index(int x, int y) const { return size_t(y) * size_t(width_) + size_t(x); }
    void ask(int x, int y, Offset step) {
        if (x + step.x < 0 || x + step.x >= width_ || y + step.y < 0 || y + step.y >= height_) return;
        Offset there = offsets_[index(x + step.x, y + step.y)];
        if (there.x == far.x) return;
        there = {there.x + step.x, there.y + step.y};
        if (there.squared() < offsets_[index(x, y)].squared()) offsets_[index(x, y)] = there;
    }

    int width_, height_;
    std::vector<Offset> offsets_;
};

/// Unknown pixels that hang together with the top edge become sky.
int64_t open_to_top(Image<float>& z) {
    std::vector<std::pair<int, int>> open;
    int64_t count = 0;
    const auto visit = [&](int x, int y) {
        if (x < 0 || x >= z.width || y < 0 || y >= z.height || !std::isnan(z.at(x, y))) return;
        z.at(x, y) = infinity;
        ++count;
        open.emplace_back(x, y);
    };
    for (int x = 0; x < z.width; ++x) visit(x, 0);
    while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        visit(x - 1, y), visit(x + 1, y), visit(x, y - 1), visit(x, y + 1);
    }
    return count;
}

}  // namespace

const std::vector<std::string>& depth_input_names() {
    static const std::vector<std::string> names = {"kitti16", "mm16",   "carla24",   "carla-log",
                                                   "carla",   "metres", "disparity", "lidar"};
    return names;
}

DepthInput depth_input_from_name(const std::string& name, const std::string& where) {
    // Without the last, lidar.
    const std::span<const std::string> names(depth_input_names().data(), depth_input_names().size() - 1);
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
        throw usage_error(where, fmt::format("unknown depth encoding (got \"{}\", expected one of {})", name,
                                             fmt::join(names, ", ")));
    return DepthInput(found - names.begin());
}

Image<float> read_depth(const std::string& path, const DepthFormat& format) {
    Image<float> z;
    switch (format.encoding) {
        case DepthInput::metres:
            z = read_metres(path);
            break;
        case DepthInput::lidar:
            return read_lidar_depth(path, *format.lidar);
        case DepthInput::carla24:
        case DepthInput::carla_log:
        case DepthInput::carla:
            z = read_carla_depth(path, format.encoding);
            break;
        default:
            z = read_grey_depth(path, format);
    }
    for (float& metres : z.pixels)
        if (!(metres > 0)) metres = unknown;
    return format.seen_from_right ? from_right(z, format.focal_times_baseline) : z;
}

DepthFilling fill_depth(Image<float>& z, const std::string& where) {
    DepthFilling filling;
    const auto unknown_count = std::ranges::count_if(z.pixels, [](float m) { return std::isnan(m); });
    if (size_t(unknown_count) == z.pixels.size()) throw input_error(where, "has no depth in any pixel");
    if (unknown_count > 0 && size_t(unknown_count) * 2 < z.pixels.size()) filling.assumed_sky = open_to_top(z);
    if (unknown_count > filling.assumed_sky) {
        const NearestKnown nearest(z);
        for (int y = 0; y < z.height; ++y)
            for (int x = 0; x < z.width; ++x)
                if (std::isnan(z.at(x, y))) {
                    // What is read is known itself: filled pixels are never asked.
                    z.at(x, y) = nearest.depth(z, x, y);
                    ++filling.filled;
                }
    }
    filling.sky = std::ranges::count(z.pixels, infinity);
    return filling;
}

}  // namespace pluvia
