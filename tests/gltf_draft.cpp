#include "tests/gltf_draft.h"

#include "renderer/scene/gltf.h"

#include <algorithm>

namespace pluvia {

namespace {

/// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string word(uint64_t value) {  // little-endian
    std::string bytes;
    for (int k = 0; k < 4; ++k) bytes += char(value >> (8 * k));
    return bytes;
}

std::string chunk(std::string content, const std::string& type, char padding) {
    content.resize((content.size() + 3) / 4 * 4, padding);
    return word(content.size()) + type + content;
}

}  // namespace

int GltfDraft::add(const std::string& array, Json entry) {
    root[array].push_back(std::move(entry));
    return int(root[array].size()) - 1;
}

int GltfDraft::add_view(std::string_view content, int stride) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    Json view = {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}};
    if (stride > 0) view["byteStride"] = stride;
    bytes += content;
    return add("bufferViews", view);
}

int GltfDraft::add_accessor(int view, int count, const std::string& type, GltfType component, bool normalized,
                            int offset) {
    return add("accessors", {{"bufferView", view},
                             {"byteOffset", offset},
                             {"componentType", component},
                             {"count", count},
                             {"type", type},
                             {"normalized", normalized}});
}

int GltfDraft::add_triangle_mesh(Json more) {
    const int position = add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    Json primitive = {{"attributes", {{"POSITION", position}}}};
    primitive.merge_patch(more);
    return add("meshes", {{"name", "leaf"}, {"primitives", Json::array({primitive})}});
}

int GltfDraft::add_root(Json node) {
    const int index = add("nodes", std::move(node));
    root["scenes"][0]["nodes"].push_back(index);
    return index;
}

std::string GltfDraft::gltf() const {
    Json whole = root;
    if (!bytes.empty())
        whole["buffers"] = {{{"byteLength", bytes.size()}, {"uri", data_uri(bytes, "application/octet-stream")}}};
    return whole.dump();
}

void GltfDraft::add_pictures(const Json& images) {
    root["images"] = images;
    for (int i = 0; i < int(images.size()); ++i) {
        const int texture = add("textures", {{"source", i}});
        add("materials", {{"emissiveTexture", {{"index", texture}}}});
    }
}

std::string GltfDraft::glb() const {
    Json whole = root;
    if (!bytes.empty()) whole["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string chunks = chunk(whole.dump(), "JSON", ' ');
    if (!bytes.empty()) chunks += chunk(bytes, std::string("BIN\0", 4), '\0');
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

GltfDraft triangle_draft() {
    GltfDraft draft;
    draft.add_root({{"name", "triangle"}, {"mesh", draft.add_triangle_mesh()}});
    return draft;
}

std::string write(const TemporaryFolder& folder, const std::string& name, std::string_view bytes) {
    const std::string path = folder / name;
    std::filesystem::remove(path);  // some file systems wait for the disk when a file is overwritten
    write_file(path, std::string(bytes));
    return path;
}

Scene load(const GltfDraft& draft) {
    const TemporaryFolder folder;
    return load_gltf(write(folder, "draft.gltf", draft.gltf()));
}

bool warns(const Scene& scene, const std::string& text) {
    return std::any_of(scene.warnings.begin(), scene.warnings.end(),
                       [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}

std::string data_uri(std::string_view bytes, const std::string& mime_type) {
    return "data:" + mime_type + ";base64," + base64(bytes);
}

}  // namespace pluvia
