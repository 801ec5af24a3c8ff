// Where textures are looked up, and the formats of their pictures.
#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/surface.h"
#include "renderer/scene/texture.h"
#include "tests/gltf_draft.h"

#include <doctest/doctest.h>

#include <numbers>

using namespace pluvia;

namespace {

std::string text(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Sixteen texels, each of its own grey: its number in rows from the top, times 16.
std::string numbered_png() {
    Image<Rgba8> image(4, 4);
    for (int i = 0; i < 16; ++i) image.pixels[i] = {uint8_t(16 * i), uint8_t(16 * i), uint8_t(16 * i), 255};
    return text(encode_png(image));
}

/// A triangle that glows by the numbered picture, with two sets of uv coordinates. slot: further members of the
/// emissive texture's info.
GltfDraft glowing_triangle(const Json& slot) {
    GltfDraft draft;
    const int uv0 = draft.add_floats({0, 0, 1, 0, 0, 1}, "VEC2"), uv1 = draft.add_floats({1, 1, 0, 1, 1, 0}, "VEC2");
    const int position = draft.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const Json attributes = {{"POSITION", position}, {"TEXCOORD_0", uv0}, {"TEXCOORD_1", uv1}};
    draft.add("meshes", {{"primitives", Json::array({{{"attributes", attributes}, {"material", 0}}})}});
    draft.add_root({{"mesh", 0}});
    Json info = {{"index", 0}};
    info.update(slot.is_null() ? Json::object() : slot);
    draft.add("materials", {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", info}});
    draft.root["images"] = {{{"uri", data_uri(numbered_png(), "image/png")}}};
    draft.root["samplers"] = {{{"magFilter", 9728}}};
    draft.add("textures", {{"source", 0}, {"sampler", 0}});
    return draft;
}

/// Column and row of the texel that shows at (u, v) of the triangle.
std::pair<int, int> texel_at(const Scene& scene, float u, float v) {
    const float level = emission(scene, {.instance = 0, .triangle = 0, .b1 = u, .b2 = v}).g;
    // Texels differ by 16 of 255 display levels; sRGB is monotonous.
    int number = 0;
    while (number < 15 &&
           lookup_color(scene, 0, {float(number % 4) / 4 + 0.1f, float(number / 4) / 4 + 0.1f}).g < level)
        ++number;
    return {number % 4, number / 4};
}

Json transform(Json members) {
    return {{"extensions", {{"KHR_texture_transform", std::move(members)}}}};
}

/// DDS with one block of BC1, all of its first colour. Source: Microsoft, "Programming Guide for DDS".
std::string red_dds() {
    std::string bytes = "DDS ";
    const auto word = [&](uint32_t v) {
        for (int k = 0; k < 4; ++k) bytes += char(v >> (8 * k));
    };
    for (const uint32_t v : {124u, 0x81007u, 4u, 4u, 8u, 0u, 0u}) word(v);
    for (int i = 0; i < 11; ++i) word(0);
    for (const uint32_t v : {32u, 4u, 0x31545844u, 0u, 0u, 0u, 0u, 0u, 0x1000u, 0u, 0u, 0u, 0u}) word(v);  // "DXT1"
    word(0xf800);  // red in 5:6:5, and black
    word(0);
    return bytes;
}

// Two texels without loss, (200, 100, 50) at alpha 128 and (10, 20, 30) at 255, as libwebp 1.2.4 writes them.
constexpr unsigned char webp_bytes[] = {0x52, 0x49, 0x46, 0x46, 0x22, 0x00, 0x00, 0x00, 0x57, 0x45, 0x42,
                                        0x50, 0x56, 0x50, 0x38, 0x4c, 0x16, 0x00, 0x00, 0x00, 0x2f, 0x01,
                                        0x00, 0x00, 0x10, 0x0f, 0x70, 0x0a, 0xa8, 0x2b, 0xf8, 0x9e, 0xc2,
                                        0xe3, 0x81, 0xff, 0xc1, 0x83, 0x8c, 0xe8, 0x7f, 0x00};
const std::string webp(reinterpret_cast<const char*>(webp_bytes), sizeof webp_bytes);

}  // namespace

TEST_CASE("a slot looks its texture up by its own uv set") {
    CHECK(texel_at(load(glowing_triangle({})), 0.3f, 0.1f) == std::pair(1, 0));
    // The second set is the first turned by half a turn.
    CHECK(texel_at(load(glowing_triangle({{"texCoord", 1}})), 0.3f, 0.1f) == std::pair(2, 3));
    Json both = transform({{"texCoord", 1}, {"offset", {0, 0}}});
    both["texCoord"] = 0;
    CHECK(texel_at(load(glowing_triangle(both)), 0.3f, 0.1f) == std::pair(2, 3));
}

TEST_CASE("KHR_texture_transform scales, turns counter-clockwise as seen, then moves") {
    const auto at = [](const Json& members, float u, float v) {
        return texel_at(load(glowing_triangle(transform(members))), u, v);
    };
    CHECK(at({{"offset", {0.25, 0.5}}}, 0.1f, 0.1f) == std::pair(1, 2));
    CHECK(at({{"scale", {2, 1}}}, 0.3f, 0.1f) == std::pair(2, 0));
    CHECK(at({{"scale", {1, -1}}}, 0.1f, 0.1f) == std::pair(0, 3));  // repeated
    // The u axis, to the right, turns up: v = -u there, repeated from below. The v axis turns to the right.
    const double quarter = std::numbers::pi / 2;
    CHECK(at({{"rotation", quarter}}, 0.3f, 0.1f) == std::pair(0, 2));
    CHECK(at({{"rotation", quarter}, {"offset", {0.25, 0}}, {"scale", {2, 1}}}, 0.1f, 0.3f) == std::pair(2, 3));
}

TEST_CASE("coordinates that are no numbers read some texel") {
    const Scene scene = load(glowing_triangle({}));
    const float infinity = std::numeric_limits<float>::infinity();
    for (const float x : {std::nanf(""), infinity, -infinity, 3e38f, -3e38f})
        for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
            Scene odd = scene;
            odd.textures[0].wrap_u = odd.textures[0].wrap_v = wrap;
            for (const bool nearest : {true, false}) {
                odd.textures[0].nearest = nearest;
                CHECK(is_finite(lookup_color(odd, 0, {x, 0.5f})));
                CHECK(is_finite(lookup_color(odd, 0, {0.5f, x})));
            }
        }
}

TEST_CASE("WebP pictures keep their colour beside alpha, with their extension and without") {
    const std::vector<Rgba8> expected = {{200, 100, 50, 128}, {10, 20, 30, 255}};
    GltfDraft draft = triangle_draft();
    draft.add_pictures(Json::array({{{"uri", data_uri(webp, "image/webp")}}}));
    CHECK(load(draft).images[0].pixels == expected);
    draft.root["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
    draft.root["extensionsUsed"] = draft.root["extensionsRequired"] = {"EXT_texture_webp"};
    const Scene scene = load(draft);
    CHECK(scene.images[0].pixels == expected);
    CHECK(scene.warnings.empty());
    draft.root["images"] = {{{"uri", data_uri(webp.substr(0, 30), "image/webp")}}};
    CHECK_THROWS_WITH_AS(load(draft), doctest::Contains("truncated or damaged"), Error);
}

TEST_CASE("a DDS picture is taken where MSFT_texture_dds offers one, and its fallback is left alone") {
    GltfDraft draft = triangle_draft();
    draft.root["images"] = {{{"uri", data_uri("no picture", "image/png")}},
                            {{"uri", data_uri(red_dds(), "image/vnd-ms.dds")}}};
    draft.add("textures", {{"source", 0}, {"extensions", {{"MSFT_texture_dds", {{"source", 1}}}}}});
    draft.add("materials", {{"emissiveTexture", {{"index", 0}}}});
    draft.root["extensionsUsed"] = {"MSFT_texture_dds"};
    const Scene scene = load(draft);
    CHECK(scene.textures[0].image == 1);
    CHECK(scene.images[1].pixels == std::vector<Rgba8>(16, Rgba8{255, 0, 0, 255}));
    CHECK(scene.warnings.empty());
    // Without the extension the fallback is needed, and it is no picture.
    draft.root["textures"] = {{{"source", 0}}};
    CHECK_THROWS_AS(load(draft), Error);
}
