// Small pictures of a street with depth, as files.
#pragma once

#include "renderer/image/depth_encoding.h"
#include "renderer/image/image_io.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pluvia {

inline void write_rgb(const std::string& path, int width, int height, const std::function<Rgba8(int, int)>& pixel) {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    std::vector<uint8_t> bytes;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Rgba8 p = pixel(x, y);
            bytes.insert(bytes.end(), {p.r, p.g, p.b});
        }
    PngWriter writer(path, width, height, 3, 8);
    writer.write_rows(0, height, bytes.data());
    writer.finish();
}

inline void write_grey16(const std::string& path, int width, int height,
                         const std::function<uint16_t(int, int)>& value) {
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    std::vector<uint16_t> words;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) words.push_back(value(x, y));
    PngWriter writer(path, width, height, 1, 16);
    writer.write_rows(0, height, words.data());
    writer.finish();
}

/// A small street of 64 x 32 pixels under a sky of 12 rows, and its depth as KITTI stores it.
inline Rgba8 street(int x, int y) {
    return {uint8_t(60 + x), uint8_t(80 + 2 * y), 120, 255};
}
inline uint16_t street_depth(int, int y) {
    return y < 12 ? 0 : uint16_t(256 * 40 / (y - 10));
}

}  // namespace pluvia
