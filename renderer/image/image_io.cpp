#include "renderer/image/image_io.h"

#include "renderer/core/error.h"
#include "renderer/image/color.h"
#include "renderer/image/exr.h"
#include "renderer/image/pending_file.h"
#include "renderer/image/png.h"
#include "renderer/image/webp.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace pluvia {
namespace {

using namespace std::string_view_literals;

constexpr int max_side = 32768;
constexpr uint64_t max_decoded_bytes = uint64_t(4) << 30;

struct Format {
    std::string_view magic;
    const char* name;  // OpenImageIO's
};
// By content, not by name: a picture inside a glTF has none. OpenImageIO's EXR reader is left out because it changes
// the number of threads under open files of exr.h.
constexpr Format formats[] = {
    {"\x89PNG"sv, "png"}, {"\xff\xd8\xff"sv, "jpeg"},
    {"RIFF"sv, "webp"},   {"#?"sv, "hdr"},
    {"II*\0"sv, "tiff"},  {"MM\0*"sv, "tiff"},
    {"DDS "sv, "dds"},    {"BM"sv, "bmp"},
    {"PF"sv, "pnm"},      {"Pf"sv, "pnm"},
    {"P5"sv, "pnm"},      {"P6"sv, "pnm"},
};

const char* format_name(std::span<const std::byte> bytes, const std::string& where) {
    const std::string_view start(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const Format& format : formats)
        if (start.starts_with(format.magic)) return format.name;
    if (start.starts_with("\x76\x2f\x31\x01"sv)) throw input_error(where, "is an EXR file (expected PNG, JPEG, ...)");
    throw input_error(where, "is in no known format (expected PNG, JPEG, WebP, TIFF, BMP, DDS, HDR or PNM)");
}

std::vector<std::byte> read_file(const std::string& path) {
    std::error_code ignored;  // what cannot be looked at cannot be opened below either
    if (std::filesystem::is_directory(path, ignored)) throw input_error(path, "is a folder (expected a picture)");
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) throw input_error(path, std::string("cannot be opened (") + std::strerror(errno) + ")");
    std::vector<std::byte> bytes(std::size_t(std::max<std::streamoff>(0, file.tellg())));
    file.seekg(0);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size())))
        throw input_error(path, "cannot be read");
    return bytes;
}

/// Before memory is asked for: a damaged header can claim any size.
void check_size(const std::string& where, int width, int height, uint64_t bytes_per_pixel) {
    const uint64_t decoded_bytes = uint64_t(width) * uint64_t(height) * bytes_per_pixel;
    if (width > max_side || height > max_side || decoded_bytes > max_decoded_bytes)
        throw input_error(where, "is too large (got " + std::to_string(width) + " x " + std::to_string(height) +
                                     " pixels of " + std::to_string(bytes_per_pixel) +
                                     " bytes, expected up to 32768 x 32768 pixels and 4 GiB)");
}

/// A header of some bytes must not cost a gigabyte. No picture of these formats that shows anything is packed denser:
/// deflate stores 1032 bytes in one, of which a byte of a palette may be 8 pixels.
void check_density(std::size_t encoded, int width, int height, const std::string& where) {
    constexpr uint64_t free_pixels = uint64_t(1) << 24, pixels_per_byte = 1032 * 8;
    if (uint64_t(width) * uint64_t(height) > free_pixels + pixels_per_byte * encoded)
        throw input_error(where, "cannot hold what it claims (got " + std::to_string(width) + " x " +
                                     std::to_string(height) + " pixels in " + std::to_string(encoded) + " bytes)");
}

/// The library puts one message after another, a line each.
std::string one_line(std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    return message;
}

/// A picture in memory, open and of an acceptable size.
struct Source {
    std::string where;
    OIIO::Filesystem::IOMemReader memory;
    std::unique_ptr<OIIO::ImageInput> input;

    Source(std::span<const std::byte> bytes, const std::string& where_)
        : where(where_), memory(const_cast<std::byte*>(bytes.data()), bytes.size()) {
        const char* name = format_name(bytes, where);
        input = OIIO::ImageInput::create(name, false, nullptr, nullptr, "");
        OIIO::ImageSpec ignored, settings;
        settings["oiio:UnassociatedAlpha"] = 1;  // otherwise colour is multiplied by alpha and rounded
        if (!input || !input->set_ioproxy(&memory) || !input->open(std::string("memory.") + name, ignored, settings))
            throw input_error(where, "cannot be read (" + one_line(input ? input->geterror() : OIIO::geterror()) + ")");
        if (spec().width < 1 || spec().height < 1 || spec().depth != 1)
            throw input_error(where, "is not a flat picture with pixels");
        check_size(where, spec().width, spec().height, 1);
        // The library's reader multiplies such colour by alpha whatever it is asked, and rounds it; see webp.h.
        if (name == "webp"sv && spec().nchannels == 4)
            throw input_error(where, "is a WebP picture with alpha, which is not supported here (expected PNG)");
    }

    const OIIO::ImageSpec& spec() const { return input->spec(); }

    /// The first count channels of all pixels, converted to the type of T.
    template <class T>
    std::vector<T> read(int count) {
        check_size(where, spec().width, spec().height, uint64_t(count) * sizeof(T));
        std::vector<T> values(std::size_t(spec().width) * std::size_t(spec().height) * std::size_t(count));
        // A truncated JPEG counts as read, with a warning and grey where data is missing.
        if (!input->read_image(0, 0, 0, count, OIIO::BaseTypeFromC<T>::value, values.data()) || input->has_error())
            throw input_error(where, "is truncated or damaged (" + one_line(input->geterror()) + ")");
        return values;
    }
};

bool is_float(const OIIO::ImageSpec& spec) {
    return spec.format.is_floating_point();
}

Image<Rgb> read_radiance_exr(const std::string& path) {
    ExrReader reader(path);
    std::vector<std::string> names = {"R", "G", "B"};
    if (!std::ranges::all_of(names, [&](const std::string& name) { return reader.has_channel(name); })) {
        if (reader.channels().size() != 1)
            throw input_error(path, "has no channels R, G and B (got " + std::to_string(reader.channels().size()) +
                                        " others, expected these or a single one)");
        names = {reader.channels()[0].name};
    }
    check_size(path, reader.width(), reader.height(), sizeof(Rgb));
    Image<Rgb> image(reader.width(), reader.height());
    constexpr int band = 64;
    const std::size_t plane_size = std::size_t(image.width) * band;
    std::vector<float> planes(plane_size * names.size());
    std::vector<ExrRequest> requests;
    for (const std::string& name : names) requests.push_back({name, &planes[plane_size * requests.size()]});
    for (int y = 0; y < image.height; y += band) {
        const int count = std::min(band, image.height - y);
        reader.read_rows(y, count, requests);
        for (std::size_t i = 0; i < std::size_t(image.width) * std::size_t(count); ++i) {
            const float* v = &planes[i];
            image.pixels[std::size_t(y) * std::size_t(image.width) + i] =
                names.size() == 3 ? Rgb(v[0], v[plane_size], v[2 * plane_size]) : Rgb(v[0]);
        }
    }
    return image;
}

/// Values as stored, integers divided by their largest.
Image<Rgb> read_rgb(Source& source) {
    const int count = source.spec().nchannels < 3 ? 1 : 3;
    const std::vector<float> values = source.read<float>(count);
    Image<Rgb> image(source.spec().width, source.spec().height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float* v = &values[i * std::size_t(count)];
        image.pixels[i] = count == 3 ? Rgb(v[0], v[1], v[2]) : Rgb(v[0]);
    }
    return image;
}

Image<Rgb> read_radiance_other(const std::string& path) {
    const std::vector<std::byte> bytes = read_file(path);
    Source source(bytes, path);
    Image<Rgb> image = read_rgb(source);
    if (!is_float(source.spec()))
        for (Rgb& p : image.pixels) p = {linear_from_srgb(p.r), linear_from_srgb(p.g), linear_from_srgb(p.b)};
    return image;
}

}  // namespace

ImageInfo read_image_info(const std::string& path) {
    const std::vector<std::byte> bytes = read_file(path);
    const Source source(bytes, path);
    const OIIO::ImageSpec& spec = source.spec();
    return {spec.width, spec.height, spec.nchannels, int(spec.format.size()) * 8, is_float(spec)};
}

Image<Rgba8> decode_rgba8(std::span<const std::byte> bytes, const std::string& where) {
    const std::string_view format = format_name(bytes, where);
    if (format == "webp") {
        const WebpSize size = read_webp_size(bytes, where);
        check_size(where, size.width, size.height, sizeof(Rgba8));
        return decode_webp(bytes, where);
    }
    if (format == "png") {
        const PngSize size = read_png_size(bytes, where);
        check_size(where, size.width, size.height, sizeof(Rgba8));
        check_density(bytes.size(), size.width, size.height, where);
        return decode_png(bytes, where);
    }
    Source source(bytes, where);
    check_density(bytes.size(), source.spec().width, source.spec().height, where);
    const int count = std::min(4, source.spec().nchannels);
    const std::vector<uint8_t> values = source.read<uint8_t>(count);
    Image<Rgba8> image(source.spec().width, source.spec().height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const uint8_t* v = &values[i * std::size_t(count)];
        image.pixels[i] = count < 3 ? Rgba8{v[0], v[0], v[0], count == 2 ? v[1] : uint8_t(255)}
                                    : Rgba8{v[0], v[1], v[2], count == 4 ? v[3] : uint8_t(255)};
    }
    return image;
}

Image<Rgba8> read_rgba8(const std::string& path) {
    return decode_rgba8(read_file(path), path);
}

Image<uint16_t> read_grey16(const std::string& path) {
    const std::vector<std::byte> bytes = read_file(path);
    Source source(bytes, path);
    if (is_float(source.spec())) throw input_error(path, "holds float values (expected integers of 8 or 16 bits)");
    Image<uint16_t> image;
    image.width = source.spec().width;
    image.height = source.spec().height;
    image.pixels = source.read<uint16_t>(1);
    return image;
}

Image<Rgb> read_display(const std::string& path) {
    const std::vector<std::byte> bytes = read_file(path);
    Source source(bytes, path);
    if (is_float(source.spec())) throw input_error(path, "holds float values (expected integers of 8 or 16 bits)");
    return read_rgb(source);
}

Image<Rgb> read_radiance(const std::string& path) {
    Image<Rgb> image = is_exr(path) ? read_radiance_exr(path) : read_radiance_other(path);
    std::size_t bad = 0;
    for (Rgb& p : image.pixels) {
        bad += !is_finite(p);
        p = {std::max(0.0f, p.r), std::max(0.0f, p.g), std::max(0.0f, p.b)};
    }
    if (bad > 0)
        throw input_error(path, "holds light that is not finite (got " + std::to_string(bad) + " such pixels of " +
                                    std::to_string(image.pixels.size()) + ")");
    return image;
}

// ---- writing

namespace {

OIIO::ImageSpec png_spec(int width, int height, int channels, int bits) {
    OIIO::ImageSpec spec(width, height, channels, bits == 16 ? OIIO::TypeUInt16 : OIIO::TypeUInt8);
    spec["oiio:UnassociatedAlpha"] = 1;
    // Measured on a noisy picture of 2048 x 1024: level 2 takes 0.14 s, the library's 6 takes 0.34 s and saves 3 %.
    spec["png:compressionLevel"] = 2;
    // Each row as its difference from the one above: a quarter less time than a search among all filters, and no
    // larger.
    spec["png:filter"] = 32;
    return spec;
}

/// The library's own file ignores what a full disk did not take.
class Stream : public OIIO::Filesystem::IOProxy {
public:
    explicit Stream(std::ofstream& file) : IOProxy("PNG", Write), file_(file) {}

    const char* proxytype() const override { return "stream"; }
    std::size_t write(const void* bytes, std::size_t size) override {
        return file_.write(static_cast<const char*>(bytes), std::streamsize(size)) ? size : 0;
    }

private:
    std::ofstream& file_;
};

std::vector<std::byte> encode(const char* format, const OIIO::ImageSpec& spec, const Image<Rgba8>& image) {
    const std::string where = std::string("a ") + format + " picture in memory";
    // The library's JPEG writer ends the program when it cannot begin.
    if (image.pixels.empty()) throw Error(ExitCode::render_failed, where, "cannot be written (it has no pixels)");
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create(format);
    if (!output->set_ioproxy(&memory) || !output->open(std::string("memory.") + format, spec) ||
        !output->write_image(OIIO::TypeUInt8, image.pixels.data(), sizeof(Rgba8)) || !output->close())
        throw Error(ExitCode::render_failed, where, "cannot be written (" + output->geterror() + ")");
    const auto encoded = std::as_bytes(std::span(bytes));
    return {encoded.begin(), encoded.end()};
}

}  // namespace

std::vector<std::byte> encode_png(const Image<Rgba8>& image) {
    return encode("png", png_spec(image.width, image.height, 4, 8), image);
}

std::vector<std::byte> encode_jpeg(const Image<Rgba8>& image, int quality) {
    OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeUInt8);
    spec["Compression"] = "jpeg:" + std::to_string(quality);
    spec["jpeg:subsampling"] = "4:4:4";
    return encode("jpeg", spec, image);
}

struct PngWriter::State {
    PendingFile pending;
    Stream stream;
    std::unique_ptr<OIIO::ImageOutput> output;
    int bits, next_row = 0;

    State(const std::string& path, int bits_)
        : pending(path), stream(pending.stream()), output(OIIO::ImageOutput::create("png")), bits(bits_) {}

    template <class T>
    void write_rows(int y, int count, const T* values) {
        const int height = output->spec().height;
        if (bits != int(sizeof(T)) * 8 || y != next_row || count < 1 || count > height - y)
            throw pending.write_error("got " + std::to_string(count) + " rows of " + std::to_string(sizeof(T) * 8) +
                                      " bits at row " + std::to_string(y) + ", expected " + std::to_string(bits) +
                                      " bits at row " + std::to_string(next_row) + " of " + std::to_string(height));
        if (!output->write_scanlines(y, y + count, 0, OIIO::BaseTypeFromC<T>::value, values))
            throw pending.write_error(output->geterror());
        next_row += count;
    }
};

PngWriter::PngWriter(const std::string& path, int width, int height, int channels, int bits, const PngText& text)
    : state_(std::make_unique<State>(path, bits)) {
    OIIO::ImageSpec spec = png_spec(width, height, channels, bits);
    for (const auto& [key, value] : text) spec.attribute(key, value);
    if (!state_->output->set_ioproxy(&state_->stream) || !state_->output->open("stream.png", spec))
        throw state_->pending.write_error(state_->output->geterror());
}

PngWriter::~PngWriter() = default;

void PngWriter::write_rows(int y, int count, const uint8_t* values) {
    state_->write_rows(y, count, values);
}
void PngWriter::write_rows(int y, int count, const uint16_t* values) {
    state_->write_rows(y, count, values);
}

void PngWriter::finish() {
    State& s = *state_;
    if (s.next_row != s.output->spec().height)
        throw s.pending.write_error("got " + std::to_string(s.next_row) + " rows, expected " +
                                    std::to_string(s.output->spec().height));
    if (!s.output->close()) throw s.pending.write_error(s.output->geterror());
    s.pending.commit();
}

}  // namespace pluvia
