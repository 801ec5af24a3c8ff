// Pictures in common formats (PNG, JPEG, HDR, ...) in and out, and PNG files written row by row; the OpenImageIO door.
// Layers of a frame are in exr.h; what the bytes mean as colour is in color.h.
#pragma once

#include "renderer/core/rgb.h"
#include "renderer/image/image.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pluvia {

// All readers recognise PNG, JPEG, WebP, TIFF, BMP, DDS, HDR and PNM by content, and throw Error (input) with the file
// and the reason: missing, unknown format, truncated, larger than 32768 x 32768 pixels or 4 GiB when decoded.

struct ImageInfo {
    int width = 0, height = 0, channels = 0;
    int bits = 0;           // per channel, as stored
    bool is_float = false;  // half or float: linear values; otherwise integers
};
/// What a file holds, as its header says.
ImageInfo read_image_info(const std::string& path);

/// Bytes as stored, without colour conversion; alpha as stored, not premultiplied by the reader. Grey is repeated into
/// r, g and b, missing alpha is 255, 16 bits are rounded to 8; float values are clipped to 0..1 first.
Image<Rgba8> read_rgba8(const std::string& path);
/// The same from the bytes of a file. where: what messages call it (file and node, for example).
Image<Rgba8> decode_rgba8(std::span<const std::byte> bytes, const std::string& where);

/// First channel of an integer picture as stored in 16 bits; 8 bits are multiplied by 257, so that value / 65535 keeps
/// its meaning. Ask read_image_info where the difference matters. Throws for float pictures too.
Image<uint16_t> read_grey16(const std::string& path);

/// Integer picture as stored: value / 255 or / 65535, no colour conversion, no alpha. Grey is repeated.
/// Throws for float pictures.
Image<Rgb> read_display(const std::string& path);

/// Scene-linear Rec.709 picture: float formats (HDR, EXR) as stored, channels R, G and B where they are named, else
/// the first three, or a single one as grey; integer formats through the sRGB curve (color.h).
/// Values below zero (ringing of a filter) become 0; throws when a value is not finite.
Image<Rgb> read_radiance(const std::string& path);

/// A PNG file's bytes, 8 bits with alpha. Throws Error (render_failed) when the picture is empty.
std::vector<std::byte> encode_png(const Image<Rgba8>& image);

/// A JPEG file's bytes: quality 1 to 100, colour at full resolution, alpha dropped. The same pixels give the same
/// bytes. Throws Error (render_failed) when the picture is empty.
std::vector<std::byte> encode_jpeg(const Image<Rgba8>& image, int quality);

/// Keyword and text, Latin-1, stored as tEXt chunks.
using PngText = std::map<std::string, std::string>;

/// A PNG file of integers, written row by row under a temporary name. The same rows and text give the same bytes.
/// Throws Error (render_failed) when the file cannot be written.
class PngWriter {
public:
    /// channels: 1 (grey), 3 (RGB) or 4 (RGB and alpha, not premultiplied); bits: 8 or 16.
    PngWriter(const std::string& path, int width, int height, int channels, int bits, const PngText& text = {});
    /// Removes the temporary file when finish() was not reached.
    ~PngWriter();

    /// Rows y to y + count - 1, interleaved channels; y continues where the last call ended. The pointer's type must
    /// agree with bits.
    void write_rows(int y, int count, const uint8_t* values);
    void write_rows(int y, int count, const uint16_t* values);

    /// Gives the file its final name once all rows are written.
    void finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pluvia
