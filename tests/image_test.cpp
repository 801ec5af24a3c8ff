// Pictures in common formats: what is written comes back, what is damaged is refused.
// Layers of a frame are in exr_test.cpp.
#include "renderer/core/error.h"
#include "renderer/core/random.h"
#include "renderer/image/color.h"
#include "renderer/image/exr.h"
#include "renderer/image/image_io.h"
#include "tests/error_of.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string_view>

#include <sys/resource.h>
#include <unistd.h>

using namespace pluvia;

namespace {

/// A folder that goes with the test.
struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("pluvia_image_test_" + std::to_string(getpid()));

    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
    std::string operator/(const std::string& name) const { return (path / name).string(); }
    bool is_empty() const { return std::filesystem::is_empty(path); }
};

std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}
void write_text(const std::string& path, std::string_view text) {
    std::ofstream(path, std::ios::binary).write(text.data(), std::streamsize(text.size()));
}
std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

bool names(const Error& error, const std::string& path) {
    return std::string(error.what()).starts_with(path + ": ");
}

template <class T>
void write_png(const std::string& path, int width, int height, int channels, const T* values) {
    PngWriter writer(path, width, height, channels, int(sizeof(T)) * 8);
    writer.write_rows(0, height, values);
    writer.finish();
}

Image<Rgba8> patterned(int width, int height) {
    Image<Rgba8> image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.at(x, y) = {uint8_t(x * 7 + y), uint8_t(y * 5), uint8_t(x ^ y), uint8_t(x * y)};
    return image;
}

/// A baseline JPEG of 16 x 16 grey pixels of value 128: four blocks that say nothing but "end of block".
std::string grey_jpeg() {
    const auto segment = [](char marker, std::string body) {
        return std::string("\xff") + marker + '\0' + char(body.size() + 2) + body;
    };
    const std::string one_code = std::string(1, '\1') + std::string(15, '\0') + '\0';  // one bit means symbol 0
    return "\xff\xd8" + segment('\xdb', std::string(1, '\0') + std::string(64, '\1')) +
           segment('\xc0', {'\x08', 0, 16, 0, 16, 1, 1, '\x11', 0}) + segment('\xc4', '\0' + one_code) +
           segment('\xc4', '\x10' + one_code) + segment('\xda', {1, 1, 0, 0, 63, 0}) + '\0' + "\xff\xd9";
}

}  // namespace

TEST_CASE("a JPEG keeps colours, also where they change from pixel to pixel") {
    Image<Rgba8> image(32, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x) image.at(x, y) = {uint8_t(x % 2 ? 200 : 60), uint8_t(8 * x), uint8_t(16 * y)};
    const Image<Rgba8> back = decode_rgba8(encode_jpeg(image, 98), "memory");
    REQUIRE(back.width == 32);
    REQUIRE(back.height == 16);
    int largest = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const Rgba8 a = image.pixels[i], b = back.pixels[i];
        largest = std::max({largest, std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
    }
    CHECK(largest <= 8);  // red halved in resolution would be off by 70
    CHECK(encode_jpeg(image, 98) == encode_jpeg(image, 98));
    CHECK_THROWS_AS(encode_jpeg(Image<Rgba8>(), 98), Error);
}

TEST_CASE("a PNG in memory gives back every byte, also under zero alpha") {
    const Image<Rgba8> image = patterned(61, 33);
    const Image<Rgba8> back = decode_rgba8(encode_png(image), "memory");
    CHECK(back.width == 61);
    CHECK(back.height == 33);
    CHECK(back.pixels == image.pixels);
}

TEST_CASE("a PNG of 16 bits gives back every value") {
    const Folder folder;
    Image<uint16_t> image(257, 256);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = uint16_t(i * 40503);
    PngWriter writer(folder / "depth.png", 257, 256, 1, 16);
    writer.write_rows(0, 100, image.pixels.data());
    writer.write_rows(100, 156, &image.at(0, 100));
    writer.finish();
    CHECK(read_grey16(folder / "depth.png").pixels == image.pixels);
    const ImageInfo info = read_image_info(folder / "depth.png");
    CHECK(info.width == 257);
    CHECK(info.height == 256);
    CHECK(info.channels == 1);
    CHECK(info.bits == 16);
    CHECK_FALSE(info.is_float);
}

TEST_CASE("grey of 8 bits read as 16 keeps its fraction of white") {
    const Folder folder;
    const uint8_t values[] = {0, 1, 127, 128, 254, 255};
    write_png(folder / "grey.png", 6, 1, 1, values);
    for (int x = 0; x < 6; ++x) {
        const uint8_t v = values[x];
        CHECK(read_grey16(folder / "grey.png").at(x, 0) == v * 257);
        CHECK(read_rgba8(folder / "grey.png").at(x, 0) == Rgba8{v, v, v, 255});
    }
}

TEST_CASE("colour of 16 bits is rounded to the nearest byte") {
    const Folder folder;
    const uint16_t values[6] = {0, 128, 129, 257 * 100 + 128, 257 * 100 + 129, 65535};
    write_png(folder / "deep.png", 2, 1, 3, values);
    const Image<Rgba8> back = read_rgba8(folder / "deep.png");
    CHECK(back.at(0, 0) == Rgba8{0, 0, 1, 255});
    CHECK(back.at(1, 0) == Rgba8{100, 101, 255, 255});
}

TEST_CASE("a PNG's bytes depend on rows and text alone") {
    const Folder folder;
    const Image<Rgba8> image = patterned(64, 48);
    const auto write = [&](const std::string& name, int band) {
        PngWriter writer(folder / name, 64, 48, 4, 8, {{"Comment", "rain 50"}, {"Seed", "7"}});
        for (int y = 0; y < 48; y += band)
            writer.write_rows(y, std::min(band, 48 - y), reinterpret_cast<const uint8_t*>(&image.at(0, y)));
        writer.finish();
        return read_text(folder / name);
    };
    const std::string bytes = write("one.png", 48);
    CHECK(bytes == write("other.png", 5));
    CHECK(read_rgba8(folder / "one.png").pixels == image.pixels);
    CHECK(bytes.find("rain 50") != std::string::npos);
    CHECK(bytes.find("tIME") == std::string::npos);
    CHECK(bytes.find("gAMA") == std::string::npos);  // depth and masks must not be corrected by a viewer
}

TEST_CASE("a PNG that is not finished leaves nothing behind") {
    const Folder folder;
    const std::vector<uint8_t> row(30);
    {
        PngWriter writer(folder / "x.png", 10, 4, 3, 8);
        writer.write_rows(0, 1, row.data());
        CHECK_FALSE(std::filesystem::exists(folder / "x.png"));
        CHECK_FALSE(folder.is_empty());
        const Error error = error_of([&] { writer.finish(); });
        CHECK(error.code() == ExitCode::render_failed);
        CHECK(names(error, folder / "x.png"));
        CHECK(error_of([&] { writer.write_rows(3, 1, row.data()); }).code() == ExitCode::render_failed);
        const std::vector<uint16_t> deep_row(30);
        CHECK(error_of([&] { writer.write_rows(1, 1, deep_row.data()); }).code() == ExitCode::render_failed);
    }
    CHECK(folder.is_empty());
    const Error error = error_of([&] { PngWriter("/proc/no/such/x.png", 10, 4, 3, 8); });
    CHECK(error.code() == ExitCode::render_failed);
    CHECK(names(error, "/proc/no/such/x.png"));
}

TEST_CASE("a disk that is full does not give a PNG its final name") {
    const Folder folder;
    std::vector<uint8_t> values(256 * 256);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = uint8_t(hash_key(i));
    rlimit before;
    getrlimit(RLIMIT_FSIZE, &before);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);  // the write then fails, as on a full disk
    const rlimit lowered = {30000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &lowered);
    const Error error = error_of([&] { write_png(folder / "x.png", 256, 256, 1, values.data()); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old_handler);
    CHECK(error.code() == ExitCode::render_failed);
    CHECK(folder.is_empty());
}

TEST_CASE("a PNG that lacks data is refused wherever it was cut") {
    const std::vector<std::byte> bytes = encode_png(patterned(40, 30));
    const Image<Rgba8> whole = decode_rgba8(bytes, "whole");
    const std::size_t end_chunk = 12;  // IEND carries no pixels: without it the picture is still whole
    for (std::size_t size = 0; size < bytes.size() - end_chunk; size += 1 + size / 8) {
        CAPTURE(size);
        const Error error = error_of([&] { decode_rgba8(std::span(bytes).first(size), "street.glb: image 3"); });
        CHECK(error.code() == ExitCode::input);
        CHECK(names(error, "street.glb: image 3"));
    }
}

TEST_CASE("a JPEG that lacks data is refused although its decoder would fill it with grey") {
    const std::string bytes = grey_jpeg();
    const Image<Rgba8> whole = decode_rgba8(bytes_of(bytes), "whole");
    CHECK(whole.width == 16);
    CHECK(whole.at(15, 15) == Rgba8{128, 128, 128, 255});
    for (const std::size_t missing : {2, 3, 10}) {
        CAPTURE(missing);
        const auto cut = bytes_of(bytes).first(bytes.size() - missing);
        CHECK(error_of([&] { decode_rgba8(cut, "cut"); }).code() == ExitCode::input);
    }
}

TEST_CASE("files that are no pictures are refused by name") {
    const Folder folder;
    write_text(folder / "text.png", "this is not a picture");
    write_text(folder / "empty.png", "");
    write_text(folder / "huge.png", "P6\n40000 40000\n255\n");  // formats go by content, not by name
    write_text(folder / "heavy.png", "P6\n32768 32768\n65535\n");
    for (const char* name : {"text.png", "empty.png", "huge.png", "missing.png", "."}) {
        const std::string path = folder / name;
        CAPTURE(path);
        for (const auto& error : {error_of([&] { read_rgba8(path); }), error_of([&] { read_grey16(path); }),
                                  error_of([&] { read_radiance(path); }), error_of([&] { read_image_info(path); })}) {
            CHECK(error.code() == ExitCode::input);
            CHECK(names(error, path));
        }
    }
    const Error too_large = error_of([&] { read_rgba8(folder / "huge.png"); });
    CHECK(std::string(too_large.what()).find("40000") != std::string::npos);
    const Error too_heavy = error_of([&] { read_radiance(folder / "heavy.png"); });  // 12 GiB as floats
    CHECK(std::string(too_heavy.what()).find("4 GiB") != std::string::npos);
}

TEST_CASE("radiance of 8 bits is decoded from sRGB") {
    const Folder folder;
    const uint8_t values[6] = {0, 128, 255, 10, 20, 30};
    write_png(folder / "sky.png", 2, 1, 3, values);
    const Image<Rgb> sky = read_radiance(folder / "sky.png");
    const auto& linear = linear_from_srgb8();
    for (int x = 0; x < 2; ++x) {
        const uint8_t* v = &values[3 * x];
        const Rgb difference = sky.at(x, 0) - Rgb(linear[v[0]], linear[v[1]], linear[v[2]]);
        // 1e-6: byte / 255 is rounded once by either side
        CHECK(std::max({std::abs(difference.r), std::abs(difference.g), std::abs(difference.b)}) < 1e-6f);
    }
}

TEST_CASE("radiance of an HDR file is linear as stored") {
    const Folder folder;
    // RGBE pixels: mantissa / 256 * 2^(exponent - 128); readers may add half a mantissa step.
    write_text(folder / "sky.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 1\n") +
                                       std::string("\x80\x40\x20\x81", 4) + std::string("\xff\x80\x01\x94", 4));
    const Image<Rgb> sky = read_radiance(folder / "sky.hdr");
    REQUIRE(sky.width == 1);
    REQUIRE(sky.height == 2);
    CHECK(sky.at(0, 0).r == doctest::Approx(1).epsilon(0.5 / 128));
    CHECK(sky.at(0, 0).g == doctest::Approx(0.5).epsilon(0.5 / 64));
    CHECK(sky.at(0, 1).r == doctest::Approx(255.0 * 4096).epsilon(0.5 / 255).scale(0));
    CHECK(read_image_info(folder / "sky.hdr").is_float);
}

TEST_CASE("radiance of an EXR file is its R, G and B, or its only channel") {
    const Folder folder;
    const int width = 33, height = 70;  // more rows than a band, and not a multiple
    std::vector<float> values(std::size_t(width * height));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(i) * 1.7f;
    const auto write = [&](const std::string& name, const std::vector<ExrChannel>& channels, float first) {
        values[0] = first;
        ExrWriter writer(folder / name, width, height, channels);
        std::vector<std::vector<float>> planes;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            planes.push_back(values);
            for (float& v : planes.back()) v *= float(c + 1);
        }
        std::vector<ExrRows> rows;
        for (const auto& plane : planes) rows.push_back(plane.data());
        writer.write_rows(0, height, rows);
        writer.finish();
    };
    write("rgb.exr", {{"R"}, {"A"}, {"G"}, {"B"}}, -1);
    const Image<Rgb> rgb = read_radiance(folder / "rgb.exr");
    CHECK(rgb.at(0, 0) == Rgb(0));  // less than no light is ringing
    CHECK(rgb.at(32, 69) == Rgb(values.back(), values.back() * 3, values.back() * 4));
    write("grey.exr", {{"Y"}}, 0);
    CHECK(read_radiance(folder / "grey.exr").at(5, 66) == Rgb(values[66 * 33 + 5]));
    write("layers.exr", {{"background.R"}, {"background.G"}}, 0);
    CHECK(error_of([&] { read_radiance(folder / "layers.exr"); }).code() == ExitCode::input);
    for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        write("bad.exr", {{"R"}, {"G"}, {"B"}}, bad);
        const Error error = error_of([&] { read_radiance(folder / "bad.exr"); });
        CHECK(error.code() == ExitCode::input);
        CHECK(std::string(error.what()).find("1 such pixels") != std::string::npos);
    }
    CHECK(error_of([&] { read_rgba8(folder / "rgb.exr"); }).code() == ExitCode::input);
}
