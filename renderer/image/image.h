// A picture in memory: rows from top to bottom, pixels from left to right.
// Files are read and written by image_io.h and exr.h; what display values mean is in color.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pluvia {

template <class T>
struct Image {
    int width = 0, height = 0;
    std::vector<T> pixels;  // row-major, width * height

    Image() = default;
    Image(int width_, int height_, T fill = {})
        : width(width_), height(height_), pixels(std::size_t(width_) * std::size_t(height_), fill) {}

    /// Pixel in column x of row y, both from 0 and inside the picture.
    T& at(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    const T& at(int x, int y) const { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

/// Four bytes as stored in a file: display-coded colour or packed data; alpha is not premultiplied, 255 = opaque.
struct Rgba8 {
    uint8_t r = 0, g = 0, b = 0, a = 255;

    friend constexpr bool operator==(Rgba8, Rgba8) = default;
};

}  // namespace pluvia
