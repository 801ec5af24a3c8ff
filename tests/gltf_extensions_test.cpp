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

namespace {

/// Where the reflections of a triangle's material are drawn out, seen along `ray`; in the scene, unit.
Vec3 drawn_out(const Scene& scene, Vec3 ray) {
    Counters counters;
    const Surface s = evaluate_surface(scene, {0, 0, 0.25f, 0.25f}, ray, 0, counters);
    const auto* bsdf = std::get_if<MetallicRoughness>(&s.bsdf);
    REQUIRE(bsdf);
    CHECK(counters[Feature::anisotropy] == (bsdf->anisotropy.strength > 0 ? 1 : 0));
    const Vec2 d = bsdf->anisotropy.direction;
    return bsdf->anisotropy.strength > 0 ? ShadingBasis(s.shading_normal).to_world({d.x, d.y, 0}) : Vec3();
}

/// Angle between two axes, whichever way they point; radians.
float angle_between_axes(Vec3 a, Vec3 b) {
    return std::acos(std::min(1.0f, std::abs(dot(a, b))));
}

}  // namespace

TEST_CASE("anisotropy follows the mesh's tangents, turned by its rotation and its texture, on both sides") {
    const float third = pi / 3;
    GltfDraft draft =
        draft_with(with("KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", third}}));
    auto& attributes = draft.root["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = draft.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const auto expect = [&](float degrees, float strength) {
        const Scene scene = load(draft);
        CHECK(scene.warnings.empty());
        const float angle = degrees * pi / 180;
        for (const Vec3 ray : {Vec3(0, 0, -1), Vec3(0, 0, 1), normalize(Vec3(0.3f, 0.2f, -1))}) {
            CAPTURE(degrees);
            CHECK(angle_between_axes(drawn_out(scene, ray), {std::cos(angle), std::sin(angle), 0}) < 0.01f);
            Counters counters;
            const Surface s = evaluate_surface(scene, {0, 0, 0.25f, 0.25f}, ray, 0, counters);
            CHECK(std::get<MetallicRoughness>(s.bsdf).anisotropy.strength == doctest::Approx(strength));
        }
    };
    SUBCASE("by its rotation, from the file's tangents") {
        attributes["TANGENT"] = draft.add_floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
        expect(60, 0.5f);
        attributes["TANGENT"] = draft.add_floats({1, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}, "VEC4");
        expect(-60, 0.5f);                             // the bitangent points down
        draft.root["nodes"][0]["scale"] = {1, -1, 1};  // and in a mirrored object up again
        expect(60, 0.5f);
        // A stretched one draws its tangents along: of (1, 1) the direction (1, 2) is left.
        attributes["TANGENT"] = draft.add_floats({1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 1}, "VEC4");
        draft.root["nodes"][0]["scale"] = {1, 2, 1};
        draft.root["materials"][0]["extensions"]["KHR_materials_anisotropy"]["anisotropyRotation"] = 0;
        expect(std::atan(2.0f) * 180 / pi, 0.5f);
    }
    SUBCASE("from texture coordinates where the file has no tangents") {
        attributes["TEXCOORD_0"] =
            draft.add_floats({0, 1, 0, 0, 1, 1}, "VEC2");  // u grows along +y, upwards in the picture is +x
        expect(90 - 60, 0.5f);
    }
    SUBCASE("by a texture, whose blue is a share of the strength") {
        attributes["TANGENT"] = draft.add_floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
        attributes["TEXCOORD_0"] = draft.add_floats({0.9f, 0, 0.9f, 0, 0.9f, 0}, "VEC2");
        Image<Rgba8> image(1, 1);
        image.pixels = {{128, 255, 51, 255}};  // along +y with a fifth of the strength
        const auto png = encode_png(image);
        draft.root["images"] = {
            {{"uri", data_uri({reinterpret_cast<const char*>(png.data()), png.size()}, "image/png")}}};
        draft.root["materials"][0]["extensions"]["KHR_materials_anisotropy"]["anisotropyTexture"] = {{"index", 0}};
        expect(90 + 60, 0.1f);
    }
}

TEST_CASE("anisotropy without tangents or texture coordinates is left out, which is said") {
    const Scene scene = load(draft_with(with("KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}})));
    CHECK(drawn_out(scene, {0, 0, -1}) == Vec3());
    CHECK(warns(scene, "mesh \"leaf\": primitive 0 has neither tangents nor the texture coordinates"));
}

TEST_CASE("a light from pictures inside of the file is named with the reason why it has no effect") {
    GltfDraft draft = triangle_draft();
    draft.root["extensionsUsed"] = {"EXT_lights_image_based"};
    const Scene scene = load(draft);
    CHECK(warns(scene, "EXT_lights_image_based has no effect: it states its radiance in lux"));
    CHECK(scene.warnings.size() == 1);
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
