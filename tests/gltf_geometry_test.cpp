// Shapes that glTF files come in: strips, sparse and quantised accessors, copies, tangents, compression.
#include "renderer/scene/gltf.h"
#include "tests/gltf_draft.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace pluvia;

namespace {

using Triangles = std::vector<std::array<uint32_t, 3>>;

std::string bytes_of(const char* hex) {
    std::string bytes;
    for (; hex[0] && hex[1]; hex += 2) bytes += char(std::stoi(std::string(hex, 2), nullptr, 16));
    return bytes;
}

/// A quad on the wall x, y with a normal map, its picture upright, and further corners as given.
GltfDraft mapped_quad(const std::vector<float>& uvs) {
    GltfDraft draft;
    const int position = draft.add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3"),
              normal = draft.add_floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3"),
              uv = draft.add_floats(uvs, "VEC2"),
              indices = draft.add_values<uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR", gltf_ushort);
    draft.root["images"] = {{{"uri", data_uri(bytes_of("50360a3120310a3235350a8080ff"), "image/x-portable-pixmap")}}};
    draft.root["textures"] = {{{"source", 0}}};
    draft.root["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    const Json primitive = {{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}},
                            {"indices", indices},
                            {"material", 0}};
    draft.add_root({{"mesh", draft.add("meshes", {{"primitives", Json::array({primitive})}})}});
    return draft;
}

// The quad (0,0,0), (1,0,0), (1,1,1/2), (0,1,1/4) in two triangles, as the libraries' own encoders write it.
constexpr const char* draco_quad =
    "445241434f02020100000002040100010200020301020009030007030902000300000000000000000000000000000000803f00000000"
    "000000000000803f0000803f0000003f000000000000803f0000803e000000000000803f0000803f0000803f0000803f000000000000"
    "000000000000";
constexpr const char* meshopt_vertices =
    "a000000133000000ffff01330000007e7d0000010c000000ff010c0000007e00000103000000ff010d0000007e000000000000000000"
    "0000000000000000000000000000000000000000000000";
constexpr const char* meshopt_triangles = "e0f000007687566778a9866589689801690000";
constexpr const char* meshopt_indices = "d000040406080400000000";
constexpr const char* meshopt_normals =
    "a00133000000fefd010c000000fe00000000000000000000000000000000000000000000000000000000000000007f00";

const std::vector<Vec3> quad = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5f}, {0, 1, 0.25f}};

/// Adds a compressed view of `count` elements of `stride` bytes.
int add_meshopt_view(GltfDraft& draft, const char* hex, int count, int stride, const std::string& mode,
                     const std::string& filter = "NONE") {
    const std::string content = bytes_of(hex);
    const size_t offset = draft.bytes.size();
    draft.bytes += content;
    const Json settings = {{"buffer", 0},          {"byteOffset", offset}, {"byteLength", content.size()},
                           {"byteStride", stride}, {"count", count},       {"mode", mode},
                           {"filter", filter}};
    return draft.add(
        "bufferViews",
        {{"buffer", 0}, {"byteLength", count * stride}, {"extensions", {{"EXT_meshopt_compression", settings}}}});
}

}  // namespace

TEST_CASE("strips and fans become triangles with the strip's winding") {
    for (const auto& [mode, expected] : {std::pair(5, Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}),
                                         std::pair(6, Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}})}) {
        GltfDraft draft;
        const int position = draft.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3");
        const Json primitive = {{"attributes", {{"POSITION", position}}}, {"mode", mode}};
        draft.add_root({{"mesh", draft.add("meshes", {{"primitives", Json::array({primitive})}})}});
        CHECK(load(draft).meshes[0].triangles == expected);
    }
}

TEST_CASE("points and lines are left out with a warning") {
    GltfDraft draft = triangle_draft();
    for (const int mode : {0, 1, 2, 3}) {
        draft.root["meshes"][0]["primitives"][1] = {{"attributes", {{"POSITION", 0}}}, {"mode", mode}};
        const Scene scene = load(draft);
        CHECK(scene.meshes.size() == 1);
        CHECK(warns(scene, mode == 0 ? "primitive 1 is made of points" : "of lines"));
    }
}

TEST_CASE("sparse accessors substitute values, with and without values below") {
    GltfDraft draft;
    const int targets = draft.add_view(std::string("\1\0\2\0", 4));
    const float substitutes[6] = {5, 6, 7, 0, 0, 9};
    const int values = draft.add_view({reinterpret_cast<const char*>(substitutes), sizeof substitutes});
    const Json sparse = {{"count", 2},
                         {"indices", {{"bufferView", targets}, {"componentType", 5123}}},
                         {"values", {{"bufferView", values}}}};
    draft.add_root({{"mesh", draft.add_triangle_mesh()}});
    const int position = draft.root["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
    draft.root["accessors"][position]["sparse"] = sparse;
    CHECK(load(draft).meshes[0].positions == std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 0, 9}});
    draft.root["accessors"][position]["count"] = 3;
    draft.root["accessors"][position].erase("bufferView");
    CHECK(load(draft).meshes[0].positions == std::vector<Vec3>{{0, 0, 0}, {5, 6, 7}, {0, 0, 9}});
}

TEST_CASE("quantised positions and normals are read as KHR_mesh_quantization has them") {
    GltfDraft draft;
    draft.root["extensionsUsed"] = draft.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    const int position = draft.add_view(std::string("\0\0\0\0\0\0\0\0\xff\xff\0\0\0\0\0\0\0\0\x10\0\0\0\0\0", 24), 8);
    const int normal = draft.add_view(std::string("\0\0\x7f\0\0\0\x7f\0\0\x80\0\0", 12), 4);
    const Json primitive = {{"attributes",
                             {{"POSITION", draft.add_accessor(position, 3, "VEC3", gltf_short)},
                              {"NORMAL", draft.add_accessor(normal, 3, "VEC3", gltf_byte, true)}}}};
    draft.add_root({{"mesh", draft.add("meshes", {{"primitives", Json::array({primitive})}})}});
    const Scene scene = load(draft);
    CHECK(scene.warnings.empty());
    CHECK(scene.meshes[0].positions == std::vector<Vec3>{{0, 0, 0}, {-1, 0, 0}, {0, 16, 0}});
    CHECK(scene.meshes[0].normals == std::vector<Vec3>{{0, 0, 1}, {0, 0, 1}, {0, -1, 0}});
}

TEST_CASE("EXT_mesh_gpu_instancing places one mesh many times, each copy with an id of its own") {
    GltfDraft draft;
    draft.root["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const float h = std::sqrt(0.5f);
    const Json attributes = {{"TRANSLATION", draft.add_floats({0, 0, 0, 0, 0, -4}, "VEC3")},
                             {"ROTATION", draft.add_floats({0, 0, 0, 1, 0, 0, h, h}, "VEC4")},
                             {"SCALE", draft.add_floats({1, 1, 1, 3, 1, 1}, "VEC3")}};
    draft.add_root({{"name", "trees"},
                    {"mesh", draft.add_triangle_mesh()},
                    {"translation", {10, 0, 0}},
                    {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
    const Scene scene = load(draft);
    CHECK(scene.warnings.empty());
    CHECK(scene.meshes.size() == 1);
    REQUIRE(scene.instances.size() == 2);
    CHECK(scene.instances[1].name == "trees[1]");
    CHECK(scene.instances[0].id != scene.instances[1].id);
    const Vec3d p = scene.instances[1].scene_from_object.point({1, 0, 0}) + scene.origin;
    CHECK(length(p - Vec3d(10, 3, -4)) < 1e-6);
}

TEST_CASE("tangents that a normal map needs follow its picture, and split where it is mirrored") {
    const Scene upright = load(mapped_quad({0, 1, 1, 1, 1, 0, 0, 0}));
    REQUIRE(upright.meshes[0].tangents.size() == 4);
    for (const Tangent& t : upright.meshes[0].tangents) {
        CHECK(length(t.direction - Vec3(1, 0, 0)) < 1e-6f);
        CHECK(t.sign == 1);  // cross(z, x) = y, which is up in the picture
    }
    const Scene mirrored = load(mapped_quad({1, 1, 0, 1, 0, 0, 1, 0}));
    REQUIRE(mirrored.meshes[0].tangents.size() == 4);
    for (const Tangent& t : mirrored.meshes[0].tangents) {
        CHECK(length(t.direction - Vec3(-1, 0, 0)) < 1e-6f);
        CHECK(t.sign == -1);
    }
    // The second triangle runs back in u: its two shared corners are doubled.
    const Scene both = load(mapped_quad({0, 1, 1, 1, 1, 0, 2, 0}));
    CHECK(both.meshes[0].positions.size() == 6);
    CHECK(both.meshes[0].tangents.size() == 6);
}

TEST_CASE("tangents are averaged over a vertex by angle, along a curved wall") {
    // A right-angled fold: the middle edge's tangents lie between those of the two walls, in the plane of its normal.
    GltfDraft draft = mapped_quad({0, 0, 0, 0, 0, 0, 0, 0});
    const float h = std::sqrt(0.5f);
    const int position = draft.add_floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, -1, 1, 1, -1}, "VEC3"),
              normal = draft.add_floats({0, 0, 1, h, 0, h, h, 0, h, 0, 0, 1, 1, 0, 0, 1, 0, 0}, "VEC3"),
              uv = draft.add_floats({0, 1, 1, 1, 1, 0, 0, 0, 2, 1, 2, 0}, "VEC2"),
              indices = draft.add_values<uint16_t>({0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2}, "SCALAR", gltf_ushort);
    Json& primitive = draft.root["meshes"][0]["primitives"][0];
    primitive["attributes"] = {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}};
    primitive["indices"] = indices;
    const Mesh mesh = load(draft).meshes[0];
    REQUIRE(mesh.tangents.size() == 6);
    for (const int k : {1, 2}) CHECK(length(mesh.tangents[k].direction - Vec3(h, 0, -h)) < 1e-6f);
    for (const int k : {4, 5}) CHECK(length(mesh.tangents[k].direction - Vec3(0, 0, -1)) < 1e-6f);
}

TEST_CASE("tangents in a file without normals are ignored") {
    GltfDraft draft;
    const int tangent = draft.add_floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    draft.add_root({{"mesh", draft.add_triangle_mesh({{"attributes", {{"TANGENT", tangent}}}})}});
    CHECK(load(draft).meshes[0].tangents.empty());
}

TEST_CASE("a primitive keeps only those of many shared vertices that it uses") {
    GltfDraft draft;
    std::vector<float> positions;
    for (int i = 0; i < 1000; ++i) positions.insert(positions.end(), {float(i), float(i % 2), 0});
    const int position = draft.add_floats(positions, "VEC3"),
              indices = draft.add_values<uint16_t>({990, 991, 992}, "SCALAR", gltf_ushort);
    const Json primitive = {{"attributes", {{"POSITION", position}}}, {"indices", indices}};
    draft.add_root({{"mesh", draft.add("meshes", {{"primitives", Json::array({primitive})}})}});
    const Scene scene = load(draft);
    CHECK(scene.meshes[0].positions == std::vector<Vec3>{{990, 0, 0}, {991, 1, 0}, {992, 0, 0}});
    CHECK(scene.meshes[0].triangles == Triangles{{0, 1, 2}});
}

TEST_CASE("more than 65536 vertices keep their indices") {
    GltfDraft draft;
    std::vector<float> positions;
    std::vector<uint32_t> corners;
    for (uint32_t i = 0; i < 70002; ++i) {
        positions.insert(positions.end(), {float(i), float(i % 3), 0});
        corners.push_back(i);
    }
    const Json primitive = {{"attributes", {{"POSITION", draft.add_floats(positions, "VEC3")}}},
                            {"indices", draft.add_values<uint32_t>(corners, "SCALAR", gltf_uint)}};
    draft.add_root({{"mesh", draft.add("meshes", {{"primitives", Json::array({primitive})}})}});
    const Mesh mesh = load(draft).meshes[0];
    REQUIRE(mesh.triangles.size() == 23334);
    CHECK(mesh.positions[mesh.triangles.back()[2]].x == 70001);
}

TEST_CASE("Draco's vertices and triangles are those that went in") {
    GltfDraft draft;
    draft.root["extensionsUsed"] = draft.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    const int view = draft.add_view(bytes_of(draco_quad));
    const int position = draft.add("accessors", {{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}}),
              uv = draft.add("accessors", {{"componentType", 5126}, {"count", 4}, {"type", "VEC2"}}),
              indices = draft.add("accessors", {{"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}});
    const Json draco = {{"bufferView", view}, {"attributes", {{"POSITION", 7}, {"TEXCOORD_0", 3}}}};
    const Json primitive = {{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}},
                            {"indices", indices},
                            {"extensions", {{"KHR_draco_mesh_compression", draco}}}};
    draft.add_root({{"mesh", draft.add("meshes", {{"primitives", Json::array({primitive})}})}});
    const Scene scene = load(draft);
    CHECK(scene.warnings.empty());
    CHECK(scene.meshes[0].positions == quad);
    CHECK(scene.meshes[0].uvs == std::vector<Vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}});
    CHECK(scene.meshes[0].triangles == Triangles{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("meshopt's vertices, normals and triangles are those that went in") {
    for (const bool is_list : {true, false}) {
        GltfDraft draft;
        draft.root["extensionsUsed"] = draft.root["extensionsRequired"] = {"EXT_meshopt_compression"};
        const int vertices = add_meshopt_view(draft, meshopt_vertices, 4, 12, "ATTRIBUTES");
        const int normals = add_meshopt_view(draft, meshopt_normals, 4, 4, "ATTRIBUTES", "OCTAHEDRAL");
        const int triangles = is_list ? add_meshopt_view(draft, meshopt_triangles, 6, 4, "TRIANGLES")
                                      : add_meshopt_view(draft, meshopt_indices, 6, 4, "INDICES");
        draft.root["bufferViews"][normals]["byteStride"] = 4;
        const Json primitive = {{"attributes",
                                 {{"POSITION", draft.add_accessor(vertices, 4, "VEC3", gltf_float)},
                                  {"NORMAL", draft.add_accessor(normals, 4, "VEC3", gltf_byte, true)}}},
                                {"indices", draft.add_accessor(triangles, 6, "SCALAR", gltf_uint)}};
        draft.add_root({{"mesh", draft.add("meshes", {{"primitives", Json::array({primitive})}})}});
        const Scene scene = load(draft);
        CHECK(scene.warnings.empty());
        CHECK(scene.meshes[0].positions == quad);
        // Triangles may be rotated by the encoder, which keeps their winding.
        const Triangles rotated = {{0, 1, 2}, {2, 3, 0}};
        const bool same =
            scene.meshes[0].triangles == Triangles{{0, 1, 2}, {0, 2, 3}} || scene.meshes[0].triangles == rotated;
        CHECK(same);
        const std::vector<Vec3> expected = {{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
        for (int i = 0; i < 4; ++i)  // 8 bits
            CHECK(length(scene.meshes[0].normals[i] - expected[i]) < 0.02f);
    }
}
