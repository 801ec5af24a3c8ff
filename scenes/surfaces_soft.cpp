// Pictures of cloth and leaves.
#include "scenes/noise.h"
#include "scenes/surfaces.h"

#include "renderer/core/units.h"

#include <algorithm>
#include <cmath>

namespace pluvia {

SurfaceMaps cloth() {
    return paint(256, 256, {0.25f, 0.25f}, [](float x, float y) {
        const float warp = std::sin(2 * pi * x * 64), weft = std::sin(2 * pi * y * 64);
        const float slub = fractal_noise({x * 64, y * 6}, 64, 6, 2, 81) + fractal_noise({x * 6, y * 64}, 6, 64, 2, 82);
        Texel t;
        t.albedo = Rgb(0.72f) * (0.78f + 0.08f * warp * weft + 0.2f * slub);
        t.roughness = 0.95f;
        t.height = 0.00025f * (warp * weft + slub);
        return t;
    });
}

SurfaceMaps leaf() {
    return paint(256, 256, {0.1f, 0.1f}, [](float x, float y) {
        const float along = 1 - y, side = std::abs(x - 0.5f);
        // A pointed oval on a short stalk.
        const float s = std::clamp((along - 0.1f) / 0.88f, 0.0f, 1.0f);
        const float half_width = 0.36f * std::pow(std::sin(pi * std::pow(s, 0.8f)), 0.8f);
        const bool stalk = along < 0.14f && side < 0.02f;
        const float vein_phase = (along - 0.9f * side) * 9;
        const float vein = bump(vein_phase - std::round(vein_phase), 0.12f);
        const float rib = bump(side, 0.025f);
        const float patch = fractal_noise({x * 5, y * 5}, 5, 5, 4, 91);
        Texel t;
        t.albedo = mix(Rgb(0.045f, 0.11f, 0.025f) * (0.6f + 0.8f * patch), Rgb(0.12f, 0.19f, 0.06f),
                       std::max(rib, 0.35f * vein));
        t.roughness = 0.4f + 0.2f * patch;
        t.height = 0.0012f * rib - 0.0006f * vein;
        t.alpha = side < half_width || stalk ? 1.0f : 0.0f;
        return t;
    });
}

SurfaceMaps dry_leaf() {
    return paint(128, 128, {0.1f, 0.1f}, [](float x, float y) {
        const float along = 1 - y, side = std::abs(x - 0.5f);
        const float s = std::clamp((along - 0.12f) / 0.86f, 0.0f, 1.0f);
        const float teeth = 0.02f * std::abs(std::sin(along * 40));
        const float half_width = 0.42f * std::pow(std::sin(pi * std::pow(s, 0.7f)), 0.7f) - teeth;
        const bool stalk = along < 0.16f && side < 0.025f;
        const float vein_phase = (along - 0.8f * side) * 8;
        const float vein = std::max(bump(vein_phase - std::round(vein_phase), 0.14f) * 0.5f, bump(side, 0.03f));
        const float patch = fractal_noise({x * 5, y * 5}, 5, 5, 4, 97);
        Texel t;
        t.albedo = mix(mix(Rgb(0.34f, 0.12f, 0.025f), Rgb(0.42f, 0.22f, 0.05f), patch), Rgb(0.2f, 0.09f, 0.03f), vein);
        t.roughness = 0.7f;
        t.height = 0.001f * vein;
        t.alpha = side < half_width || stalk ? 1.0f : 0.0f;
        return t;
    });
}

SurfaceMaps frond() {
    return paint(256, 512, {0.25f, 0.5f}, [](float x, float y) {
        const float along = 1 - y, side = std::abs(x - 0.5f);
        const float reach = 0.48f * std::sin(pi * std::clamp(0.15f + 0.85f * along, 0.0f, 1.0f));
        // Leaflets leave the rib at a slant and taper to their tips.
        const float slanted = (along - 0.5f * side) * 22;
        const float index = std::floor(slanted), within = slanted - index - 0.5f;
        const float taper = 0.42f * (1 - std::pow(std::clamp(side / std::max(reach, 1e-3f), 0.0f, 1.0f), 2.0f));
        const bool leaflet = side < reach && std::abs(within) < taper && along > 0.1f;
        const float shade = noise({index + 0.5f, x < 0.5f ? 0.5f : 1.5f}, 64, 2, 95);
        Texel t;
        t.albedo = Rgb(0.055f, 0.12f, 0.03f) * (0.6f + 0.7f * shade);
        t.roughness = 0.5f;
        t.height = -0.002f * std::abs(within);
        t.alpha = leaflet || side < 0.012f ? 1.0f : 0.0f;
        return t;
    });
}

}  // namespace pluvia
