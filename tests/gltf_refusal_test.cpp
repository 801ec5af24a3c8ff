// Files that cannot be rendered are refused with a message that names the file and the part at fault; nothing that a file
// says may crash the program or take more memory than the file is worth.
#include "renderer/core/error.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf.h"
#include "tests/folder.h"
#include "tests/gltf_draft.h"

#include <doctest/doctest.h>

#include <functional>
#include <limits>

#include <sys/resource.h>

using namespace pluvia;

namespace {

/// What load_gltf says about a file that it refuses as unreadable; "" when it reads it.
std::string refusal(const std::string& path) {
    try {
        load_gltf(path);
    } catch (const Error& e) {
        CHECK(e.code() == ExitCode::input);
        CHECK(std::string(e.what()).starts_with(path));
        return e.what();
    }
    return "";
}

struct Fault {
    const char* name;
    std::function<void(GltfDraft&)> make;  // in the file of textured_draft()
    std::vector<const char*> words;        // that the message has
};

/// One triangle with texture coordinates, indices, a material, a texture, an embedded picture, a camera and a light.
GltfDraft textured_draft() {
    GltfDraft draft;
    const int uv = draft.add_floats({0, 0, 1, 0, 0, 1}, "VEC2");                              // accessor 0
    const int indices = draft.add_values<uint16_t>({0, 1, 2}, "SCALAR", gltf_ushort);         // accessor 1
    const int mesh = draft.add_triangle_mesh({{"attributes", {{"TEXCOORD_0", uv}}}, {"indices", indices}, {"material", 0}});
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

Json& primitive(GltfDraft& draft) { return draft.root["meshes"][0]["primitives"][0]; }

void check_refused(const std::vector<Fault>& faults) {
    const Folder folder("gltf_refusal_test");
    REQUIRE(refusal(folder.write("good.gltf", textured_draft().gltf())) == "");
    for (const Fault& fault : faults) {
        GltfDraft draft = textured_draft();
        fault.make(draft);
        const std::string message = refusal(folder.write("bad.gltf", draft.gltf()));
        INFO(fault.name, ": ", message);
        CHECK(message != "");
        for (const char* word : fault.words) CHECK(message.find(word) != std::string::npos);
    }
}

int64_t peak_memory() {  // bytes
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return int64_t(usage.ru_maxrss) * 1024;
}

}  // namespace

TEST_CASE("numbers that lie outside their buffers are refused") {
    check_refused({
        {"accessor longer than its view", [](auto& d) { d.root["accessors"][2]["count"] = 4; }, {"mesh \"leaf\"", "accessor 2", "4 elements"}},
        {"accessor beyond its view", [](auto& d) { d.root["accessors"][2]["byteOffset"] = 4; }, {"accessor 2"}},
        {"accessor far beyond its view", [](auto& d) { d.root["accessors"][2]["byteOffset"] = std::numeric_limits<uint64_t>::max(); }, {"accessor 2"}},
        {"count that overflows", [](auto& d) { d.root["accessors"][2]["count"] = std::numeric_limits<uint64_t>::max(); }, {"accessor 2"}},
        {"stride smaller than an element", [](auto& d) { d.root["bufferViews"][2]["byteStride"] = 8; }, {"accessor 2"}},
        {"view longer than the buffer", [](auto& d) { d.root["bufferViews"][2]["byteLength"] = 100000; }, {"buffer view 2", "100000 bytes"}},
        {"view beyond the buffer", [](auto& d) { d.root["bufferViews"][2]["byteOffset"] = std::numeric_limits<uint64_t>::max() - 8; }, {"buffer view 2"}},
        {"picture's view beyond the buffer", [](auto& d) { d.root["bufferViews"][3]["byteLength"] = 100000; }, {"image 0 \"bricks\"", "buffer view 3"}},
        {"view of a buffer that is not there", [](auto& d) { d.root["bufferViews"][2]["buffer"] = 1; }, {"buffer does not exist (got 1"}},
        {"view of a negative buffer", [](auto& d) { d.root["bufferViews"][2]["buffer"] = -1; }, {"buffer does not exist (got -1"}},
        {"accessor without a view", [](auto& d) { d.root["accessors"][2].erase("bufferView"); }, {"accessor 2", "buffer view does not exist"}},
        {"accessor of a negative view", [](auto& d) { d.root["accessors"][2]["bufferView"] = -2; }, {"accessor 2", "got -2"}},
        {"sparse accessor", [](auto& d) { d.root["accessors"][2]["sparse"] = {{"count", 1}, {"indices", {{"bufferView", 0}, {"componentType", 5125}}}, {"values", {{"bufferView", 0}}}}; }, {"accessor 2", "sparse"}},
        {"positions of two numbers", [](auto& d) { d.root["accessors"][2]["type"] = "VEC2"; }, {"accessor 2", "got 2 components, expected 3"}},
        {"signed integers", [](auto& d) { d.root["accessors"][2]["componentType"] = 5124; }, {"accessor 2"}},
        {"doubles", [](auto& d) { d.root["accessors"][2]["componentType"] = 5130; }, {"accessor 2"}},
        {"indices as floats", [](auto& d) { primitive(d)["indices"] = 2; }, {"index accessor 2", "wrong type"}},
        {"index beyond the vertices", [](auto& d) { d.bytes[24] = 3; }, {"mesh \"leaf\"", "got 3, expected below 3"}},
        {"a triangle of two corners", [](auto& d) { d.root["accessors"][1]["count"] = 2; }, {"mesh \"leaf\"", "got 2 indices"}},
        {"fewer texture coordinates than vertices", [](auto& d) { d.root["accessors"][0]["count"] = 2; }, {"mesh \"leaf\"", "TEXCOORD_0", "got 2, expected 3"}},
        {"no positions", [](auto& d) { primitive(d)["attributes"].erase("POSITION"); }, {"mesh \"leaf\"", "no POSITION"}},
        {"a position that is not a number", [](auto& d) { d.bytes.replace(32, 4, std::string("\0\0\xc0\x7f", 4)); }, {"mesh \"leaf\"", "not finite"}},
        {"a position at infinity", [](auto& d) { d.bytes.replace(32, 4, std::string("\0\0\x80\x7f", 4)); }, {"mesh \"leaf\"", "not finite"}},
    });
}

TEST_CASE("references to what is not there are refused, negative ones too") {
    std::vector<Fault> faults;
    for (const int index : {-7, 1, 99, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
        const auto set = [index](auto place) { return [index, place](GltfDraft& d) { place(d) = index; }; };
        faults.push_back({"mesh", set([](auto& d) -> Json& { return d.root["nodes"][0]["mesh"]; }), {"node \"house\"", "mesh does not exist"}});
        faults.push_back({"camera", set([](auto& d) -> Json& { return d.root["nodes"][1]["camera"]; }), {"node \"eye\"", "camera does not exist"}});
        faults.push_back({"light", set([](auto& d) -> Json& { return d.root["nodes"][2]["extensions"]["KHR_lights_punctual"]["light"]; }), {"node \"lamp\"", "light does not exist"}});
        faults.push_back({"material", set([](auto& d) -> Json& { return primitive(d)["material"]; }), {"mesh \"leaf\"", "material does not exist"}});
        faults.push_back({"texture", set([](auto& d) -> Json& { return d.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"]; }), {"material \"wall\"", "texture does not exist"}});
        faults.push_back({"image", set([](auto& d) -> Json& { return d.root["textures"][0]["source"]; }), {"texture 0", "image"}});
        faults.push_back({"scene", set([](auto& d) -> Json& { return d.root["scene"]; }), {"scene does not exist"}});
        if (index == 1) continue;  // these have more than one
        faults.push_back({"picture's view", set([](auto& d) -> Json& { return d.root["images"][0]["bufferView"]; }), {"bufferView", "not found"}});
        faults.push_back({"attribute", set([](auto& d) -> Json& { return primitive(d)["attributes"]["TEXCOORD_0"]; }), {"mesh \"leaf\"", "accessor does not exist"}});
        faults.push_back({"root", set([](auto& d) -> Json& { return d.root["scenes"][0]["nodes"][0]; }), {"node does not exist"}});
        faults.push_back({"child", set([](auto& d) -> Json& { return d.root["nodes"][0]["children"][0]; }), {"node does not exist"}});
    }
    faults.push_back({"indices", [](auto& d) { primitive(d)["indices"] = 99; }, {"indices accessor out of bounds"}});
    faults.push_back({"texture without an image", [](auto& d) { d.root["textures"][0].erase("source"); }, {"texture 0", "no image"}});
    faults.push_back({"light without a number", [](auto& d) { d.root["nodes"][2]["extensions"]["KHR_lights_punctual"]["light"] = "x"; }, {"node \"lamp\""}});
    faults.push_back({"no scene", [](auto& d) { d.root.erase("scenes"); }, {"no scene"}});
    check_refused(faults);
}

TEST_CASE("nodes, cameras and lights without a meaning are refused") {
    check_refused({
        {"a node that is its own child", [](auto& d) { d.root["nodes"][0]["children"] = {0}; }, {"node 0 is reached twice"}},
        {"a ring of nodes", [](auto& d) { d.root["nodes"][0]["children"] = {1}; d.root["nodes"][1]["children"] = {0}; d.root["scenes"][0]["nodes"] = {0}; }, {"reached twice"}},
        {"a node with two parents", [](auto& d) { d.root["nodes"][0]["children"] = {2}; }, {"node 2 is reached twice"}},
        {"a chain of 100000 nodes", [](auto& d) {
             for (int i = 3; i < 100000; ++i) d.add("nodes", {{"children", {i + 1}}});
             d.add("nodes", {{"mesh", 0}});
             d.root["scenes"][0]["nodes"] = {3};
         }, {"too deep"}},
        {"quaternion of length zero", [](auto& d) { d.root["nodes"][0]["rotation"] = {0, 0, 0, 0}; }, {"node \"house\"", "not finite"}},
        {"scale that overflows", [](auto& d) { d.root["nodes"][1]["scale"] = {1e200, 1e200, 1}; }, {"node \"eye\"", "not finite"}},
        {"camera without extent", [](auto& d) { d.root["nodes"][1]["scale"] = {1, 0, 1}; }, {"node \"eye\"", "scale of 0"}},
        {"light without direction", [](auto& d) { d.root["nodes"][2]["scale"] = {0, 0, 0}; }, {"node \"lamp\"", "scale of 0"}},
        {"light below zero", [](auto& d) { d.root["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = -1; }, {"node \"lamp\"", "got -1"}},
        {"light without bound", [](auto& d) { d.root["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 1e300; }, {"node \"lamp\"", "intensity"}},
        {"unknown light", [](auto& d) { d.root["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = "area"; }, {"node \"lamp\"", "area"}},
        {"yfov of 0", [](auto& d) { d.root["cameras"][0]["perspective"]["yfov"] = 0; }, {"node \"eye\"", "yfov", "got 0"}},
        {"yfov of pi", [](auto& d) { d.root["cameras"][0]["perspective"]["yfov"] = 3.1416; }, {"node \"eye\"", "yfov"}},
        {"required extension", [](auto& d) { d.root["extensionsRequired"] = {"KHR_draco_mesh_compression"}; }, {"KHR_draco_mesh_compression"}},
        {"required compression that leaves accessors empty", [](auto& d) {
             d.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
             for (Json& accessor : d.root["accessors"]) accessor.erase("bufferView");
         }, {"KHR_draco_mesh_compression"}},
        {"picture that is cut short", [](auto& d) { d.root["bufferViews"][3]["byteLength"] = 60; }, {"image 0 \"bricks\""}},
        {"picture that is none", [](auto& d) { d.root["images"][0] = {{"name", "noise"}, {"uri", "data:image/png;base64,AAAA"}}; }, {"image 0 \"noise\""}},
        {"picture that is missing", [](auto& d) { d.root["images"][0] = {{"name", "far"}, {"uri", "far.png"}}; }, {"image 0 \"far\"", "far.png"}},
        {"picture that is a folder", [](auto& d) { d.root["images"][0] = {{"uri", "."}}; }, {"image 0"}},
    });
}

TEST_CASE("files that are no glTF are refused") {
    const Folder folder("gltf_refusal_test");
    const std::string good = triangle_draft().gltf(), glb = triangle_draft().glb();
    const auto says = [&](const std::string& path, const std::string& words) {
        const std::string message = refusal(path);
        CAPTURE(message);
        CHECK(message.find(words) != std::string::npos);
    };
    says(folder / "missing.glb", "is not a file");
    says(folder.path().string(), "expected .glb or .gltf");
    says(folder.write("scene.obj", good), "got \".obj\"");
    says(folder.write("text.glb", good), "not a binary glTF file");
    says(folder.write("binary.gltf", glb), "not readable as glTF");
    for (const char* text : {"", "{", "null", "[]", "{}", "{\"asset\": {}}", "{\"asset\": 2, \"nodes\": 3}", "hello", "\xff\xfe", "\"\\"})
        CHECK(refusal(folder.write("garbage.gltf", text)) != "");
    CHECK(refusal(folder.write("version.glb", std::string(glb).replace(4, 1, "\1"))).find("got 1, expected 2") != std::string::npos);
    std::string extras = std::string(100000, '[') + std::string(100000, ']');
    says(folder.write("deep.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"extras\": " + extras + "}"), "too deeply");
    std::string buffer_elsewhere = good;
    buffer_elsewhere.replace(buffer_elsewhere.find("data:"), 5, "gone:");
    CHECK(refusal(folder.write("buffer.gltf", buffer_elsewhere)) != "");
}

TEST_CASE("a file of the same name in the current folder is not taken for one beside the scene") {
    const Folder folder("gltf_refusal_test");
    const auto before = std::filesystem::current_path();
    std::filesystem::create_directory(folder / "elsewhere");
    const auto png = encode_png(Image<Rgba8>(1, 1));
    folder.write("elsewhere/bricks.png", {reinterpret_cast<const char*>(png.data()), png.size()});
    GltfDraft draft = triangle_draft();
    draft.root["images"] = {{{"uri", "bricks.png"}}};
    folder.write("scene.gltf", draft.gltf());
    std::filesystem::current_path(folder / "elsewhere");
    CHECK(refusal("../scene.gltf").find("bricks.png") != std::string::npos);
    std::filesystem::copy_file("bricks.png", folder / "bricks.png");
    CHECK(refusal("../scene.gltf") == "");
    std::filesystem::current_path(folder.path());
    CHECK(refusal("scene.gltf") == "");
    std::filesystem::current_path(before);
}

TEST_CASE("a .glb that is cut short anywhere is refused") {
    const Folder folder("gltf_refusal_test");
    const std::string whole = textured_draft().glb();
    REQUIRE(refusal(folder.write("whole.glb", whole)) == "");
    for (size_t size = 0; size < whole.size(); ++size) {
        std::string part = whole.substr(0, size);
        CAPTURE(size);
        CHECK(refusal(folder.write("part.glb", part)) != "");
        if (size < 12) continue;
        for (int k = 0; k < 4; ++k) part[8 + k] = char(size >> (8 * k));  // as if it had been meant so
        CHECK(refusal(folder.write("part.glb", part)) != "");
    }
}

TEST_CASE("a file with any one byte changed is read or refused, never more") {
    const Folder folder("gltf_refusal_test");
    const std::string whole = textured_draft().glb();
    const size_t picture = whole.find("\x89PNG");  // damaged pictures are those of image_test.cpp
    REQUIRE(picture != std::string::npos);
    int refused = 0;
    for (size_t i = 0; i < picture; ++i)
        for (const char byte : {'\0', '-', '9', '{', '"', '\xff'}) {
            std::string changed = whole;
            changed[i] = byte;
            refused += !refusal(folder.write("changed.glb", changed)).empty();
        }
    CHECK(refused > int(picture));  // most of the bytes matter
}

TEST_CASE("a small file that speaks of two thousand million elements takes no memory for them") {
    const Folder folder("gltf_refusal_test");
    GltfDraft draft = textured_draft();
    draft.root["accessors"][2]["count"] = int64_t(1) << 31;
    const int64_t before = peak_memory();
    const std::string message = refusal(folder.write("huge.gltf", draft.gltf()));
    CHECK(message.find("2147483648 elements") != std::string::npos);
    CHECK(peak_memory() - before < 100 << 20);  // a byte for each would be twenty times as much
    draft = textured_draft();
    std::string text = draft.gltf();
    const std::string length = "\"byteLength\":" + std::to_string(draft.bytes.size());
    text.replace(text.find(length), length.size(), "\"byteLength\":1099511627776");
    CHECK(refusal(folder.write("huge.gltf", text)) != "");
    CHECK(peak_memory() - before < 100 << 20);
}
