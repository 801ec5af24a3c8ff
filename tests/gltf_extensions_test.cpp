// Extensions of glTF materials: clear coat, sheen, volume, unlit and the older specular-glossiness.
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf.h"
#include "renderer/scene/open_volumes.h"
#include "tests/gltf_draft.h"
#include "tests/test_scenes.h"

#include <doctest/doctest.h>

using namespace pluvia;

namespace {

GltfDraft draft_with(const Json& material) {
    GltfDraft draft = triangle_draft();
    draft.root["materials"] = Json::array({material});
    draft.root["meshes"][0]["primitives"][0]["material"] = 0;
    Image<Rgba8> image(2, 1);
    image.pixels = {{200, 100, 50, 255}, {10, 20, 30, 51}};
    const auto png = encode_png(image);
    const std::string_view bytes(reinterpret_cast<const char*>(png.data()), png.size());
    draft.root["images"] = {{{"uri", data_uri(bytes, "image/png")}}};
    for (int i = 0; i < 3; ++i) draft.add("textures", {{"source", 0}});
    return draft;
}

Json with(const char* extension, Json members) {
    return {{"name", "m"}, {"extensions", {{extension, std::move(members)}}}};
}

}  // namespace

TEST_CASE("a clear coat's factors and textures are read") {
    const Scene scene =
        load(draft_with(with("KHR_materials_clearcoat", {{"clearcoatFactor", 0.75},
                                                         {"clearcoatRoughnessFactor", 0.25},
                                                         {"clearcoatTexture", {{"index", 0}}},
                                                         {"clearcoatRoughnessTexture", {{"index", 1}}},
                                                         {"clearcoatNormalTexture", {{"index", 2}, {"scale", 0.5}}}})));
    const Material& m = scene.materials[0];
    CHECK(m.clearcoat == 0.75f);
    CHECK(m.clearcoat_roughness == 0.25f);
    CHECK(m.clearcoat_normal_scale == 0.5f);
    CHECK(m.clearcoat_texture == 0);
    CHECK(m.clearcoat_roughness_texture == 1);
    CHECK(m.clearcoat_normal_texture == 2);
    CHECK(m.is_layered());
    CHECK(scene.warnings.empty());
}

TEST_CASE("sheen's colour, roughness and textures are read") {
    const Scene scene = load(draft_with(with("KHR_materials_sheen", {{"sheenColorFactor", {0.5, 0.25, 0.125}},
                                                                     {"sheenColorTexture", {{"index", 1}}},
                                                                     {"sheenRoughnessFactor", 0.75},
                                                                     {"sheenRoughnessTexture", {{"index", 2}}}})));
    const Material& m = scene.materials[0];
    CHECK(m.sheen_color == Rgb(0.5f, 0.25f, 0.125f));
    CHECK(m.sheen_color_texture == 1);
    CHECK(m.sheen_roughness == 0.75f);
    CHECK(m.sheen_roughness_texture == 2);
    CHECK(scene.warnings.empty());
}

TEST_CASE("a material may be unlit") {
    CHECK(load(draft_with(with("KHR_materials_unlit", Json::object()))).materials[0].unlit);
}

TEST_CASE("specular-glossiness becomes a dielectric with the same reflectance and 1 - glossiness") {
    Scene scene =
        load(draft_with(with("KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.5, 0.25, 0.125, 0.75}},
                                                                     {"specularFactor", {0.9, 0.6, 0.3}},
                                                                     {"glossinessFactor", 0.75}})));
    Material m = scene.materials[0];
    CHECK(m.base_color == Rgb(0.5f, 0.25f, 0.125f));
    CHECK(m.alpha == 0.75f);
    CHECK(m.metallic == 0);
    CHECK(m.roughness == 0.25f);
    CHECK(normal_reflectance(m.ior) == doctest::Approx(1).epsilon(1e-5));
    CHECK(m.specular_color == Rgb(0.9f, 0.6f, 0.3f));
    CHECK(warns(scene, "material \"m\": KHR_materials_pbrSpecularGlossiness is converted"));

    scene = load(draft_with(with("KHR_materials_pbrSpecularGlossiness",
                                 {{"glossinessFactor", 0.5}, {"specularGlossinessTexture", {{"index", 1}}}})));
    m = scene.materials[0];
    CHECK(m.specular_color_texture == 1);
    CHECK(m.roughness == 1);
    const Image<Rgba8>& rough = scene.images[scene.textures[m.metallic_roughness_texture.texture].image];
    CHECK(rough.pixels[0].g == 128);  // 255 (1 - 0.5)
    CHECK(rough.pixels[1].g == 230);  // 255 (1 - 0.5 * 0.2)
}

TEST_CASE("a body's volume is read, and one whose surface has an edge is rendered thin, which is said") {
    Json material = with("KHR_materials_volume",
                         {{"thicknessFactor", 0.5}, {"attenuationDistance", 2}, {"attenuationColor", {0.5, 0.75, 1}}});
    material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
    const Scene open = load(draft_with(material));
    CHECK(open.materials[0].has_volume());
    CHECK(open.materials[0].attenuation_distance == 2);
    CHECK(open.materials[0].attenuation_color == Rgb(0.5f, 0.75f, 1));
    CHECK(warns(open, "mesh \"leaf\": its material \"m\" has a volume, but its surface is not closed"));
    CHECK_FALSE(open.materials[open.meshes[0].material].has_volume());

    Scene scene;
    add_box(scene, {0, 0, 0}, {1, 1, 1}, open.materials[0]);
    add_sphere(scene, {0, 0, 0}, 1, 8, open.materials[0]);
    make_open_volumes_thin(scene);
    CHECK(scene.materials.size() == 2);
    CHECK(scene.warnings.empty());
}
