#include "scenes/car_lamps.h"

#include "scenes/car_outline.h"
#include "scenes/materials.h"

#include "renderer/core/units.h"

#include <cmath>
#include <string>

namespace pluvia {
namespace {

int glow(Palette& palette, const std::string& name, Rgb base_color, Rgb emission) {
    return palette(name, [&](Scene&) {
        Material m = matte(name, base_color, 0.15f);
        m.emission = emission;
        m.lamp = true;
        return m;
    });
}

}  // namespace

int head_lamp_glow(Palette& palette) {
    return glow(palette, "head_lamp_glow", Rgb(0.6f), nits(halogen, 10000));
}
int tail_lamp_glow(Palette& palette) {
    return glow(palette, "tail_lamp_glow", {0.35f, 0.012f, 0.008f}, nits({1, 0.03f, 0.02f}, 150));
}

std::vector<PunctualLight> dipped_beams(const CarShape& shape) {
    struct Beam {
        const char* name;
        float candela, down, spread;  // degrees from the horizontal to the axis, and from there to the edge
    };
    // Edges are a degree or less above the horizontal, so that a tenth of the peak at most goes straight ahead.
    constexpr Beam beams[] = {{"far", 20000, 3, 3.5f}, {"near", 2000, 14, 15}};
    std::vector<PunctualLight> lights;
    for (const float side : {-1.0f, 1.0f})
        for (const Beam& beam : beams) {
            PunctualLight light;
            light.name = std::string("head_lamp_") + (side < 0 ? "right_" : "left_") + beam.name;
            light.kind = PunctualLight::Kind::spot;
            light.intensity = nits(halogen, beam.candela);
            light.position = Vec3d(CarOutline(shape).head_lamp(side) + Vec3(0, 0, lens_depth + 0.05f));
            const float down = float(radians_from_degrees(beam.down));
            light.direction = {0, -std::sin(down), std::cos(down)};
            light.outer_cone_angle = float(radians_from_degrees(beam.spread));
            light.lamp = true;
            lights.push_back(light);
        }
    return lights;
}

}  // namespace pluvia
