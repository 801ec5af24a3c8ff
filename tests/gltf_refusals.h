// What load_gltf says about files that it refuses and the memory it takes, and a small file of many parts to damage.
#pragma once

#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf.h"
#include "tests/gltf_draft.h"

#include <doctest/doctest.h>

#include <string>

#include <sys/resource.h>

namespace pluvia {

/// What load_gltf says about a file that it refuses as unreadable; "" when it reads it.
inline std::string refusal(const std::string& path) {
    try {
        load_gltf(path);
    } catch (const Error& e) {
        CHECK(e.code() == ExitCode::input);
        CHECK(std::string(e.what()).starts_with(path));
        return e.what();
    }
    return "";
}

/// One triangle with texture coordinates, indices, a material, a texture, an embedded picture, a camera and a light.
inline GltfDraft textured_draft() {
    GltfDraft draft;
    const int uv = draft.add_floats({0, 0, 1, 0, 0, 1}, "VEC2");                       // accessor 0
    const int indices = draft.add_values<uint16_t>({0, 1, 2}, "SCALAR", gltf_ushort);  // accessor 1
    const int mesh =
        draft.add_triangle_mesh({{"attributes", {{"TEXCOORD_0", uv}}}, {"indices", indices}, {"material", 0}});
    const auto png = encode_png(Image<Rgba8>(1, 1));
    const int view = draft.add_view({reinterpret_cast<const char*>(png.data()), png.size()});  // view 3
    draft.root["images"] = {{{"name", "bricks"}, {"bufferView", view}, {"mimeType", "image/png"}}};
    draft.root["textures"] = {{{"source", 0}}};
    draft.root["materials"] = {{{"name", "wall"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    draft.root["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    draft.root["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "spot"}, {"spot", Json::object()}}}}}}};
    draft.add_root({{"name", "house"}, {"mesh", mesh}});
    draft.add_root({{"name", "eye"}, {"camera", 0}});
    draft.add_root({{"name", "lamp"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    return draft;
}

inline int64_t peak_memory() {  // bytes
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return int64_t(usage.ru_maxrss) * 1024;
}

}  // namespace pluvia
