// Pictures of textures made smaller.
#include "renderer/scene/texture_size.h"

#include "renderer/scene/gltf.h"
#include "tests/run_program.h"
#include "tests/temporary_folder.h"
#include "tools/validate/known_scenes.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace pluvia {
namespace {

/// Black where x + y is even, else white; the upper left quarter is clear.
Image<Rgba8> checkers(int width, int height) {
    Image<Rgba8> image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const uint8_t v = (x + y) % 2 ? 255 : 0;
            image.at(x, y) = {v, v, v, uint8_t(x < width / 2 && y < height / 2 ? 0 : 255)};
        }
    return image;
}

}  // namespace

TEST_CASE("a smaller picture has the mean light of colours and the mean value of all else") {
    Scene scene;
    scene.images = {checkers(64, 32), checkers(64, 32), checkers(16, 16)};
    scene.textures = {{.image = 0}, {.image = 1}, {.image = 2}};
    scene.materials.resize(1);
    scene.materials[0].base_color_texture = 0;
    scene.materials[0].metallic_roughness_texture = 1;
    shrink_textures(scene, 16);
    REQUIRE(scene.images[0].width == 16);
    REQUIRE(scene.images[0].height == 8);
    CHECK(scene.images[0].at(15, 7).r == 188);  // sRGB's code of half the light: 255 (1.055 / 2^(1/2.4) - 0.055)
    CHECK(scene.images[1].at(15, 7).r == 128);  // 127.5
    CHECK(scene.images[0].at(0, 0).a == 0);
    CHECK(scene.images[0].at(0, 0).r == 188);
    CHECK((scene.images[2].pixels == checkers(16, 16).pixels));
}

TEST_CASE("what is cut away colours no rim, and odd sides keep their mean") {
    Scene scene;
    scene.images = {Image<Rgba8>(2, 1), Image<Rgba8>(5, 3)};
    scene.images[0].pixels = {{255, 0, 0, 255}, {0, 255, 0, 0}};
    for (int i = 0; i < 15; ++i) scene.images[1].pixels[size_t(i)] = {uint8_t(i % 5 * 50), 0, 0, 255};
    scene.textures = {{.image = 0}, {.image = 1}};
    scene.materials.resize(1);
    scene.materials[0].base_color_texture = 0;
    scene.materials[0].metallic_roughness_texture = 1;
    shrink_textures(scene, 1);
    const Rgba8 rim = scene.images[0].at(0, 0);
    CHECK(rim.r > 253);
    CHECK(rim.g < 16);  // 1/256 of the light
    CHECK(rim.a == 128);
    REQUIRE(scene.images[1].pixels.size() == 1);
    CHECK(scene.images[1].at(0, 0).r == 100);
    scene.images[1] = Image<Rgba8>(5, 1);
    for (int i = 0; i < 5; ++i) scene.images[1].at(i, 0) = {uint8_t(i * 50), 0, 0, 255};
    shrink_textures(scene, 3);  // 5/3 texels each: 0 and 2/3 of 50; 1/3 of 50, 100, 1/3 of 150
    REQUIRE(scene.images[1].width == 3);
    CHECK(scene.images[1].at(0, 0).r == 20);
    CHECK(scene.images[1].at(1, 0).r == 100);
    CHECK(scene.images[1].at(2, 0).r == 180);
}

TEST_CASE("--texture-size is recorded, and a wrong one is an error of usage") {
    const TemporaryFolder folder;
    save_glb(make_court(lambert(Rgb(0.5f))), folder / "court.glb");
    const std::string common = "render " + (folder / "court.glb") +
                               " --size 16x8 --spp 1 --environment 1,1,1 --progress none -o " + (folder / "a");
    const Outcome run = run_program(common + " --texture-size 64");
    CAPTURE(run.err);
    REQUIRE(run.exit_code == 0);
    CHECK(nlohmann::json::parse(read_file(folder / "a/frame.json"))["settings"]["texture-size"] == 64);
    CHECK(run_program(common + " --overwrite --texture-size 0").exit_code == 2);
}

}  // namespace pluvia
