// Materials, textures and pictures of glTF files. Geometry is in gltf_test.cpp.
#include "renderer/scene/gltf.h"

#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "tests/gltf_draft.h"

#include <doctest/doctest.h>

using namespace pluvia;

namespace {

/// A file whose triangle has this material.
GltfDraft draft_with(const Json& material) {
    GltfDraft draft = triangle_draft();
    draft.root["materials"] = Json::array({material});
    draft.root["meshes"][0]["primitives"][0]["material"] = 0;
    return draft;
}

void check_is_default(const Material& m) {
    CHECK(m.base_color == Rgb(1));
    CHECK(m.alpha == 1);
    CHECK(m.metallic == 1);
    CHECK(m.roughness == 1);
    CHECK(m.specular == 1);
    CHECK(m.ior == 1.5f);
    CHECK(m.transmission == 0);
    CHECK(m.emission == Rgb(0));
    CHECK(m.specular_color == Rgb(1));
    Material::for_each_slot(m, [](const TextureSlot& slot, const char* name) {
        CAPTURE(name);
        CHECK_FALSE(slot.used());
    });
    CHECK(m.normal_scale == 1);
    CHECK(m.alpha_mode == AlphaMode::opaque);
    CHECK(m.alpha_cutoff == 0.5f);
    CHECK_FALSE(m.double_sided);
}

constexpr Rgba8 brick = {200, 100, 50, 255};

std::string png() {
    const auto bytes = encode_png(Image<Rgba8>(2, 1, brick));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The smallest baseline JPEG: one block of mid grey, whose two Huffman tables have one code each. ITU-T T.81, annex B.
std::string jpeg() {
    const auto bytes = [](std::initializer_list<int> values) {
        std::string result;
        for (const int v : values) result += char(v);
        return result;
    };
    const auto table = [&](int id) { return bytes({0xff, 0xc4, 0, 20, id, 1}) + std::string(15, '\0') + bytes({0}); };
    return bytes({0xff, 0xd8, 0xff, 0xdb, 0, 67, 0}) + std::string(64, 1) +
           bytes({0xff, 0xc0, 0, 11, 8, 0, 8, 0, 8, 1, 1, 0x11, 0}) + table(0x00) + table(0x10) +
           bytes({0xff, 0xda, 0, 8, 1, 1, 0, 0, 63, 0, 0x3f, 0xff, 0xd9});
}

}  // namespace

TEST_CASE("an empty material and a missing one are the specification's default") {
    GltfDraft draft = draft_with(Json::object());
    Scene scene = load(draft);
    check_is_default(scene.materials[scene.meshes[0].material]);
    draft.root["meshes"][0]["primitives"][0].erase("material");
    scene = load(draft);
    CHECK(scene.meshes[0].material == 1);
    check_is_default(scene.materials[scene.meshes[0].material]);
}

TEST_CASE("a material's factors and extensions are read") {
    const Scene scene = load(draft_with(
        {{"name", "glass"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.25, 0.125, 0.75}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.0625}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.25},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 3000}}},
           {"KHR_materials_ior", {{"ior", 1.25}}},
           {"KHR_materials_specular", {{"specularFactor", 0.5}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 0.75}}}}}}));
    const Material& m = scene.materials[0];
    CHECK(m.name == "glass");
    CHECK(m.base_color == Rgb(0.5f, 0.25f, 0.125f));
    CHECK(m.alpha == 0.75f);
    CHECK(m.metallic == 0.25f);
    CHECK(m.roughness == 0.0625f);
    CHECK(m.emission == Rgb(3000, 1500, 0));
    CHECK(m.ior == 1.25f);
    CHECK(m.specular == 0.5f);
    CHECK(m.transmission == 0.75f);
    CHECK(m.alpha_mode == AlphaMode::mask);
    CHECK(m.alpha_cutoff == 0.25f);
    CHECK(m.double_sided);
    CHECK(scene.warnings.empty());
    CHECK(load(draft_with({{"alphaMode", "BLEND"}})).materials[0].alpha_mode == AlphaMode::blend);
    CHECK(load(draft_with({{"alphaMode", "OPAQUE"}})).materials[0].alpha_mode == AlphaMode::opaque);
}

TEST_CASE("a factor that would create light is brought back into its range, and that is said") {
    const Scene scene = load(draft_with(
        {{"name", "odd"},
         {"pbrMetallicRoughness", {{"metallicFactor", -1}, {"roughnessFactor", 3}, {"baseColorFactor", {1, 1, 1, 2}}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", -5}}},
           {"KHR_materials_ior", {{"ior", 0.5}}},
           {"KHR_materials_specular", {{"specularFactor", 4}}},
           {"KHR_materials_transmission", {{"transmissionFactor", 1e300}}}}}}));
    const Material& m = scene.materials[0];
    CHECK(m.metallic == 0);
    CHECK(m.roughness == 1);
    CHECK(m.alpha == 1);
    CHECK(m.ior == 1);
    CHECK(m.specular == 1);
    CHECK(m.transmission == 1);
    CHECK(m.emission == Rgb(0));
    for (const char* name :
         {"metallicFactor", "roughnessFactor", "alpha", "ior", "specularFactor", "transmissionFactor", "emission"}) {
        CAPTURE(name);
        CHECK(warns(scene, std::string("material \"odd\": its ") + name + " is out of range"));
    }
    // 0 is allowed and means a surface that reflects everything.
    const Scene mirror = load(draft_with({{"extensions", {{"KHR_materials_ior", {{"ior", 0}}}}}}));
    CHECK(mirror.materials[0].ior >= 1000);
    CHECK(mirror.warnings.empty());
}

TEST_CASE("samplers give wrapping and filter of a texture") {
    GltfDraft draft = draft_with(Json::object());
    draft.root["images"] = {{{"uri", data_uri(png(), "image/png")}}};
    draft.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}},
                              {{"wrapS", 10497}, {"wrapT", 33071}, {"magFilter", 9729}},
                              Json::object()};
    for (int sampler = 0; sampler < 3; ++sampler) draft.add("textures", {{"source", 0}, {"sampler", sampler}});
    draft.add("textures", {{"source", 0}});
    const Scene scene = load(draft);
    REQUIRE(scene.textures.size() == 4);
    CHECK(scene.textures[0].wrap_u == Wrap::clamp);
    CHECK(scene.textures[0].wrap_v == Wrap::mirror);
    CHECK(scene.textures[0].nearest);
    CHECK(scene.textures[1].wrap_u == Wrap::repeat);
    CHECK(scene.textures[1].wrap_v == Wrap::clamp);
    CHECK_FALSE(scene.textures[1].nearest);
    for (const int standard : {2, 3}) {
        CHECK(scene.textures[standard].wrap_u == Wrap::repeat);
        CHECK(scene.textures[standard].wrap_v == Wrap::repeat);
        CHECK_FALSE(scene.textures[standard].nearest);
    }
}

TEST_CASE("texture slots refer to their textures, and what a slot cannot have is named") {
    GltfDraft draft = draft_with(
        {{"name", "wall"},
         {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"metallicRoughnessTexture", {{"index", 1}}}}},
         {"normalTexture", {{"index", 2}, {"scale", 0.5}, {"texCoord", 1}}},
         {"emissiveTexture", {{"index", 3}, {"texCoord", 2}}},
         {"extensions",
          {{"KHR_materials_specular",
            {{"specularTexture", {{"index", 4}, {"texCoord", 1}}},
             {"specularColorFactor", {0.5, 0.25, 2}},
             {"specularColorTexture", {{"index", 5}}}}},
           {"KHR_materials_transmission", {{"transmissionTexture", {{"index", 6}}}}}}}});
    draft.root["images"] = {{{"uri", data_uri(png(), "image/png")}}};
    for (int i = 0; i < 7; ++i) draft.add("textures", {{"source", 0}});
    const Scene scene = load(draft);
    const Material& m = scene.materials[0];
    CHECK(m.base_color_texture == 0);
    CHECK(m.metallic_roughness_texture == 1);
    CHECK(m.normal_texture.texture == 2);
    CHECK(m.normal_texture.uv_set == 1);
    CHECK(m.normal_scale == 0.5f);
    CHECK(m.emission_texture == 3);
    CHECK(m.specular_texture.texture == 4);
    CHECK(m.specular_texture.uv_set == 1);
    CHECK(m.specular_color == Rgb(0.5f, 0.25f, 2));
    CHECK(m.specular_color_texture == 5);
    CHECK(m.transmission_texture == 6);
    CHECK(scene.warnings.size() == 1);
    CHECK(warns(scene, "material \"wall\": its emissiveTexture uses TEXCOORD_2"));
}

TEST_CASE("an occlusion map has no effect, since paths find what it stands for, costs nothing, and nothing is said") {
    Json material = {{"occlusionTexture", {{"index", 0}, {"strength", 0.5}}}};
    for (const std::string& picture : {png(), std::string("no picture at all")}) {
        GltfDraft draft = draft_with(material);
        draft.root["images"] = {{{"uri", data_uri(picture, "image/png")}}};
        draft.add("textures", {{"source", 0}});
        const Scene scene = load(draft);
        check_is_default(scene.materials[0]);
        CHECK(scene.warnings.empty());
        CHECK(scene.images[0].pixels.size() == 1);
    }
    // Many exporters keep occlusion and roughness in one picture.
    material["pbrMetallicRoughness"] = {{"metallicRoughnessTexture", {{"index", 0}}}};
    GltfDraft draft = draft_with(material);
    draft.root["images"] = {{{"uri", data_uri(png(), "image/png")}}};
    draft.add("textures", {{"source", 0}});
    CHECK(load(draft).images[0].pixels == std::vector<Rgba8>(2, brick));
}

TEST_CASE("a picture is the same embedded, as a data URI and beside the file") {
    const TemporaryFolder folder;
    write(folder, "wet road.png", png());
    GltfDraft draft = triangle_draft();
    const int view = draft.add_view(png());
    draft.add_pictures({{{"bufferView", view}, {"mimeType", "image/png"}},
                        {{"uri", data_uri(png(), "image/png")}},
                        {{"uri", "wet%20road.png"}}});
    for (const bool binary : {false, true}) {
        const std::string path = binary ? write(folder, "s.glb", draft.glb()) : write(folder, "s.gltf", draft.gltf());
        const Scene scene = load_gltf(path);
        REQUIRE(scene.images.size() == 3);
        for (const Image<Rgba8>& image : scene.images) {
            CHECK(image.width == 2);
            CHECK(image.height == 1);
            CHECK(image.pixels == std::vector<Rgba8>(2, brick));
        }
    }
}

TEST_CASE("a picture in the current folder is not taken for one beside the scene") {
    const TemporaryFolder folder;
    const auto before = std::filesystem::current_path();
    std::filesystem::create_directory(folder / "elsewhere");
    write(folder, "elsewhere/bricks.png", png());
    GltfDraft draft = triangle_draft();
    draft.add_pictures(Json::array({{{"uri", "bricks.png"}}}));
    write(folder, "scene.gltf", draft.gltf());
    std::filesystem::current_path(folder / "elsewhere");
    CHECK_THROWS_AS(load_gltf("../scene.gltf"), Error);
    write(folder, "bricks.png", png());
    CHECK_NOTHROW(load_gltf("../scene.gltf"));
    std::filesystem::current_path(folder.path());
    CHECK_NOTHROW(load_gltf("scene.gltf"));
    std::filesystem::current_path(before);
}

TEST_CASE("pictures are recognised by their content, whatever the file calls them") {
    GltfDraft draft = triangle_draft();
    const int view = draft.add_view(jpeg());
    draft.add_pictures({{{"bufferView", view}, {"mimeType", "image/jpeg"}},
                        {{"bufferView", view}, {"mimeType", "image/png"}},
                        {{"uri", data_uri(jpeg(), "image/jpeg")}}});
    for (const Image<Rgba8>& image : load(draft).images) {
        CHECK(image.width == 8);
        CHECK(image.height == 8);
        CHECK(image.pixels[63] == Rgba8{128, 128, 128, 255});
    }
}
