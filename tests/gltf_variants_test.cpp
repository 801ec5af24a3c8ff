// KHR_materials_variants: which material each mesh shows.
#include "renderer/core/error.h"
#include "renderer/scene/gltf.h"
#include "tests/error_of.h"
#include "tests/gltf_draft.h"

#include <doctest/doctest.h>

using namespace pluvia;

namespace {

/// Two triangles; the first is material 0, or 1 when "wet" and "icy", the second always material 2.
GltfDraft draft_with_variants() {
    GltfDraft draft = triangle_draft();
    for (const char* name : {"dry", "shiny", "plain"}) draft.add("materials", {{"name", name}});
    draft.root["extensionsUsed"] = {"KHR_materials_variants"};
    draft.root["extensions"] = {
        {"KHR_materials_variants", {{"variants", {{{"name", "usual"}}, {{"name", "wet"}}, {{"name", "icy"}}}}}}};
    Json& first = draft.root["meshes"][0]["primitives"][0];
    first["material"] = 0;
    first["extensions"] = {{"KHR_materials_variants", {{"mappings", {{{"material", 1}, {"variants", {1, 2}}}}}}}};
    draft.add_root({{"mesh", draft.add_triangle_mesh({{"material", 2}})}});
    return draft;
}

std::vector<std::string> shown(const std::string& path, const std::string& variant) {
    const Scene scene = load_gltf(path, {.variant = variant});
    std::vector<std::string> names;
    for (const Instance& i : scene.instances) names.push_back(scene.materials[scene.meshes[i.mesh].material].name);
    return names;
}

}  // namespace

TEST_CASE("a variant changes the meshes that have a material for it, and no others") {
    const TemporaryFolder folder;
    const std::string path = write(folder, "variants.gltf", draft_with_variants().gltf());
    using Names = std::vector<std::string>;
    CHECK(shown(path, "") == Names{"dry", "plain"});
    CHECK(shown(path, "usual") == Names{"dry", "plain"});
    CHECK(shown(path, "wet") == Names{"shiny", "plain"});
    CHECK(shown(path, "icy") == Names{"shiny", "plain"});
    GltfContents contents;
    CHECK(load_gltf(path, {}, &contents).warnings.empty());
    CHECK(contents.variants == Names{"usual", "wet", "icy"});
}

TEST_CASE("a variant that a file lacks is a mistake of the command line that names those it has") {
    const TemporaryFolder folder;
    const std::string path = write(folder, "variants.gltf", draft_with_variants().gltf());
    const Error error = error_of([&] { load_gltf(path, {.variant = "oily"}); });
    CHECK(error.code() == ExitCode::usage);
    CHECK(std::string(error.what()).find("usual, wet, icy") != std::string::npos);
    CHECK(error_of([&] {
              load_gltf(write(folder, "none.gltf", triangle_draft().gltf()), {.variant = "wet"});
          }).code() == ExitCode::usage);
}

TEST_CASE("mappings that make no sense leave the meshes as they are, and a missing material is named") {
    const TemporaryFolder folder;
    for (const Json& mappings : {Json(3), Json::array({7}), Json::array({{{"variants", "x"}}}),
                                 Json::array({{{"material", 1}, {"variants", {-1, 99, "1"}}}})}) {
        GltfDraft draft = draft_with_variants();
        draft.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = mappings;
        CHECK(shown(write(folder, "odd.gltf", draft.gltf()), "wet")[0] == "dry");
    }
    GltfDraft draft = draft_with_variants();
    draft.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0]["material"] = 50;
    const Error error = error_of([&] { load_gltf(write(folder, "far.gltf", draft.gltf()), {.variant = "wet"}); });
    CHECK(error.code() == ExitCode::input);
    CHECK(std::string(error.what()).find("material does not exist") != std::string::npos);
}
