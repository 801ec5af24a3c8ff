// WebP pictures, read by libwebp itself: OpenImageIO multiplies colour by alpha, whatever it is asked, and rounds it.
// Everything else that is a picture is read by image_io.h.
#pragma once

#include "renderer/image/image.h"

#include <cstddef>
#include <span>
#include <string>

namespace pluvia {

struct WebpSize {
    int width, height;
};
/// Before memory is asked for. Throws Error (input) when the header is damaged or the picture moves.
WebpSize read_webp_size(std::span<const std::byte> bytes, const std::string& where);

/// Throws Error (input) when the picture is damaged.
Image<Rgba8> decode_webp(std::span<const std::byte> bytes, const std::string& where);

}  // namespace pluvia
