#include "renderer/scene/lamps.h"

#include <algorithm>
#include <map>

namespace pluvia {

int lamp_count(const Scene& scene) {
    const auto is_lamp = [](const auto& part) { return part.lamp; };
    return int(std::count_if(scene.materials.begin(), scene.materials.end(), is_lamp) +
               std::count_if(scene.instances.begin(), scene.instances.end(), is_lamp) +
               std::count_if(scene.lights.begin(), scene.lights.end(), is_lamp));
}

void switch_off_lamps(Scene& scene) {
    for (Material& material : scene.materials)
        if (material.lamp) material.emission = Rgb(0);
    std::map<int, int> dark_mesh;  // of a mesh that emits; others may still shine with the original
    for (Instance& instance : scene.instances) {
        const int material = scene.meshes[size_t(instance.mesh)].material;
        if (!instance.lamp || !scene.materials[size_t(material)].emits()) continue;
        if (!dark_mesh.count(instance.mesh)) {
            Material dark = scene.materials[size_t(material)];
            dark.emission = Rgb(0);
            scene.materials.push_back(dark);
            Mesh mesh = scene.meshes[size_t(instance.mesh)];
            mesh.material = int(scene.materials.size()) - 1;
            scene.meshes.push_back(std::move(mesh));
            dark_mesh[instance.mesh] = int(scene.meshes.size()) - 1;
        }
        instance.mesh = dark_mesh[instance.mesh];
    }
    std::erase_if(scene.lights, [](const PunctualLight& light) { return light.lamp; });
}

}  // namespace pluvia
