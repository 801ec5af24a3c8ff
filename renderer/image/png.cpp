#include "renderer/image/png.h"

#include "renderer/core/error.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cstring>
#include <limits>

namespace pluvia {
namespace {

/// A picture while libpng reads it.
struct Reading {
    std::span<const std::byte> left;
    char message[160] = "";
    png_structp png = nullptr;
    png_infop info = nullptr;

    explicit Reading(std::span<const std::byte> bytes) : left(bytes) {}
    Reading(const Reading&) = delete;
    ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void keep_error(png_structp png, png_const_charp message) {
    auto& reading = *static_cast<Reading*>(png_get_error_ptr(png));
    std::strncpy(reading.message, message, sizeof reading.message - 1);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep out, size_t count) {
    auto& left = static_cast<Reading*>(png_get_io_ptr(png))->left;
    if (count > left.size()) png_error(png, "it ends too early");
    std::memcpy(out, left.data(), count);
    left = left.subspan(count);
}

/// False where libpng finds a fault. An error jumps out of libpng to here, so nothing in this function has a
/// destructor.
bool read_pixels(Reading& reading, Image<Rgba8>& image) {
    reading.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, keep_error, ignore_warning);
    if (!reading.png) return false;
    reading.info = png_create_info_struct(reading.png);
    if (!reading.info || setjmp(png_jmpbuf(reading.png))) return false;
    png_set_read_fn(reading.png, &reading, read_bytes);
    png_read_info(reading.png, reading.info);
    png_set_expand(reading.png);
    png_set_scale_16(reading.png);
    png_set_gray_to_rgb(reading.png);
    png_set_add_alpha(reading.png, 255, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(reading.png);
    png_read_update_info(reading.png, reading.info);
    static_assert(sizeof(Rgba8) == 4);
    if (png_get_rowbytes(reading.png, reading.info) != size_t(image.width) * 4 ||
        png_get_image_height(reading.png, reading.info) != unsigned(image.height))
        png_error(reading.png, "its rows have another length than its header says");
    for (int pass = 0; pass < passes; ++pass)
        for (int y = 0; y < image.height; ++y)
            png_read_row(reading.png, reinterpret_cast<png_bytep>(&image.at(0, y)), nullptr);
    png_read_end(reading.png, nullptr);  // compares the last checksum
    return true;
}

}  // namespace

PngSize read_png_size(std::span<const std::byte> bytes, const std::string& where) {
    // Signature, length and name of the first chunk; then its first two numbers, high byte first.
    constexpr size_t name = 12, numbers = 16;
    if (bytes.size() < numbers + 8 || std::memcmp(bytes.data() + name, "IHDR", 4) != 0)
        throw input_error(where,
                          fmt::format("is truncated or damaged (got {} bytes, expected a PNG's header)", bytes.size()));
    const auto number = [&](size_t place) {
        uint32_t value = 0;
        for (size_t k = 0; k < 4; ++k) value = value << 8 | std::to_integer<uint32_t>(bytes[place + k]);
        return value;
    };
    const uint32_t width = number(numbers), height = number(numbers + 4);
    constexpr uint32_t largest = std::numeric_limits<int>::max();
    if (width < 1 || height < 1 || width > largest || height > largest)
        throw input_error(where, fmt::format("has no pixels (got {} x {}, expected 1 x 1 or more)", width, height));
    return {int(width), int(height)};
}

Image<Rgba8> decode_png(std::span<const std::byte> bytes, const std::string& where) {
    const PngSize size = read_png_size(bytes, where);
    Image<Rgba8> image(size.width, size.height);
    Reading reading(bytes);
    if (!read_pixels(reading, image))
        throw input_error(where, fmt::format("is truncated or damaged (PNG: {})", reading.message));
    return image;
}

}  // namespace pluvia
