// Depth as integers: every code comes back as itself, and none stays none.
#include "renderer/image/depth_encoding.h"
#include "renderer/core/error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace pluvia;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("every code of a depth encoding decodes to a depth that encodes to it") {
    int wrong = 0;
    for (uint32_t code = 0; code <= 65535; ++code) {
        wrong += encode_kitti16(decode_kitti16(uint16_t(code))) != code;
        wrong += encode_mm16(decode_mm16(uint16_t(code))) != code;
        // 0 m lies on the camera and counts as none
        wrong += code > 0 && encode_hri(decode_hri(uint16_t(code), 123.4f), 123.4f) != code;
    }
    // Beyond 512 m two floats are further apart than two codes.
    constexpr uint32_t code_at_512_m = 8589933;
    for (uint32_t code = 1; code < code_at_512_m; code += 61) {
        const Rgba8 value = {uint8_t(code), uint8_t(code >> 8), uint8_t(code >> 16), 255};
        wrong += encode_carla24(decode_carla24(value)) != value;
    }
    CHECK(wrong == 0);
}

TEST_CASE("depths decode within half a step") {
    for (float depth = 0.05f; depth < 60; depth *= 1.01f) {
        CAPTURE(depth);
        // 4e-6 m: half a float step at 64 m, for the rounding of the decoded value
        CHECK(std::abs(decode_kitti16(encode_kitti16(depth)) - depth) <= 0.5f / 256 + 4e-6f);
        CHECK(std::abs(decode_mm16(encode_mm16(depth)) - depth) <= 0.0005f + 4e-6f);
        CHECK(std::abs(decode_carla24(encode_carla24(depth)) - depth) <= 500.0f / 16777215 + 4e-6f);
        CHECK(std::abs(decode_hri(encode_hri(depth, 80), 80) - depth) <= 40.0f / 65535 + 4e-6f);
    }
}

TEST_CASE("known depths have the codes that other programs expect") {
    CHECK(encode_kitti16(10) == 2560);
    CHECK(encode_kitti16(255.99f) == 65533);
    CHECK(encode_mm16(1.234f) == 1234);
    CHECK(encode_hri(50, 100) == 32768);
    // CARLA sensor reference: normalized = (R + 256 G + 65536 B) / (256^3 - 1), metres = 1000 normalized
    CHECK(decode_carla24({0, 0, 128, 255}) == doctest::Approx(1000.0 * 128 * 65536 / 16777215).epsilon(1e-7).scale(0));
    CHECK(decode_carla24({1, 0, 0, 0}) == doctest::Approx(1000.0 / 16777215).epsilon(1e-6).scale(0));
    CHECK(encode_carla24(500) == Rgba8{0, 0, 128, 255});
}

TEST_CASE("the sky, nonsense and depths beyond the limit are none") {
    for (const float depth : {infinity, not_a_number, 0.0f, -3.0f, 1001.0f}) {
        CAPTURE(depth);
        CHECK(encode_kitti16(depth) == 0);
        CHECK(encode_mm16(depth) == 0);
        CHECK(encode_carla24(depth) == Rgba8{255, 255, 255, 255});
        CHECK(encode_hri(depth, 1000) == 65535);
    }
    CHECK(decode_kitti16(0) == infinity);
    CHECK(decode_mm16(0) == infinity);
    CHECK(decode_carla24({255, 255, 255, 255}) == infinity);
    CHECK(decode_hri(65535, 1000) == infinity);
}

TEST_CASE("a depth at the limit is not none, and one beyond is") {
    CHECK(encode_kitti16(kitti16_limit) == 65535);
    CHECK(encode_kitti16(std::nextafter(kitti16_limit, infinity)) == 0);
    CHECK(encode_mm16(mm16_limit) == 65535);
    CHECK(encode_mm16(std::nextafter(mm16_limit, infinity)) == 0);
    CHECK(encode_carla24(carla24_limit) == Rgba8{254, 255, 255, 255});
    CHECK(encode_carla24(std::nextafter(carla24_limit, infinity)) == Rgba8{255, 255, 255, 255});
    CHECK(encode_hri(100, 100) == 65534);
    CHECK(encode_hri(std::nextafter(100.0f, infinity), 100) == 65535);
}

TEST_CASE("a depth too small to tell from none is the smallest that can be told") {
    CHECK(encode_kitti16(1e-6f) == 1);
    CHECK(encode_mm16(1e-6f) == 1);
}

TEST_CASE("depths beyond the limit are counted and the sky is not") {
    const float depths[] = {10, 255.9f, 256, 400, infinity, not_a_number, 0};
    CHECK(count_beyond(depths, kitti16_limit) == 2);
}

TEST_CASE("depth encodings are found by name, and an unknown one lists them") {
    CHECK(depth_encoding_from_name("kitti16", "--depth-encoding") == DepthEncoding::kitti16);
    CHECK(depth_encoding_from_name("hri", "--depth-encoding") == DepthEncoding::hri);
    try {
        depth_encoding_from_name("kitti", "--depth-encoding");
        FAIL("no error");
    } catch (const Error& e) {
        CHECK(e.code() == ExitCode::usage);
        CHECK(std::string(e.what()) ==
              "--depth-encoding: unknown depth encoding (got kitti, expected one of kitti16, mm16, carla24, hri)");
    }
}
