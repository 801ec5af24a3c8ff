// What `pluvia inspect` says about a scene, against a file whose contents are known.
#include "tools/inspect_scene.h"

#include "renderer/image/image_io.h"
#include "tests/gltf_draft.h"
#include "tools/scene_memory.h"

#include <doctest/doctest.h>

using namespace pluvia;

namespace {

nlohmann::ordered_json inspect(const GltfDraft& draft) {
    const TemporaryFolder folder;
    return inspect_scene(write(folder, "street.gltf", draft.gltf()), false);
}

}  // namespace

TEST_CASE("inspect counts nodes, and triangles once and as placed") {
    GltfDraft draft;
    const int mesh = draft.add_triangle_mesh();
    for (int i = 0; i < 3; ++i) draft.add_root({{"mesh", mesh}});
    draft.add_root({{"name", "empty"}});
    const auto j = inspect(draft);
    CHECK(j["nodes"] == 4);
    CHECK(j["instances"] == 3);
    CHECK(j["triangles"]["unique"] == 1);
    CHECK(j["triangles"]["with_instances"] == 3);
}

TEST_CASE("inspect tells lights in their units, lenses in degrees and animations in seconds") {
    GltfDraft draft = triangle_draft();
    draft.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 80}},
                                                                 {{"type", "directional"}, {"intensity", 1000}}};
    for (int i = 0; i < 2; ++i) draft.add_root({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    draft.root["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.5235987755982988}, {"znear", 0.1}}}}};
    draft.add_root({{"name", "eye"}, {"camera", 0}});
    const int times = draft.add_floats({0, 2.5}, "SCALAR"), places = draft.add_floats({0, 0, 0, 1, 0, 0}, "VEC3");
    draft.add("animations", {{"name", "walk"},
                             {"samplers", {{{"input", times}, {"output", places}}}},
                             {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
    const auto j = inspect(draft);
    CHECK(j["lights"][0]["candela"][0] == 80);
    CHECK(j["lights"][1]["lux"][0] == 1000);
    CHECK(j["cameras"][0]["vertical_fov_degrees"].get<double>() == doctest::Approx(30));
    CHECK(j["animations"][0]["name"] == "walk");
    CHECK(j["animations"][0]["seconds"] == 2.5);
}

TEST_CASE("inspect tells how each extension of a file is treated") {
    GltfDraft draft = triangle_draft();
    draft.root["extensionsUsed"] = {"KHR_mesh_quantization", "KHR_no_such_thing"};
    draft.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    const auto j = inspect(draft);
    CHECK(j["extensions"][0]["treatment"] == "read");
    CHECK(j["extensions"][0]["required"] == true);
    CHECK(j["extensions"][1]["treatment"] == "warned, has no effect");
    CHECK(j["warnings"].size() == 1);
}

TEST_CASE("inspect counts the materials of each kind that a render would activate") {
    GltfDraft draft = triangle_draft();
    draft.root["materials"] = {{{"extensions",
                                 {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}},
                                  {"KHR_materials_anisotropy", {{"anisotropyStrength", 1}}}}}},
                               {{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.5}}}}}},
                               {{"extensions", {{"KHR_materials_sheen", {{"sheenColorFactor", {1, 0, 0}}}}}}},
                               {{"extensions", {{"KHR_materials_unlit", Json::object()}}}},
                               {{"extensions",
                                 {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                                  {"KHR_materials_volume", {{"thicknessFactor", 1}}}}}},
                               {{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}}};
    const auto j = inspect(draft)["requires"];
    CHECK(j["clearcoat_materials"] == 2);
    CHECK(j["anisotropic_materials"] == 1);
    CHECK(j["sheen_materials"] == 1);
    CHECK(j["unlit_materials"] == 1);
    CHECK(j["transmitting_materials"] == 2);
    CHECK(j["volume_materials"] == 1);
    CHECK(j["emissive_materials"] == 0);
}

TEST_CASE("inspect tells sizes of the pictures that a render looks at, and which ones it does not") {
    GltfDraft draft = triangle_draft();
    const auto png = encode_png(Image<Rgba8>(4, 2));
    const std::string uri = data_uri({reinterpret_cast<const char*>(png.data()), png.size()}, "image/png");
    draft.add_pictures({{{"uri", uri}}, {{"uri", uri}}});
    draft.root["materials"][1] = {{"occlusionTexture", {{"index", 1}}}};
    const auto j = inspect(draft)["images"];
    CHECK(j[0]["used"] == true);
    CHECK(j[0]["width"] == 4);
    CHECK(j[0]["height"] == 2);
    CHECK(j[1]["used"] == false);
    CHECK_FALSE(j[1].contains("width"));
}

TEST_CASE("the memory of a scene counts a mesh once however often it is placed") {
    GltfDraft draft;
    const int mesh = draft.add_triangle_mesh();
    for (int i = 0; i < 1000; ++i) draft.add_root({{"name", "n"}, {"mesh", mesh}});
    const SceneMemory memory = estimate_memory(load(draft));
    // One triangle and its vertices, and a thousand instances of some hundred bytes.
    CHECK(memory.geometry > 1000 * sizeof(Instance));
    CHECK(memory.geometry < 1000 * (sizeof(Instance) + 64) + 1000);
    CHECK(memory.textures == 0);
}
