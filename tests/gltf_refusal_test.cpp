// glTF files that cannot be rendered are refused with a message that names the file and the part at fault.
#include "tests/gltf_refusals.h"

#include <filesystem>
#include <fstream>
#include <limits>

using namespace pluvia;

namespace {

/// One change to textured_draft() and what the message has to say about it.
struct Fault {
    std::string place;  // JSON pointer
    Json value;         // null: the entry is removed
    std::vector<std::string> words;
};

void check_refused(const GltfDraft& draft, const std::vector<std::string>& words) {
    const TemporaryFolder folder;
    const std::string message = refusal(write(folder, "bad.gltf", draft.gltf()));
    CAPTURE(message);
    CHECK(message != "");
    for (const std::string& word : words) {
        CAPTURE(word);
        CHECK(message.find(word) != std::string::npos);
    }
}

void check_refused(const std::vector<Fault>& faults) {
    REQUIRE_NOTHROW(load(textured_draft()));
    for (const Fault& fault : faults) {
        GltfDraft draft = textured_draft();
        const Json::json_pointer place(fault.place);
        if (fault.value.is_null())
            draft.root[place.parent_pointer()].erase(place.back());
        else
            draft.root[place] = fault.value;
        CAPTURE(fault.place);
        CAPTURE(fault.value.dump());
        check_refused(draft, fault.words);
    }
}

}  // namespace

TEST_CASE("numbers that lie outside their buffers are refused") {
    constexpr uint64_t largest = std::numeric_limits<uint64_t>::max();
    check_refused({
        {"/accessors/2/count", 4, {"mesh \"leaf\"", "accessor 2", "4 elements"}},
        {"/accessors/2/count", largest, {"accessor 2"}},
        {"/accessors/2/byteOffset", 4, {"accessor 2"}},
        {"/accessors/2/byteOffset", largest, {"accessor 2"}},
        {"/bufferViews/2/byteStride", 8, {"accessor 2", "stride 8"}},  // less than an element
        {"/bufferViews/2/byteLength", 100000, {"buffer view 2", "100000 bytes"}},
        {"/bufferViews/2/byteOffset", largest - 8, {"buffer view 2"}},
        {"/bufferViews/3/byteLength", 100000, {"image 0 \"bricks\"", "buffer view 3"}},
        {"/bufferViews/2/buffer", 1, {"accessor 2", "buffer does not exist (got 1"}},
        {"/bufferViews/2/buffer", -1, {"accessor 2", "buffer does not exist (got -1"}},
        {"/accessors/2/bufferView", -2, {"accessor 2", "got -2"}},
    });
}

TEST_CASE("numbers of a kind that cannot be meant are refused") {
    const auto sparse = [](int count, int view, int index_type, int value_view) {
        return Json{{"count", count},
                    {"indices", {{"bufferView", view}, {"componentType", index_type}}},
                    {"values", {{"bufferView", value_view}}}};
    };
    check_refused({
        {"/accessors/2/sparse", sparse(4, 1, 5123, 2), {"accessor 2", "got 4 at", "at most 3"}},
        {"/accessors/2/sparse", sparse(-1, 1, 5123, 2), {"accessor 2", "got -1 at"}},
        {"/accessors/2/sparse", sparse(3, 9, 5123, 2), {"accessor 2: sparse indices", "got 9"}},
        {"/accessors/2/sparse", sparse(3, 1, 5123, 9), {"accessor 2: sparse values", "got 9"}},
        {"/accessors/2/sparse", sparse(3, 1, 5125, 2), {"accessor 2: sparse indices", "outside"}},
        {"/accessors/2/sparse", sparse(2, 1, 5130, 2), {"accessor 2: sparse indices", "unknown type"}},
        {"/accessors/2/sparse", sparse(2, 0, 5125, 2), {"accessor 2", "do not rise (got 0 after 0"}},
        {"/accessors/2/sparse", sparse(1, 3, 5125, 2), {"accessor 2", "an element that is not there"}},
        {"/accessors/2/type", "VEC2", {"accessor 2", "got 2 components, expected 3"}},
        {"/accessors/2/componentType", 5124, {"accessor 2"}},  // signed integers
        {"/accessors/2/componentType", 5130, {"accessor 2"}},  // doubles
        {"/meshes/0/primitives/0/indices", 2, {"accessor 2", "wrong type for indices"}},
        {"/meshes/0/primitives/0/attributes/POSITION", nullptr, {"mesh \"leaf\"", "no POSITION"}},
        {"/accessors/1/count", 2, {"mesh \"leaf\"", "got 2 indices"}},
        {"/accessors/0/count", 2, {"mesh \"leaf\"", "TEXCOORD_0", "got 2, expected 3"}},
    });
}

TEST_CASE("vertices that are not there or nowhere are refused") {
    GltfDraft draft = textured_draft();
    draft.bytes[size_t(draft.root["bufferViews"][1]["byteOffset"])] = 3;
    check_refused(draft, {"mesh \"leaf\"", "got 3, expected below 3"});
    for (const char high_byte : {'\xc0', '\x80'}) {  // not a number, infinity
        draft = textured_draft();
        draft.bytes.replace(size_t(draft.root["bufferViews"][2]["byteOffset"]), 4, {0, 0, high_byte, '\x7f'});
        check_refused(draft, {"mesh \"leaf\"", "not finite"});
    }
}

TEST_CASE("normals, colours and coordinates that are not finite are refused by accessor and element") {
    for (const char* attribute : {"NORMAL", "TANGENT", "COLOR_0", "TEXCOORD_0", "TEXCOORD_1"}) {
        const int components = std::string(attribute).starts_with("TEX") ? 2 : attribute[0] == 'N' ? 3 : 4;
        GltfDraft draft;
        std::vector<float> values(3 * size_t(components), 0.5f);
        values.back() = std::numeric_limits<float>::quiet_NaN();
        Json attributes = {{attribute, draft.add_floats(values, "VEC" + std::to_string(components))}};
        if (attribute[0] == 'T' && components == 4)
            attributes["NORMAL"] = draft.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        draft.add_root({{"mesh", draft.add_triangle_mesh({{"attributes", attributes}})}});
        check_refused(draft, {"mesh \"leaf\"", "accessor 0", "not finite", "element 2"});
    }
}

TEST_CASE("files outside of the scene's folder are read only when that is allowed") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "scene");
    GltfDraft draft = triangle_draft();
    write(folder, "street.bin", draft.bytes);
    draft.root["buffers"] = {{{"byteLength", draft.bytes.size()}, {"uri", "../street.bin"}}};
    draft.bytes.clear();
    const std::string path = write(folder, "scene/street.gltf", draft.gltf());
    CHECK(refusal(path).find("buffer 0: its file lies outside of the scene's folder (got \"../street.bin\"") !=
          std::string::npos);
    CHECK(load_gltf(path, {.allow_outside = true}).meshes.size() == 1);
    for (const std::string uri : {"%2e%2e/street.bin", "x/../../street.bin", "/etc/passwd"}) {
        draft.root["buffers"][0]["uri"] = uri;
        CHECK(refusal(write(folder, "scene/street.gltf", draft.gltf())).find("lies outside") != std::string::npos);
    }
    draft.root["buffers"][0]["uri"] = "x/../a%20b.bin";  // inside, and spelled as a URI
    write(folder, "scene/a b.bin", read_file(folder / "street.bin"));
    CHECK(load_gltf(write(folder, "scene/street.gltf", draft.gltf())).meshes.size() == 1);
    draft.root["images"] = {{{"uri", "../secret.png"}}};
    CHECK(refusal(write(folder, "scene/street.gltf", draft.gltf())).find("image 0") != std::string::npos);
}

TEST_CASE("buffers that are missing or short are refused") {
    const TemporaryFolder folder;
    GltfDraft draft = triangle_draft();
    const std::string bytes = draft.bytes;
    draft.bytes.clear();
    const auto says = [&](const Json& buffer, const std::string& words) {
        draft.root["buffers"] = Json::array({buffer});
        const std::string message = refusal(write(folder, "short.gltf", draft.gltf()));
        CAPTURE(message);
        CHECK(message.find("buffer 0") != std::string::npos);
        CHECK(message.find(words) != std::string::npos);
    };
    says({{"byteLength", 36}, {"uri", "missing.bin"}}, "\"missing.bin\"");
    write(folder, "part.bin", bytes.substr(0, 30));
    says({{"byteLength", 36}, {"uri", "part.bin"}}, "too short (got 30 bytes, expected 36)");
    says({{"byteLength", 36}, {"uri", "data:application/octet-stream;base64,AAAA"}}, "got 3 bytes, expected 36");
    says({{"byteLength", 3}, {"uri", "data:application/octet-stream;base64,A*AA"}}, "data URI");
    says({{"byteLength", 36}}, "no uri");
    says({{"uri", "part.bin"}}, "byteLength");
    says({{"byteLength", -1}, {"uri", "part.bin"}}, "byteLength");
}

TEST_CASE("references to what is not there are refused, negative ones too") {
    const std::string slot = "/materials/0/pbrMetallicRoughness/baseColorTexture/index";
    for (const int index : {-7, 99, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()})
        check_refused({
            {"/nodes/0/mesh", index, {"node \"house\"", "mesh does not exist"}},
            {"/nodes/1/camera", index, {"node \"eye\"", "camera does not exist"}},
            {"/nodes/2/extensions/KHR_lights_punctual/light", index, {"node \"lamp\"", "light does not exist"}},
            {"/meshes/0/primitives/0/material", index, {"mesh \"leaf\"", "material does not exist"}},
            {"/meshes/0/primitives/0/attributes/TEXCOORD_0", index, {"mesh \"leaf\"", "accessor does not exist"}},
            {slot, index, {"material \"wall\"", "texture does not exist"}},
            {"/textures/0/source", index, {"texture 0", "image"}},
            {"/images/0/bufferView", index, {"image 0", "buffer view does not exist"}},
            {"/scene", index, {"scene does not exist"}},
            {"/scenes/0/nodes/0", index, {"node does not exist"}},
            {"/nodes/0/children", {index}, {"node does not exist"}},
        });
    check_refused({
        {"/meshes/0/primitives/0/material",
         1,
         {"mesh \"leaf\"", "material does not exist"}},  // the first that is not there
        {"/meshes/0/primitives/0/indices", 99, {"mesh \"leaf\"", "accessor does not exist (got 99"}},
        {"/textures/0/source", nullptr, {"texture 0", "no image"}},
        {"/nodes/2/extensions/KHR_lights_punctual/light", "x", {"node \"lamp\""}},
        {"/scenes", nullptr, {"no scene"}},
    });
}

TEST_CASE("nodes that do not form a tree are refused") {
    check_refused({
        {"/nodes/0/children", {0}, {"node 0 is reached twice"}},
        {"/nodes/0/children", {2}, {"node 2 is reached twice"}},
        {"/scenes/0/nodes", {0, 0}, {"node 0 is reached twice"}},
    });
    GltfDraft draft = textured_draft();
    draft.root["nodes"][0]["children"] = {1};
    draft.root["nodes"][1]["children"] = {0};
    draft.root["scenes"][0]["nodes"] = {0};
    check_refused(draft, {"node 0 is reached twice"});
    draft = textured_draft();
    const int first = int(draft.root["nodes"].size());
    for (int i = first; i < 100000; ++i) draft.add("nodes", {{"children", {i + 1}}});
    draft.add("nodes", {{"mesh", 0}});
    draft.root["scenes"][0]["nodes"] = {first};
    check_refused(draft, {"too deep"});
}

TEST_CASE("nodes, cameras and lights that point nowhere are refused") {
    const std::string light = "/extensions/KHR_lights_punctual/lights/0";
    check_refused({
        {"/nodes/0/rotation", {0, 0, 0, 0}, {"node \"house\"", "not finite"}},
        {"/nodes/1/scale", {1e200, 1e200, 1}, {"node \"eye\"", "not finite"}},
        {"/nodes/1/scale", {1, 0, 1}, {"node \"eye\"", "scale of 0"}},
        {"/nodes/2/scale", {0, 0, 0}, {"node \"lamp\"", "scale of 0"}},
        {light + "/intensity", -1, {"node \"lamp\"", "got -1"}},
        {light + "/intensity", 1e300, {"node \"lamp\"", "intensity"}},
        {light + "/type", "area", {"node \"lamp\"", "area"}},
        {"/cameras/0/perspective/yfov", 0, {"node \"eye\"", "yfov", "got 0"}},
        {"/cameras/0/perspective/yfov", 3.1416, {"node \"eye\"", "yfov"}},
        {"/cameras/0/perspective/yfov", -1, {"node \"eye\"", "yfov", "got -1"}},
        {"/cameras/0/perspective/znear", 0, {"node \"eye\"", "znear", "got 0"}},
        {"/cameras/0/perspective/znear", -1, {"node \"eye\"", "znear", "got -1"}},
        {"/cameras/0/perspective/zfar", -1, {"node \"eye\"", "zfar", "got -1"}},
        {"/cameras/0/perspective/zfar", 0.05, {"node \"eye\"", "zfar", "above its znear"}},
        {"/cameras/0/perspective/aspectRatio", -1, {"node \"eye\"", "aspectRatio"}},
        {light + "/spot", {{"innerConeAngle", 1}, {"outerConeAngle", 0.5}}, {"node \"lamp\"", "cone angles"}},
        {light + "/spot", {{"outerConeAngle", 7}}, {"node \"lamp\"", "cone angles"}},
    });
}

TEST_CASE("pictures that cannot be had are refused") {
    check_refused({
        {"/bufferViews/3/byteLength", 60, {"image 0 \"bricks\""}},  // cut short
        {"/images/0", {{"name", "noise"}, {"uri", "data:image/png;base64,AAAA"}}, {"image 0 \"noise\""}},
        {"/images/0", {{"name", "far"}, {"uri", "far.png"}}, {"image 0 \"far\"", "far.png"}},
        {"/images/0", {{"uri", "."}}, {"image 0"}},
    });
}

TEST_CASE("a picture of no pixels or of ten thousand million is refused by what its header claims") {
    struct Claim {
        const char *side, *checksum;  // of width and height; of the header's chunk
        const char* words;
    };
    for (const Claim& claim : {Claim{"\x00\x01\x86\xa0", "\xa8\x52\x0b\xc8", "100000 x 100000 pixels"},
                               Claim{"\x00\x00\x00\x00", nullptr, "image 0 \"bricks\""}}) {
        GltfDraft draft = textured_draft();
        const size_t header = draft.bytes.find("IHDR");
        REQUIRE(header != std::string::npos);
        draft.bytes.replace(header + 4, 8, std::string(claim.side, 4) + std::string(claim.side, 4));
        if (claim.checksum) draft.bytes.replace(header + 17, 4, claim.checksum, 4);
        const int64_t before = peak_memory();
        check_refused(draft, {"image 0 \"bricks\"", claim.words});
        CHECK(peak_memory() - before < 100 << 20);
    }
}

TEST_CASE("an extension that a file requires is named, even where nothing else of the file makes sense") {
    GltfDraft draft = textured_draft();
    draft.root["extensionsRequired"] = {"KHR_lights_punctual", "KHR_texture_basisu"};
    check_refused(draft, {"KHR_texture_basisu"});
    for (Json& accessor : draft.root["accessors"]) accessor.erase("bufferView");  // as compressed files are
    check_refused(draft, {"KHR_texture_basisu"});
    draft = textured_draft();
    draft.root["extensionsRequired"] = {"KHR_lights_punctual"};
    CHECK_NOTHROW(load(draft));
}
