#include "renderer/transport/media.h"

#include <algorithm>
#include <cmath>

namespace pluvia {
namespace {

float ior(const Scene& scene, int material) {
    return material < 0 ? 1.0f : scene.materials[material].ior;
}

}  // namespace

bool Media::contains(int material) const {
    return std::find(stack_.begin(), stack_.begin() + depth_, material) != stack_.begin() + depth_;
}

void Media::enter(int material) {
    if (depth_ < int(stack_.size())) stack_[depth_++] = material;
}

void Media::leave(int material) {
    for (int i = depth_ - 1; i >= 0; --i)
        if (stack_[i] == material) {
            std::copy(stack_.begin() + i + 1, stack_.begin() + depth_, stack_.begin() + i);
            --depth_;
            return;
        }
}

Rgb transmittance(const Scene& scene, int material, float distance) {
    if (material < 0) return Rgb(1);
    const Material& m = scene.materials[material];
    if (m.attenuation_color == Rgb(1) || !std::isfinite(m.attenuation_distance)) return Rgb(1);
    const float x = distance / m.attenuation_distance;
    return {std::pow(m.attenuation_color.r, x), std::pow(m.attenuation_color.g, x), std::pow(m.attenuation_color.b, x)};
}

float basic_radiance(const Scene& scene, int material) {
    const float n = ior(scene, material);
    return 1 / (n * n);
}

void find_sides(const Scene& scene, const Media& media, Surface& surface) {
    surface.before = surface.behind = media.innermost();
    if (surface.volume < 0) return;
    Media beyond = media;
    if (surface.from_front) {
        beyond.enter(surface.volume);
    } else {
        beyond.leave(surface.volume);
        if (!media.contains(surface.volume)) surface.before = surface.volume;
    }
    surface.behind = beyond.innermost();
    if (auto* glass = std::get_if<Glass>(&surface.bsdf))
        glass->eta = ior(scene, surface.behind) / ior(scene, surface.before);
}

}  // namespace pluvia
