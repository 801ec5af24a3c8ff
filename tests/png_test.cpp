// Every kind of PNG becomes the same texels, and a damaged one is told of in one place only.
#include "renderer/image/png.h"

#include "renderer/image/image_io.h"
#include "tests/error_of.h"
#include "tests/gltf_draft.h"
#include "tests/run_program.h"

#include <doctest/doctest.h>

#include <string_view>
#include <vector>

using namespace pluvia;
using namespace std::string_literals;

namespace {

std::string big_endian(uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

/// Source: PNG specification, annex D.
uint32_t crc(std::string_view bytes) {
    uint32_t c = 0xffffffff;
    for (const char byte : bytes) {
        c ^= uint8_t(byte);
        for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >> 1) : c >> 1;
    }
    return ~c;
}

std::string chunk(const std::string& name, const std::string& body) {
    return big_endian(uint32_t(body.size())) + name + body + big_endian(crc(name + body));
}

enum Kind { grey = 0, colour = 2, palette = 3, grey_alpha = 4, colour_alpha = 6 };

/// rows: of equal length, without their filter bytes. more: chunks before the pixels. Nothing is compressed (RFC 1950
/// and 1951).
std::string png(int width, const std::vector<std::string>& rows, int bits, Kind kind, const std::string& more = "",
                bool interlaced = false) {
    std::string raw;
    for (const std::string& row : rows) raw += '\0' + row;
    uint32_t a = 1, b = 0;
    for (const char byte : raw) a = (a + uint8_t(byte)) % 65521, b = (b + a) % 65521;
    const auto length = uint16_t(raw.size());
    const std::string stored = "\x78\x01\x01"s + char(length) + char(length >> 8) + char(~length) + char(~length >> 8) +
                               raw + big_endian(b << 16 | a);
    const int height = interlaced ? 1 : int(rows.size());
    const std::string header = big_endian(uint32_t(width)) + big_endian(uint32_t(height)) + char(bits) + char(kind) +
                               "\0\0"s + char(interlaced);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + more + chunk("IDAT", stored) + chunk("IEND", "");
}

std::span<const std::byte> bytes_of(std::string_view text) {
    return std::as_bytes(std::span(text));
}

std::vector<Rgba8> texels(const std::string& file) {
    return decode_rgba8(bytes_of(file), "picture").pixels;
}

}  // namespace

TEST_CASE("a PNG of any kind gives colour and alpha of 8 bits as they are stored") {
    using Texels = std::vector<Rgba8>;
    CHECK(texels(png(3, {"\xa0"}, 1, grey)) == Texels{{255, 255, 255, 255}, {0, 0, 0, 255}, {255, 255, 255, 255}});
    CHECK(texels(png(1, {"\x40", "\xf0"}, 4, grey)) == Texels{{68, 68, 68, 255}, {255, 255, 255, 255}});
    CHECK(texels(png(1, {"\x80\x40"}, 8, grey_alpha)) == Texels{{128, 128, 128, 64}});
    CHECK(texels(png(1, {"\x01\x02\x03"}, 8, colour)) == Texels{{1, 2, 3, 255}});
    CHECK(texels(png(1, {"\x01\x02\x03\0"s}, 8, colour_alpha)) == Texels{{1, 2, 3, 0}});
    // The second entry is clear by half; the third is the one colour that is clear.
    const std::string entries = chunk("PLTE", "\x0a\x14\x1e\x28\x32\x3c"), clear = chunk("tRNS", "\xff\x80");
    CHECK(texels(png(2, {"\x40"}, 1, palette, entries + clear)) == Texels{{10, 20, 30, 255}, {40, 50, 60, 128}});
    CHECK(texels(png(2, {"\1\2\3\4\5\6"}, 8, colour, chunk("tRNS", "\0\4\0\5\0\6"s))) ==
          Texels{{1, 2, 3, 255}, {4, 5, 6, 0}});
    // 16 bits, to the nearest: 0x807f is 128.0, 0x80ff 128.494 and 0x8101 128.502 of 255.
    CHECK(texels(png(3, {"\x80\x7f\x80\xff\x81\x01"s}, 16, grey)) ==
          Texels{{128, 128, 128, 255}, {128, 128, 128, 255}, {129, 129, 129, 255}});
    // Of two pixels in a row the second comes with the sixth of the seven passes.
    CHECK(texels(png(2, {"\x11", "\x22"}, 8, grey, "", true)) == Texels{{17, 17, 17, 255}, {34, 34, 34, 255}});
}

TEST_CASE("a PNG's gamma changes no texel") {
    for (const uint32_t gamma : {45455u, 100000u, 10000u})
        CHECK(texels(png(1, {"\x40\x80\xc0"}, 8, colour, chunk("gAMA", big_endian(gamma)))) ==
              std::vector<Rgba8>{{64, 128, 192, 255}});
}

TEST_CASE("a PNG whose checksum is wrong is refused") {
    const std::string good = png(2, {"\x11\x22", "\x33\x44"}, 8, grey);
    REQUIRE(texels(good).size() == 4);
    std::string bad = good;
    const size_t texel = bad.find("\x33\x44");
    REQUIRE(texel != std::string::npos);
    bad[texel] = '\x34';
    const Error error = error_of([&] { texels(bad); });
    CHECK(error.code() == ExitCode::input);
    CHECK(std::string(error.what()).find("picture: is truncated or damaged (PNG: ") == 0);
}

TEST_CASE("a PNG of no pixels is refused by what its header claims") {
    CHECK(error_of([] { texels(png(0, {"\1"}, 8, grey)); }).what() ==
          "picture: has no pixels (got 0 x 1, expected 1 x 1 or more)"s);
}

TEST_CASE("a scene with a damaged picture is told of in one line") {
    const TemporaryFolder folder;
    for (std::string picture :
         {png(0, {"\1"}, 8, grey), png(4, {"\1"}, 8, grey), png(1, {"\1"}, 8, grey).substr(0, 50)}) {
        GltfDraft draft = triangle_draft();
        draft.add_pictures(Json::array({{{"name", "bricks"}, {"uri", data_uri(picture, "image/png")}}}));
        const std::string path = write(folder, "street.gltf", draft.gltf());
        const Outcome outcome = run_program("inspect " + path);
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 3);
        CHECK(outcome.err.starts_with("pluvia: error: " + path + ": image 0 \"bricks\": "));
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
}
