#include "renderer/scene/gltf_variants.h"

#include "renderer/core/error.h"
#include "renderer/scene/gltf_value.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace pluvia {
namespace {

constexpr const char* extension_name = "KHR_materials_variants";

/// Calls visit(element) for each element of an array; none where the value is something else.
template <class Visit>
void for_each(const tinygltf::Value* array, Visit visit) {
    if (!array || !array->IsArray()) return;
    for (int i = 0; i < int(array->ArrayLen()); ++i) visit(array->Get(i));
}

/// Material that the primitive has for a variant; -1: it keeps its own.
int material_for(const tinygltf::Primitive& primitive, int variant) {
    int material = -1;
    for_each(find(find(primitive.extensions, extension_name), "mappings"), [&](const tinygltf::Value& mapping) {
        for_each(find(&mapping, "variants"), [&](const tinygltf::Value& listed) {
            if (index(&listed) == variant) material = index(find(&mapping, "material"));
        });
    });
    return material;
}

}  // namespace

std::vector<std::string> variant_names(const tinygltf::Model& model) {
    std::vector<std::string> names;
    for_each(find(find(model.extensions, extension_name), "variants"), [&](const tinygltf::Value& variant) {
        const tinygltf::Value* name = find(&variant, "name");
        names.push_back(name && name->IsString() ? name->Get<std::string>() : "");
    });
    return names;
}

void choose_variant(tinygltf::Model& model, const std::string& name, const std::string& where) {
    const auto names = variant_names(model);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw usage_error(where, fmt::format("has no variant of this name (got \"{}\", expected {})", name,
                                             names.empty() ? "none, it has no variants"
                                                           : fmt::format("one of {}", fmt::join(names, ", "))));
    for (tinygltf::Mesh& mesh : model.meshes)
        for (tinygltf::Primitive& primitive : mesh.primitives)
            if (const int material = material_for(primitive, int(found - names.begin())); material >= 0)
                primitive.material = material;
}

}  // namespace pluvia
