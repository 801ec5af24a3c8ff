#include "scenes/person.h"

#include <cmath>

namespace pluvia {
namespace {

/// Surface of revolution that is squeezed from front to back.
void add_squeezed(Shape& shape, const std::vector<Vec2>& profile, float squeeze, Vec3 at, Rgb color) {
    Shape round;
    add_lathe(round, profile, 14, {0.6f, 0.6f}, {color, {}});
    append(shape, round, translate(Vec3d(at)) * scale({1, 1, squeeze}));
}

}  // namespace

Assembly person_body(Palette& palette, const PersonLook& look) {
    Assembly a;
    Shape& cloth = a[palette("awning_cloth")];
    add_squeezed(cloth, {{0.17f, 0.0f}, {0.2f, 0.02f}, {0.175f, 0.35f}, {0.21f, 0.62f}, {0.19f, 0.74f}, {0.06f, 0.8f}},
                 0.62f, {0, 0.7f, 0}, look.coat);
    add_squeezed(cloth,
                 {{0.05f, 0.0f}, {0.055f, 0.06f}, {0.085f, 0.11f}, {0.098f, 0.2f}, {0.08f, 0.27f}, {0.02f, 0.31f}},
                 1.1f, {0, 1.46f, 0.01f}, {0.55f, 0.36f, 0.27f});
    add_squeezed(cloth, {{0.1f, 0.0f}, {0.106f, 0.05f}, {0.09f, 0.1f}, {0.02f, 0.145f}}, 1.12f, {0, 1.65f, -0.015f},
                 look.hair);
    const Vec3 right_hand = look.has_umbrella ? Vec3(-0.16f, 1.2f, 0.24f) : Vec3(-0.27f, 0.84f, 0.05f);
    add_tube(cloth, {{0.21f, 1.38f, 0}, {0.26f, 1.1f, -0.03f}, {0.27f, 0.84f, 0.05f}}, {0.058f, 0.05f, 0.04f}, 8,
             {look.coat, {}});
    add_tube(cloth, {{-0.21f, 1.38f, 0}, {-0.25f, 1.12f, 0.02f}, right_hand}, {0.058f, 0.05f, 0.04f}, 8,
             {look.coat, {}});
    if (!look.has_umbrella) return a;
    add_tube(a[palette("iron")], {{-0.16f, 1.05f, 0.25f}, {-0.12f, 2.12f, 0.16f}}, 0.008f, 6);
    Shape canopy;  // both sides, so that it has a thickness
    add_lathe(canopy, {{0.5f, 0.0f}, {0.51f, 0.01f}, {0.38f, 0.12f}, {0.2f, 0.2f}, {0.02f, 0.24f}}, 16, {3, 0.6f},
              {look.umbrella, {}});
    add_lathe(canopy, {{0.02f, 0.225f}, {0.2f, 0.185f}, {0.38f, 0.105f}, {0.5f, 0.0f}}, 16, {3, 0.6f},
              {look.umbrella, {}});
    append(cloth, canopy, translate({-0.12, 1.86, 0.16}));
    return a;
}

Assembly person_leg(Palette& palette, const PersonLook& look) {
    Assembly a;
    Shape& cloth = a[palette("awning_cloth")];
    add_tube(cloth, {{0, 0.04f, 0}, {0, -0.42f, 0.02f}, {0, -0.8f, 0}}, {0.085f, 0.062f, 0.05f}, 8,
             {look.trousers, {}});
    add_box(cloth, {-0.045f, -0.88f, -0.08f}, {0.045f, -0.79f, 0.17f}, {{0.03f, 0.025f, 0.02f}, {}});
    return a;
}

}  // namespace pluvia
