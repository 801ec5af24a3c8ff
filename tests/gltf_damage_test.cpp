// Files damaged as files: of another kind, cut short, changed in one place, or larger than they can be. Nothing that a
// file says may crash the program or take more memory than the file is worth.
#include "tests/gltf_refusals.h"

#include <filesystem>
#include <fstream>

using namespace pluvia;

TEST_CASE("a kilobyte of JSON that speaks of many things is refused before memory is taken for them") {
    const TemporaryFolder folder;
    const int64_t before = peak_memory();
    std::string many = "{\"asset\":{\"version\":\"2.0\"},\"materials\":[{}";
    for (int i = 0; i < 200000; ++i) many += ",{}";
    CHECK(refusal(write(folder, "many.gltf", many + "]}")).find("too many materials") != std::string::npos);
    GltfDraft draft;  // one mesh of many primitives on many nodes
    const int mesh = draft.add_triangle_mesh();
    Json& primitives = draft.root["meshes"][mesh]["primitives"];
    for (int i = 0; i < 2000; ++i) primitives.push_back(Json(primitives[0]));
    for (int i = 0; i < 4000; ++i) draft.add_root({{"mesh", mesh}});
    CHECK(refusal(write(folder, "placed.gltf", draft.gltf())).find("asks for more than") != std::string::npos);
    draft = triangle_draft();  // zeros that take no bytes
    draft.root["accessors"][0].erase("bufferView");
    draft.root["accessors"][0]["count"] = 300000000;
    CHECK(refusal(write(folder, "zeros.gltf", draft.gltf())).find("accessor 0") != std::string::npos);
    CHECK(peak_memory() - before < int64_t(700) << 20);  // the budget of 256 MiB, twice while a vector grows
}

TEST_CASE("a .glb longer than its length field can say is refused at once") {
    const TemporaryFolder folder;
    const std::string path = write(folder, "large.glb", triangle_draft().glb());
    std::filesystem::resize_file(path, uint64_t(5) << 30);  // takes no space on the disk
    CHECK(refusal(path).find("a .glb holds less than 4 GiB") != std::string::npos);
}

TEST_CASE("a .glb of more than 2 GiB is read like a short one" * doctest::skip()) {
    const TemporaryFolder folder;
    GltfDraft draft = triangle_draft();
    constexpr uint64_t gap = uint64_t(5) << 29;  // 2.5 GiB, which take no space on the disk
    const auto word = [](uint64_t value) {
        std::string bytes;
        for (int k = 0; k < 4; ++k) bytes += char(value >> (8 * k));
        return bytes;
    };
    const std::string triangle = draft.bytes;
    draft.root["bufferViews"][0]["byteOffset"] = gap;
    draft.root["buffers"] = {{{"byteLength", gap + triangle.size()}}};
    std::string json = draft.root.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string path =
        write(folder, "large.glb",
              "glTF" + word(2) + word(28 + json.size() + gap + triangle.size()) + word(json.size()) + "JSON" + json +
                  word(gap + triangle.size()) + std::string("BIN\0", 4));
    std::filesystem::resize_file(path, std::filesystem::file_size(path) + gap);
    std::ofstream(path, std::ios::binary | std::ios::app) << triangle;
    const Scene scene = load_gltf(path);
    REQUIRE(scene.meshes.size() == 1);
    CHECK(scene.meshes[0].positions.size() == 3);
    CHECK(bounds(scene).upper.x - bounds(scene).lower.x == 1);
}

TEST_CASE("files that are no glTF are refused") {
    const TemporaryFolder folder;
    const std::string good = triangle_draft().gltf(), glb = triangle_draft().glb();
    const auto says = [&](const std::string& path, const std::string& words) {
        const std::string message = refusal(path);
        CAPTURE(message);
        CHECK(message.find(words) != std::string::npos);
    };
    says(folder / "missing.glb", "is not a file");
    says(folder.path(), "expected .glb or .gltf");
    says(write(folder, "scene.obj", good), "got \".obj\"");
    says(write(folder, "text.glb", good), "not a binary glTF file");
    says(write(folder, "binary.gltf", glb), "not readable as glTF (parse error at line 1, column 1");
    says(write(folder, "empty.gltf", ""), "not readable as glTF (parse error at line 1, column 1");
    says(write(folder, "number.gltf", R"({"asset": {"version": "2.0"}, "nodes": 3})"), "nodes are no list (got number");
    for (const char* text :
         {"", "{", "null", "[]", "{}", "{\"asset\": {}}", "{\"asset\": 2, \"nodes\": 3}", "hello", "\xff\xfe", "\"\\"})
        CHECK(refusal(write(folder, "garbage.gltf", text)) != "");
    says(write(folder, "version.glb", std::string(glb).replace(4, 1, "\1")), "got 1, expected 2");
    const std::string extras = std::string(100000, '[') + std::string(100000, ']');
    says(write(folder, "deep.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"extras\": " + extras + "}"), "too deeply");
    says(write(folder, "buffer.gltf", std::string(good).replace(good.find("data:"), 5, "gone:")), "not found");
}

TEST_CASE("a .glb that is cut short anywhere is refused") {
    const TemporaryFolder folder;
    const std::string whole = textured_draft().glb();
    REQUIRE(refusal(write(folder, "whole.glb", whole)) == "");
    for (size_t size = 0; size < whole.size(); ++size) {
        std::string part = whole.substr(0, size);
        CAPTURE(size);
        CHECK(refusal(write(folder, "part.glb", part)) != "");
        if (size < 12) continue;
        for (int k = 0; k < 4; ++k) part[8 + k] = char(size >> (8 * k));  // as if it had been meant so
        CHECK(refusal(write(folder, "part.glb", part)) != "");
    }
}

TEST_CASE("a file with any one byte changed is read or refused, never more") {
    const TemporaryFolder folder;
    const std::string whole = textured_draft().glb();
    const size_t picture = whole.find("\x89PNG");  // damaged pictures are those of image_test.cpp
    REQUIRE(picture != std::string::npos);
    int refused = 0;
    for (size_t i = 0; i < picture; ++i)
        for (const char byte : {'\0', '-', '9', '{', '"', '\xff'}) {
            std::string changed = whole;
            changed[i] = byte;
            refused += !refusal(write(folder, "changed.glb", changed)).empty();
        }
    CHECK(refused > int(picture));  // most of the bytes matter
}

TEST_CASE("a file with any one value replaced is read or refused, never more") {
    const TemporaryFolder folder;
    const Json others = {nullptr, true, -1, int64_t(1) << 40, 1e300, "x", Json::array(), Json::object(), {{0}}};
    const Json leaves = textured_draft().root.flatten();
    int refused = 0;
    for (const auto& [pointer, leaf] : leaves.items())
        for (Json::json_pointer place(pointer); !place.empty(); place.pop_back())  // the value and what it is part of
            for (const Json& other : others) {
                GltfDraft draft = textured_draft();
                draft.root[place] = other;
                refused += !refusal(write(folder, "changed.gltf", draft.gltf())).empty();
            }
    CHECK(refused > int(leaves.size()));
}

TEST_CASE("a small file that speaks of two thousand million elements takes no memory for them") {
    const TemporaryFolder folder;
    GltfDraft draft = textured_draft();
    draft.root["accessors"][2]["count"] = int64_t(1) << 31;
    const int64_t before = peak_memory();
    const std::string message = refusal(write(folder, "huge.gltf", draft.gltf()));
    CHECK(message.find("2147483648 elements") != std::string::npos);
    CHECK(peak_memory() - before < 100 << 20);  // a byte for each would be twenty times as much
    draft = textured_draft();
    std::string text = draft.gltf();
    const std::string length = "\"byteLength\":" + std::to_string(draft.bytes.size());
    text.replace(text.rfind(length), length.size(), "\"byteLength\":1099511627776");
    CHECK(refusal(write(folder, "huge.gltf", text)) != "");
    CHECK(peak_memory() - before < 100 << 20);
}
