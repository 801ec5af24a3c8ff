// PNG pictures, read by libpng itself: OpenImageIO 2.4 leaves it to libpng to tell what is wrong, which it does on
// stderr, and loses memory with each damaged picture. PNGs are written, and read at 16 bits, by image_io.h.
#pragma once

#include "renderer/image/image.h"

#include <cstddef>
#include <span>
#include <string>

namespace pluvia {

struct PngSize {
    int width, height;
};
/// What the header claims, before memory is asked for. Throws Error (input) when it is damaged or has no pixels.
PngSize read_png_size(std::span<const std::byte> bytes, const std::string& where);

/// Grey becomes colour, palettes are looked up, 16 bits are rounded to the nearest of 8; what has no alpha is opaque.
/// Values are as stored, whatever gamma or profile the file states (glTF 2.0, section 3.8.3). Throws Error (input) when
/// the picture is damaged or cut short, also where only a checksum tells.
Image<Rgba8> decode_png(std::span<const std::byte> bytes, const std::string& where);

}  // namespace pluvia
