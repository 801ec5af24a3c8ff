#include "scenes/materials.h"

namespace pluvia {

Rgb nits(Rgb color, float cd_per_m2) {
    return color * (cd_per_m2 / luminance(color));
}

Material matte(const std::string& name, Rgb base_color, float roughness) {
    Material m;
    m.name = name;
    m.base_color = base_color;
    m.metallic = 0;
    m.roughness = roughness;
    return m;
}

Material glowing(const std::string& name, Rgb base_color, Rgb emission, int picture) {
    Material m = matte(name, base_color, 0.6f);
    m.emission = emission;
    m.emission_texture = picture;
    m.base_color_texture = picture;
    return m;
}

}  // namespace pluvia
