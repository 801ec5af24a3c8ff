#include "renderer/scene/open_volumes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace pluvia {
namespace {

/// Every edge of a closed surface is passed as often in one direction as in the other. Vertices at one place, to some
/// roundings of the mesh's size, count as one, since normals and uv coordinates split them.
bool is_closed(const Mesh& mesh) {
    Vec3 lower(1e30f, 1e30f, 1e30f), upper = -lower;
    for (const Vec3 p : mesh.positions) lower = min(lower, p), upper = max(upper, p);
    const double cell = std::max(1e-30, 1e-5 * double(length(upper - lower)));
    const auto round = [&](float x) { return std::llround(double(x) / cell); };
    std::map<std::array<long long, 3>, int> known;
    std::vector<int> place;
    for (const Vec3 p : mesh.positions)
        place.push_back(known.emplace(std::array{round(p.x), round(p.y), round(p.z)}, int(known.size())).first->second);
    std::map<std::pair<int, int>, int> balance;
    for (const auto& triangle : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const int a = place[triangle[k]], b = place[triangle[(k + 1) % 3]];
            if (a < b) ++balance[{a, b}];
            if (b < a) --balance[{b, a}];
        }
    for (const auto& [edge, count] : balance)
        if (count != 0) return false;
    return true;
}

}  // namespace

void make_open_volumes_thin(Scene& scene) {
    std::map<int, int> thin;  // copy of each material
    for (Mesh& mesh : scene.meshes) {
        if (!scene.materials[mesh.material].has_volume() || is_closed(mesh)) continue;
        const auto [entry, is_new] = thin.emplace(mesh.material, int(scene.materials.size()));
        if (is_new) {
            Material copy = scene.materials[mesh.material];
            copy.thickness = 0;
            scene.materials.push_back(copy);
        }
        scene.warnings.push_back(
            fmt::format("mesh \"{}\": its material \"{}\" has a volume, but its surface is not "
                        "closed; it is rendered as a thin sheet",
                        mesh.name, scene.materials[mesh.material].name));
        mesh.material = entry->second;
    }
}

}  // namespace pluvia
