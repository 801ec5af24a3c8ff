// What is written and hung in the lane without light of its own: the big signboard and door curtains.
#include "scenes/lane.h"

#include <cmath>
#include <numbers>

namespace pluvia::lane {

Assembly hanging_board(const Finishes& f) {
    Assembly a;
    constexpr float width = 0.62f, height = 1.65f, reach = 0.5f, thick = 0.05f;
    Shape board, frame;
    for (const float side : {1.0f, -1.0f}) {
        const float x = side * (0.5f * width - 0.03f), z = side * thick;
        add_quad(board, {Vec3{-x, -height + 0.03f, z}, {x, -height + 0.03f, z}, {x, -0.03f, z}, {-x, -0.03f, z}},
                 {0, 1}, {1, 0});
    }
    Chance chance{77};
    add_box(frame, {-0.5f * width, -height, -thick}, {0.5f * width, -height + 0.05f, thick + 0.02f}, chance.tint(0.2f),
            0.008f);
    add_box(frame, {-0.5f * width, -0.05f, -thick - 0.02f}, {0.5f * width, 0, thick + 0.02f}, chance.tint(0.2f),
            0.008f);
    for (const float x : {-0.5f * width, 0.5f * width - 0.05f})
        add_box(frame, {x, -height, -thick - 0.02f}, {x + 0.05f, 0, thick + 0.02f}, chance.tint(0.2f), 0.008f);
    // A little roof of two boarded slopes with a ridge keeps the rain off.
    for (const float side : {1.0f, -1.0f})
        for (int i = 0; i < 5; ++i) {
            const float near = float(i) * 0.055f, y = 0.17f - near * 0.6f;
            add_beam(frame, {-0.5f * width - 0.1f, y, side * (near + 0.03f)},
                     {0.5f * width + 0.1f, y, side * (near + 0.03f)}, {0, 1, side * 0.6f}, 0.075f, 0.02f,
                     chance.tint(0.35f));
        }
    add_beam(frame, {-0.5f * width - 0.12f, 0.2f, 0}, {0.5f * width + 0.12f, 0.2f, 0}, {0, 1, 0}, 0.08f, 0.05f);
    add_box(frame, {-0.04f, 0, -0.04f}, {0.04f, 0.17f, 0.04f});
    const Transform projecting = translate({0, 0, reach}) * rotate_y(std::numbers::pi / 2);
    append(a[f.signboard], board, projecting);
    append(a[f.red_wood], frame, projecting);
    for (const float y : {-0.16f, -height + 0.14f})
        add_beam(a[f.red_wood], {0, y, 0}, {0, y, reach - 0.5f * width + 0.02f}, {0, 1, 0}, 0.09f, 0.12f,
                 chance.tint(0.2f));
    return a;
}

Assembly noren(const Finishes& f, float width, float height) {
    Assembly a;
    constexpr int panels = 3;
    const float panel = width / panels;
    add_tube(a[f.bamboo], {{-0.5f * width - 0.05f, 0, 0}, {0.5f * width + 0.05f, 0, 0}}, 0.013f, 8);
    for (int i = 0; i < panels; ++i) {
        const float left = -0.5f * width + panel * float(i) + 0.006f, w = panel - 0.012f;
        // Folds grow towards the free hem, each panel in its own way; the upper edge is straight on its rod.
        add_sheet(a[f.noren_print], 10, 8, [&](float s, float t) {
            const float free = 1 - t,
                        fold = std::sin(5.5f * s + 2.1f * float(i)) + 0.5f * std::sin(11 * s + 4.0f * float(i));
            const float x = left + w * (s + 0.03f * free * std::sin(3.0f * float(i) + 1));
            const Vec3 p = {x, -height * free, 0.024f * free * fold + 0.03f * free * free};
            return SheetPoint{p, {(left + 0.5f * width + s * w) / width, free}};
        });
    }
    return a;
}

}  // namespace pluvia::lane
