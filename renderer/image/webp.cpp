#include "renderer/image/webp.h"

#include "renderer/core/error.h"

#include <webp/decode.h>

namespace pluvia {
namespace {

const uint8_t* data(std::span<const std::byte> bytes) {
    return reinterpret_cast<const uint8_t*>(bytes.data());
}

}  // namespace

WebpSize read_webp_size(std::span<const std::byte> bytes, const std::string& where) {
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(data(bytes), bytes.size(), &features) != VP8_STATUS_OK || features.width < 1 ||
        features.height < 1)
        throw input_error(where, "is truncated or damaged (expected a WebP picture)");
    if (features.has_animation) throw input_error(where, "is an animation (expected a WebP picture)");
    return {features.width, features.height};
}

Image<Rgba8> decode_webp(std::span<const std::byte> bytes, const std::string& where) {
    const WebpSize size = read_webp_size(bytes, where);
    Image<Rgba8> image(size.width, size.height);
    static_assert(sizeof(Rgba8) == 4);
    auto* pixels = reinterpret_cast<uint8_t*>(image.pixels.data());
    if (!WebPDecodeRGBAInto(data(bytes), bytes.size(), pixels, image.pixels.size() * 4, size.width * 4))
        throw input_error(where, "is truncated or damaged (expected a WebP picture)");
    return image;
}

}  // namespace pluvia
