#include "renderer/scene/tangents.h"

#include "renderer/core/random.h"

#include <algorithm>
#include <bit>
#include <unordered_map>

namespace pluvia {
namespace {

/// What makes two vertices one: MikkTSpace compares position, normal and texture coordinates, not indices.
struct Place {
    Vec3 position, normal;
    Vec2 uv;
    bool operator==(const Place&) const = default;
};

struct PlaceHash {
    size_t operator()(const Place& p) const {
        uint64_t h = 0;
        for (const float x :
             {p.position.x, p.position.y, p.position.z, p.normal.x, p.normal.y, p.normal.z, p.uv.x, p.uv.y})
            h = hash_key(h, std::bit_cast<uint32_t>(x + 0.0f));  // -0 is 0
        return h;
    }
};

/// Number of the place of every vertex.
std::vector<uint32_t> weld(const Mesh& mesh, const std::vector<Vec2>& uvs) {
    std::vector<uint32_t> place(mesh.positions.size());
    std::unordered_map<Place, uint32_t, PlaceHash> seen;
    seen.reserve(place.size());
    for (size_t i = 0; i < place.size(); ++i)
        place[i] = seen.try_emplace({mesh.positions[i], mesh.normals[i], uvs[i]}, uint32_t(seen.size())).first->second;
    return place;
}

/// The part of v in the plane with normal n, unit; zero when there is none.
Vec3 in_plane(Vec3 v, Vec3 n) {
    const Vec3 p = normalize(v - n * dot(v, n));
    return is_finite(p) ? p : Vec3();
}

struct UvMap {
    Vec3 along_u;  // not unit; zero where the coordinates do not span the triangle
    bool upright = false,
         spans = false;  // upright: v falls where the front's bitangent rises, as in a picture on a wall
};

UvMap uv_map(const Mesh& mesh, const std::vector<Vec2>& uvs, const std::array<uint32_t, 3>& t) {
    const Vec3 e1 = mesh.positions[t[1]] - mesh.positions[t[0]], e2 = mesh.positions[t[2]] - mesh.positions[t[0]];
    const Vec2 a = uvs[t[1]] - uvs[t[0]], b = uvs[t[2]] - uvs[t[0]];
    const float determinant = a.x * b.y - a.y * b.x;
    UvMap map;
    map.upright = determinant < 0;
    map.along_u = (e1 * b.y - e2 * a.y) * (map.upright ? -1.0f : 1.0f);
    map.spans = determinant != 0 && std::isfinite(determinant) && length_squared(map.along_u) > 0;
    return map;
}

/// Appends a copy of a vertex.
uint32_t add_copy(Mesh& mesh, uint32_t vertex) {
    const auto copy = [&](auto& values) {
        if (values.empty()) return;
        const auto value = values[vertex];
        values.push_back(value);
    };
    copy(mesh.positions), copy(mesh.normals), copy(mesh.uvs), copy(mesh.uvs1), copy(mesh.tangents), copy(mesh.colors);
    copy(mesh.alphas);
    return uint32_t(mesh.positions.size()) - 1;
}

}  // namespace

void generate_tangents(Mesh& mesh, const std::vector<Vec2>& uvs) {
    for (const auto& triangle : mesh.triangles)
        for (const uint32_t corner : triangle)
            if (corner >= mesh.positions.size()) return;  // check() refuses the mesh
    const auto place = weld(mesh, uvs);
    std::vector<UvMap> maps;
    maps.reserve(mesh.triangles.size());
    // Two sums per place: mirrored and upright.
    std::vector<std::array<Vec3, 2>> sums(*std::max_element(place.begin(), place.end()) + 1);
    for (const auto& t : mesh.triangles) {
        const UvMap& map = maps.emplace_back(uv_map(mesh, uvs, t));
        if (!map.spans) continue;
        for (int k = 0; k < 3; ++k) {
            const uint32_t vertex = t[k];
            const Vec3 n = mesh.normals[vertex], p = mesh.positions[vertex];
            const Vec3 to_next = in_plane(mesh.positions[t[(k + 1) % 3]] - p, n);
            const Vec3 to_last = in_plane(mesh.positions[t[(k + 2) % 3]] - p, n);
            const float angle = std::acos(std::clamp(dot(to_next, to_last), -1.0f, 1.0f));
            sums[place[vertex]][map.upright] += in_plane(map.along_u, n) * angle;
        }
    }
    mesh.tangents.assign(mesh.positions.size(), {{}, 0});  // sign 0: not decided yet
    std::unordered_map<uint32_t, uint32_t> copies;         // vertices on the line of a mirror: their other half
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (uint32_t& corner : mesh.triangles[i]) {
            const auto& sum = sums[place[corner]];
            // A triangle without a direction of its own takes that of its neighbours.
            const bool upright = maps[i].spans ? maps[i].upright : length_squared(sum[1]) > length_squared(sum[0]);
            const float sign = upright ? 1.0f : -1.0f;
            Vec3 direction = normalize(sum[upright]);
            if (!is_finite(direction)) direction = ShadingBasis(mesh.normals[corner]).tangent;
            if (mesh.tangents[corner].sign == -sign) {
                const auto [entry, is_new] = copies.try_emplace(corner, 0);
                if (is_new) entry->second = add_copy(mesh, corner);
                corner = entry->second;
            }
            mesh.tangents[corner] = {direction, sign};
        }
    }
    for (Tangent& tangent : mesh.tangents)
        if (tangent.sign == 0) tangent = {{1, 0, 0}, 1};  // of vertices that no triangle uses
}

}  // namespace pluvia
